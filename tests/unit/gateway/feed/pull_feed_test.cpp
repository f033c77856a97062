#include "gateway/feed/pull_feed.hpp"

#include <gtest/gtest.h>
#include <algorithm>
#include <random>

namespace dripline::feed {
namespace {

using interpreter::ProgramLookup;
using interpreter::TextWindow;
using std::chrono::milliseconds;

std::string program_text(std::size_t bytes) {
  std::string text;
  for (std::size_t line = 0; text.size() < bytes; ++line)
    text += "N" + std::to_string(line) + " X" + std::to_string(line * 7 % 1000) + "\n";
  text.resize(bytes);
  return text;
}

std::vector<std::byte> bytes_of(std::string_view text) {
  const auto* begin = reinterpret_cast<const std::byte*>(text.data());
  return {begin, begin + text.size()};
}

/// A server in a test's hands: keeps what was asked, and answers on request.
class FakeServer {
 public:
  std::map<std::string, std::string> programs;  ///< "" is the run's own
  std::vector<dds::BlockRequest> asked;

  PullFeed::Ask ask() {
    return [this](const dds::BlockRequest& request) {
      asked.push_back(request);
      return true;
    };
  }

  std::vector<dds::BlockData> answers(std::size_t piece = dds::kMaxBlockBytes) {
    std::vector<dds::BlockData> all;
    for (const dds::BlockRequest& request : std::exchange(asked, {})) answer(request, piece, all);
    return all;
  }

 private:
  void answer(const dds::BlockRequest& request, std::size_t piece,
              std::vector<dds::BlockData>& to) {
    dds::BlockData data{request.machine,
                        request.session,
                        request.run,
                        request.program,
                        {},
                        0,
                        0,
                        false,
                        {},
                        {},
                        {}};
    data.offset = request.offset;
    const auto found = programs.find(request.program);
    if (found == programs.end()) {
      data.status = dds::BlockStatus::NoSuchProgram;
      to.push_back(data);
      return;
    }
    const std::string& text = found->second;
    const std::size_t end = std::min<std::size_t>(text.size(), request.offset + request.length);
    data.total_bytes = text.size();
    if (!request.program.empty()) data.content = sha256(text).hex();
    std::size_t at = request.offset;
    do {
      const std::size_t length = std::min(piece, end - at);
      data.offset = at;
      data.bytes = bytes_of(std::string_view(text).substr(at, length));
      data.ends = at + length == text.size();
      to.push_back(data);
      at += length;
    } while (at < end);
  }
};

class PullFeedTest : public testing::Test {
 protected:
  PullFeed make(const std::string& text, PullFeedOptions options = {}) {
    server.programs[""] = text;
    return PullFeed({"lathe-1", 7, "run-1", text.size()}, options, server.ask());
  }
  void deliver(PullFeed& feed) {
    for (const dds::BlockData& data : server.answers()) feed.on_data(data, now);
  }
  void exchange(PullFeed& feed) {
    feed.poll(now);
    deliver(feed);
  }

  FakeServer server;
  SteadyTime now{std::chrono::hours(1)};
};

TEST_F(PullFeedTest, AsksAtOnceAndGivesWhatCame) {
  PullFeed feed = make("O1\nM30\n");
  EXPECT_EQ(feed.fetch(0, 0, 100).state, TextWindow::State::NotYet);
  exchange(feed);
  const TextWindow window = feed.fetch(0, 0, 100);
  EXPECT_EQ(window.state, TextWindow::State::Ready);
  EXPECT_EQ(window.text, "O1\nM30\n");
  EXPECT_TRUE(window.reaches_end);
  EXPECT_EQ(feed.sent(), 7u);
  EXPECT_EQ(feed.content_digest(), sha256("O1\nM30\n"));
}

TEST_F(PullFeedTest, TheEndOfTheProgramIsAnEmptyWindow) {
  PullFeed feed = make("M30\n");
  const TextWindow window = feed.fetch(0, 4, 1);
  EXPECT_EQ(window.state, TextWindow::State::Ready);
  EXPECT_TRUE(window.text.empty());
  EXPECT_TRUE(window.reaches_end);
}

// A revision of the same length, after a server was restored from a copy for instance.
TEST_F(PullFeedTest, ACalledProgramOfAnotherContentIsRefused) {
  PullFeed feed = make("O1\nM98 P2\nM30\n");
  server.programs["2"] = std::string(200'000, 'X');
  EXPECT_EQ(feed.find("2").state, ProgramLookup::State::NotYet);
  feed.poll(now);
  std::vector<dds::BlockData> first = server.answers();
  feed.on_data(first.front(), now);
  ASSERT_EQ(feed.find("2").state, ProgramLookup::State::Found);
  const CalledProgram expected{"2", sha256(server.programs["2"]).hex()};
  EXPECT_EQ(feed.called_programs(), std::vector{expected});
  EXPECT_EQ(feed.called_program_count(), 1u);
  server.programs["2"].back() = 'Y';
  EXPECT_EQ(feed.fetch(1, 100'000, 1).state, TextWindow::State::NotYet);
  exchange(feed);
  EXPECT_EQ(feed.fetch(1, 100'000, 1).state, TextWindow::State::Failed);
  EXPECT_NE(feed.failure().find("another content for program \"2\""), std::string::npos);
}

TEST_F(PullFeedTest, ReportsACalledProgramThatIsMissing) {
  PullFeed feed = make("O1\nM98 P2\nM30\n");
  (void)feed.find("2");
  exchange(feed);
  const CalledProgram expected{"2", {}, true};
  EXPECT_EQ(feed.called_programs(), std::vector{expected});
}

TEST_F(PullFeedTest, StitchesALineAcrossPieces) {
  const std::string text = program_text(100'000);
  PullFeed feed = make(text);
  exchange(feed);
  const std::size_t at = ChunkCache::kChunkBytes - 5;
  const TextWindow window = feed.fetch(0, at, 64);
  ASSERT_EQ(window.state, TextWindow::State::Ready);
  ASSERT_GE(window.text.size(), 64u);
  EXPECT_EQ(window.text, std::string_view(text).substr(at, window.text.size()));
}

TEST_F(PullFeedTest, AsksForAtMostTheWindowAhead) {
  const std::string text = program_text(20'000'000);
  PullFeedOptions options;
  PullFeed feed = make(text, options);
  for (int i = 0; i < 10; ++i) exchange(feed);
  EXPECT_GE(feed.bytes_ahead(), options.max_window - options.request_bytes);
  EXPECT_LE(feed.sent(), options.max_window + ChunkCache::kChunkBytes);
}

TEST_F(PullFeedTest, SizesTheWindowInSecondsOfMotion) {
  PullFeed feed = make(program_text(20'000'000));
  feed.set_consumption(30'000);  // bytes a second, 10 s wanted
  for (int i = 0; i < 10; ++i) exchange(feed);
  EXPECT_NEAR(static_cast<double>(feed.bytes_ahead()), 300'000, 2 * ChunkCache::kChunkBytes);
}

TEST_F(PullFeedTest, KeepsWhatIsUnderWayBounded) {
  PullFeedOptions options;
  PullFeed feed = make(program_text(20'000'000), options);
  for (int i = 0; i < 20; ++i) feed.poll(now);
  std::size_t bytes = 0;
  for (const dds::BlockRequest& request : server.asked) bytes += request.length;
  EXPECT_LE(bytes, options.max_in_flight);
  EXPECT_GT(bytes, options.max_in_flight / 2);
}

TEST_F(PullFeedTest, AskedOnceWhileAnswersAreOnTheirWay) {
  PullFeed feed = make(program_text(1'000'000));
  feed.poll(now);
  const std::size_t first = server.asked.size();
  EXPECT_GT(first, 1u);
  feed.poll(now + milliseconds(100));
  EXPECT_EQ(server.asked.size(), first);
}

TEST_F(PullFeedTest, AsksAgainAfterASilenceEachTimeLater) {
  PullFeed feed = make("M30\n");
  std::vector<std::int64_t> times;
  for (int ms = 0; ms < 5000; ms += 10) {
    feed.poll(now + milliseconds(ms));
    if (!server.asked.empty()) times.push_back(ms);
    server.asked.clear();
  }
  EXPECT_EQ(times, (std::vector<std::int64_t>{0, 300, 900, 2100, 4500}));
}

TEST_F(PullFeedTest, AReturningServerIsAskedAtOnce) {
  PullFeed feed = make("M30\n");
  feed.poll(now);
  server.asked.clear();
  feed.ask_again();
  feed.poll(now + milliseconds(1));
  EXPECT_EQ(server.asked.size(), 1u);
}

TEST_F(PullFeedTest, ALoopWithinTheCacheIsNotAskedForAgain) {
  const std::string text = program_text(3'000'000);
  PullFeed feed = make(text);
  std::size_t requests = 0;
  for (int pass = 0; pass < 5; ++pass) {
    for (std::size_t at = 0; at < text.size(); at += 10'000) {
      while (feed.fetch(0, at, 1000).state != TextWindow::State::Ready) {
        feed.poll(now);
        if (pass > 0) requests += server.asked.size();
        deliver(feed);
      }
    }
  }
  EXPECT_EQ(requests, 0u);
}

TEST_F(PullFeedTest, CalledProgramsComeByName) {
  PullFeed feed = make("M98 P2\n");
  server.programs["O0002"] = "G0 X1\nM99\n";
  EXPECT_EQ(feed.find("O0002").state, ProgramLookup::State::NotYet);
  exchange(feed);
  const auto found = feed.find("O0002");
  ASSERT_EQ(found.state, ProgramLookup::State::Found);
  EXPECT_EQ(feed.fetch(found.program, 0, 1).text, "G0 X1\nM99\n");
}

TEST_F(PullFeedTest, AMissingCalledProgramIsNotFoundAndTheRunGoesOn) {
  PullFeed feed = make("M98 P2\n");
  feed.find("O0002");
  exchange(feed);
  EXPECT_EQ(feed.find("O0002").state, ProgramLookup::State::NotFound);
  EXPECT_EQ(feed.fetch(0, 0, 1).state, TextWindow::State::Ready);
}

TEST_F(PullFeedTest, ForeignAnswersAreIgnored) {
  PullFeed feed = make("M30\n");
  feed.poll(now);
  for (const dds::BlockData& data : server.answers()) {
    dds::BlockData other = data;
    other.session = 8;
    feed.on_data(other, now);
    other = data;
    other.run = "run-0";
    feed.on_data(other, now);
    other = data;
    other.program = "O0002";
    feed.on_data(other, now);
    other = data;
    other.offset = 2;  // would end after the end
    feed.on_data(other, now);
  }
  EXPECT_EQ(feed.sent(), 0u);
  EXPECT_EQ(feed.fetch(0, 0, 1).state, TextWindow::State::NotYet);
}

TEST_F(PullFeedTest, ACorruptProgramFailsWithTheServersReason) {
  PullFeed feed = make("M30\n");
  dds::BlockData data{"lathe-1", 7,  "run-1", "", dds::BlockStatus::Corrupt, 0, 0,
                      false,     {}, {},      {}};
  data.reason = "chunk 3 fails its check";
  feed.on_data(data, now);
  const TextWindow window = feed.fetch(0, 0, 1);
  EXPECT_EQ(window.state, TextWindow::State::Failed);
  EXPECT_NE(window.reason.find("chunk 3 fails its check"), std::string::npos);
}

TEST_F(PullFeedTest, AnotherSizeThanOrderedFails) {
  PullFeed feed = make("M30\n");
  server.programs[""] = "M30\nM30\n";
  exchange(feed);
  EXPECT_EQ(feed.fetch(0, 0, 1).state, TextWindow::State::Failed);
}

TEST_F(PullFeedTest, AServersOwnTroubleIsWaitedOut) {
  PullFeed feed = make("M30\n");
  dds::BlockData data{"lathe-1", 7, "run-1", "", dds::BlockStatus::Failed, 0, 0, false, {}, {}, {}};
  feed.on_data(data, now);
  EXPECT_EQ(feed.fetch(0, 0, 1).state, TextWindow::State::NotYet);
  exchange(feed);
  EXPECT_EQ(feed.fetch(0, 0, 1).state, TextWindow::State::Ready);
  for (int i = 0; i < 10; ++i) feed.on_data(data, now);
  EXPECT_EQ(feed.fetch(0, 0, 1).state, TextWindow::State::Failed);
}

/// With text lost, doubled, late or out of order: the reader sees exactly the program.
class AnyFaults : public testing::TestWithParam<unsigned> {};

TEST_P(AnyFaults, DeliverExactlyTheProgram) {
  std::mt19937 random(GetParam());
  const auto chance = [&](int percent) {
    return std::uniform_int_distribution<>(0, 99)(random) < percent;
  };
  const std::string text = program_text(400'000 + random() % 400'000);
  FakeServer server;
  server.programs[""] = text;
  PullFeedOptions options;
  options.cache_bytes = 512 * 1024;
  options.max_window = 256 * 1024;
  PullFeed feed({"lathe-1", 7, "run-1", text.size()}, options, [&](const dds::BlockRequest& r) {
    if (chance(10)) return false;
    if (!chance(15)) server.asked.push_back(r);
    return true;
  });

  SteadyTime now{std::chrono::hours(1)};
  std::vector<dds::BlockData> on_the_way;
  std::string read;
  for (int turn = 0; read.size() < text.size(); ++turn) {
    ASSERT_LT(turn, 20'000) << "stuck at byte " << read.size();
    now += milliseconds(20);
    feed.poll(now);
    for (dds::BlockData& data : server.answers(1000 + random() % 31'000)) {
      if (chance(10)) continue;
      on_the_way.push_back(data);
      if (chance(10)) on_the_way.push_back(data);
    }
    if (chance(30)) std::shuffle(on_the_way.begin(), on_the_way.end(), random);
    while (!on_the_way.empty() && !chance(20)) {
      feed.on_data(on_the_way.front(), now);
      on_the_way.erase(on_the_way.begin());
    }
    const std::size_t need = 1 + random() % 3000;
    const TextWindow window = feed.fetch(0, read.size(), need);
    ASSERT_NE(window.state, TextWindow::State::Failed) << window.reason;
    if (window.state != TextWindow::State::Ready) continue;
    ASSERT_GE(window.text.size(), std::min(need, text.size() - read.size()));
    ASSERT_EQ(window.text, std::string_view(text).substr(read.size(), window.text.size()));
    read += window.text;
    ASSERT_EQ(window.reaches_end, read.size() == text.size());
  }
  EXPECT_EQ(read, text);
  EXPECT_EQ(feed.content_digest(), sha256(text));
  EXPECT_EQ(feed.content_length(), text.size());
}

INSTANTIATE_TEST_SUITE_P(, AnyFaults, testing::Range(0u, 40u));

TEST(ChunkCache, DropsTheLeastRecentlyUsedButNeverTheOneInHand) {
  ChunkCache cache(2 * ChunkCache::kChunkBytes);
  const std::string text(ChunkCache::kChunkBytes, 'x');
  cache.store(0, 0, text);
  EXPECT_FALSE(cache.view(0, 0).empty());
  for (std::uint64_t i = 1; i < 10; ++i) cache.store(0, i * ChunkCache::kChunkBytes, text);
  EXPECT_FALSE(cache.peek(0, 0).empty());
  EXPECT_FALSE(cache.peek(0, 9 * ChunkCache::kChunkBytes).empty());
  EXPECT_LE(cache.bytes(), 2 * ChunkCache::kChunkBytes);
}

}  // namespace
}  // namespace dripline::feed
