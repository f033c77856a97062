// How program text gets to the gateways.
#include "server/machines/control_memory.hpp"
#include "tests/support/store_decorator.hpp"
#include "tests/unit/server/machines/machine_fixture.hpp"

namespace dripline::server_test {
namespace {

std::string contour(std::size_t size) {
  std::string text = "O0100\n";
  for (int n = 0; text.size() < size; ++n)
    text += fmt::format("N{} G01 X{}.5 Z-{}.25\n", n, n % 90, n % 70);
  return text;
}

class BlockFeedTest : public MachineServiceTest {
 protected:
  /// A run that has begun, of a program with `text`.
  std::string running(const std::string& text) {
    push("O0100", text);
    start_service();
    announce();
    answer_commands(true);
    const auto run = start("O0100");
    EXPECT_TRUE(run) << run.error().what;
    return run ? run->id : "";
  }
};

TEST_F(BlockFeedTest, AnswersARequestInPiecesUpToItsEnd) {
  const std::string text = contour(600'000);
  const std::string run = running(text);
  request(run, 0, 400'000);
  EXPECT_EQ(fed(13), text.substr(0, 400'000));
  const auto first = first_block();
  EXPECT_EQ(first.total_bytes, text.size());
  EXPECT_EQ(first.session, kSession);
  EXPECT_FALSE(first.ends);
}

TEST_F(BlockFeedTest, MarksTheEndOfTheProgram) {
  const std::string text = contour(1000);
  const std::string run = running(text);
  request(run, 500, 1'000'000);
  const auto block = first_block();
  EXPECT_EQ(block.bytes.size(), text.size() - 500);
  EXPECT_TRUE(block.ends);
}

TEST_F(BlockFeedTest, AnswersAtTheVeryEndWithNothing) {
  const std::string text = contour(1000);
  const std::string run = running(text);
  request(run, text.size(), 100);
  const auto block = first_block();
  EXPECT_EQ(block.status, dds::BlockStatus::Ok);
  EXPECT_TRUE(block.bytes.empty());
  EXPECT_TRUE(block.ends);
}

TEST_F(BlockFeedTest, ContinuesWhenTheQueueToTheGatewayWasFull) {
  const std::string text = contour(200'000);
  const std::string run = running(text);
  written_->refusals = 3;
  request(run, 0, 200'000);
  EXPECT_EQ(fed(7), text.substr(0, 200'000));
}

TEST_F(BlockFeedTest, StaysWithTheRevisionTheRunBeganWith) {
  const std::string text = contour(1000);
  const std::string run = running(text);
  clock_.advance(std::chrono::seconds(1));
  push("O0100", "M30\n");
  request(run, 0, 1'000'000);
  EXPECT_EQ(fed(1), text);
}

TEST_F(BlockFeedTest, RefusesAnUnknownRunAndOneThatHasEnded) {
  const std::string run = running("M30\n");
  request("no-such-run", 0, 10);
  EXPECT_EQ(first_block().status, dds::BlockStatus::NoSuchRun);
  record(1, run, dds::RecordKind::RunEnded, completed("M30\n", 1));
  ASSERT_TRUE(wait_ack(1));
  request(run, 0, 10);
  ASSERT_TRUE(written_->wait([&] { return written_->blocks.size() == 2; }));
  EXPECT_EQ(written_->blocks[1].status, dds::BlockStatus::NoSuchRun);
  EXPECT_NE(written_->blocks[1].reason.find("completed"), std::string::npos);
}

TEST_F(BlockFeedTest, RefusesAnOffsetAfterTheEnd) {
  const std::string run = running("M30\n");
  request(run, 5, 10);
  EXPECT_EQ(first_block().status, dds::BlockStatus::OutOfRange);
}

TEST_F(BlockFeedTest, FindsACalledProgramByItsNumber) {
  push("O2.nc", "O2\nM99\n");
  clock_.advance(std::chrono::seconds(1));
  const std::string run = running("M98 P2\n");
  request(run, 0, 100, "O0002");
  EXPECT_EQ(fed(1), "O2\nM99\n");
  EXPECT_EQ(written_->blocks[0].content, sha256("O2\nM99\n").hex())
      << "to be compared by a restart";
}

TEST_F(BlockFeedTest, NotesACalledProgramBeforeItsTextGoesOut) {
  const auto called = push("O2.nc", "O2\nM99\n");
  clock_.advance(std::chrono::seconds(1));
  const std::string run = running("M98 P2\n");
  request(run, 0, 100);
  ASSERT_FALSE(fed(1).empty());
  EXPECT_TRUE(store_->runs.calls(run)->empty()) << "its own program is no call";
  request(run, 0, 100, "O0002");
  ASSERT_TRUE(written_->wait([&] { return written_->blocks.size() == 2; }));
  const storage::RunCall call{"O0002", "O2.nc", called.number, called.content};
  EXPECT_EQ(store_->runs.calls(run).value(), std::vector{call});
}

/// A disk that is full stops no machine, and what it called is noted when there is room again.
TEST_F(BlockFeedTest, FeedsACalledProgramThatCannotBeNotedYet) {
  struct FullRuns final : test_support::RunStoreDecorator {
    using RunStoreDecorator::RunStoreDecorator;
    Result<void> add_call(const std::string& run, const storage::RunCall& call) override {
      if (is_full) return fail(Errc::Io, "disk full");
      return RunStoreDecorator::add_call(run, call);
    }
    std::atomic<bool> is_full = true;
  };
  push("O0002", "O2\nM99\n");
  push("O0100", "M98 P2\n");
  clock_.advance(std::chrono::seconds(1));
  FullRuns runs(*store_);
  const storage::Store store = test_support::with(*store_, runs);
  start_service(store);
  announce();
  answer_commands(true);
  const auto run = start("O0100");
  ASSERT_TRUE(run) << run.error().what;
  request(run->id, 0, 100, "O0002");
  EXPECT_EQ(fed(1), "O2\nM99\n");
  EXPECT_TRUE(store_->runs.calls(run->id)->empty());
  runs.is_full = false;
  request(run->id, 3, 100, "O0002");
  ASSERT_TRUE(written_->wait([&] { return written_->blocks.size() == 2; }));
  EXPECT_EQ(store_->runs.calls(run->id)->size(), 1u);
}

TEST_F(BlockFeedTest, KeepsACalledProgramAsItWasWhenTheRunBegan) {
  push("O0002", "O2\nM99\n");
  clock_.advance(std::chrono::seconds(1));
  const std::string run = running("M98 P2\n");
  clock_.advance(std::chrono::seconds(1));
  push("O0002", "another\n");
  request(run, 0, 100, "O0002");
  EXPECT_EQ(fed(1), "O2\nM99\n");
  request(run, 0, 100, "O0003");
  ASSERT_TRUE(written_->wait([&] { return written_->blocks.size() == 2; }));
  EXPECT_EQ(written_->blocks[1].status, dds::BlockStatus::NoSuchProgram);
}

TEST_F(BlockFeedTest, NeverAnswersACorruptChunkWithBytes) {
  struct CorruptPrograms final : test_support::ProgramStoreDecorator {
    using ProgramStoreDecorator::ProgramStoreDecorator;
    Result<std::vector<std::byte>> read_content(const Digest&, std::uint64_t,
                                                std::uint64_t) override {
      return fail(Errc::Corrupt, "chunk 3 fails its SHA-256");
    }
  } programs(*store_);
  storage::Store store = test_support::with(*store_, programs);
  push("O0100", "M30\n");
  start_service(store);
  announce();
  answer_commands(true);
  const auto run = start("O0100");
  ASSERT_TRUE(run);
  request(run->id, 0, 100);
  const auto block = first_block();
  EXPECT_EQ(block.status, dds::BlockStatus::Corrupt);
  EXPECT_TRUE(block.bytes.empty());
  EXPECT_NE(block.reason.find("chunk 3"), std::string::npos);
  service_.reset();  // before the store it uses
}

TEST_F(BlockFeedTest, AnswersARepeatedRequestOnce) {
  const std::string text = contour(300'000);
  const std::string run = running(text);
  written_->refusals = 20;  // the first answer waits, so the others find it waiting
  for (int i = 0; i < 10; ++i) request(run, 0, 300'000);
  request(run, 299'999, 1);
  ASSERT_TRUE(written_->wait(
      [&] { return !written_->blocks.empty() && written_->blocks.back().offset == 299'999; }));
  EXPECT_EQ(written_->blocks.size(), 11u);
}

}  // namespace
}  // namespace dripline::server_test
