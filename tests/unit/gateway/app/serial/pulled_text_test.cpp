#include "gateway/app/serial/pulled_text.hpp"

#include <gtest/gtest.h>
#include <algorithm>
#include <span>

namespace dripline::gateway {
namespace {

using std::chrono::seconds;

std::string program_text(std::size_t bytes) {
  std::string text;
  while (text.size() < bytes) text += "G1 X" + std::to_string(text.size()) + ".\n";
  text.resize(bytes);
  return text;
}

/// A text that is pulled, and a server in the test's hands that has it.
class PulledTextTest : public testing::Test {
 protected:
  PulledText make(std::size_t buffer) {
    return {feed::FeedRun{"mill-3", 7, "r-1", text_.size()},
            {.bytes = buffer},
            [this](const dds::BlockRequest& request) {
              asked_.push_back(request);
              return true;
            }};
  }
  /// Until nothing more is asked for.
  void serve(PulledText& pulled) {
    now_ += seconds(10);
    for (pulled.feed().poll(now_); !asked_.empty(); pulled.feed().poll(now_)) {
      for (const auto& request : std::exchange(asked_, {})) answer(request, pulled);
    }
  }

  std::string text_ = program_text(300'000);
  std::vector<dds::BlockRequest> asked_;

 private:
  void answer(const dds::BlockRequest& request, PulledText& pulled) {
    const std::size_t end = std::min<std::size_t>(text_.size(), request.offset + request.length);
    for (std::size_t at = request.offset; at < end;) {
      const std::size_t length = std::min(dds::kMaxBlockBytes, end - at);
      const auto bytes = std::as_bytes(std::span(text_).subspan(at, length));
      dds::BlockData data;
      data.machine = request.machine;
      data.session = request.session;
      data.run = request.run;
      data.offset = at;
      data.total_bytes = text_.size();
      data.bytes = {bytes.begin(), bytes.end()};
      at += length;
      data.ends = at == text_.size();
      pulled.feed().on_data(data, now_);
    }
  }

  SteadyTime now_{};
};

TEST_F(PulledTextTest, ReachesAsFarAsItsBufferWithoutAServer) {
  PulledText pulled = make(100'000);
  EXPECT_EQ(pulled.read(0, 1000).value(), "") << "it has not come yet";
  serve(pulled);
  const std::uint64_t ahead = pulled.bytes_ahead();
  EXPECT_GE(ahead, 100'000U);
  EXPECT_FALSE(pulled.is_complete());
  std::uint64_t at = 0;
  for (std::string piece; at < ahead; at += piece.size()) {  // no one serves any more
    piece = pulled.read(at, 1000).value();
    ASSERT_FALSE(piece.empty()) << at;
    ASSERT_EQ(piece, text_.substr(at, piece.size()));
    EXPECT_EQ(pulled.bytes_ahead(), ahead - at - piece.size());
  }
  EXPECT_EQ(pulled.read(at, 1000).value(), "");
  serve(pulled);
  EXPECT_EQ(pulled.read(at, 1000).value(), text_.substr(at, 1000))
      << "it continues where it waited";
}

TEST_F(PulledTextTest, StatesWhenAllOfTheRestIsHere) {
  PulledText pulled = make(1'000'000);
  ASSERT_EQ(pulled.read(0, 1).value(), "");
  serve(pulled);
  EXPECT_TRUE(pulled.is_complete());
  std::uint64_t at = 0;
  while (at < text_.size()) at += pulled.read(at, 32 * 1024).value().size();
  EXPECT_EQ(pulled.bytes_ahead(), 0U);
  EXPECT_EQ(pulled.feed().content_digest().hex(), sha256(text_).hex());
  EXPECT_EQ(pulled.feed().content_length(), text_.size());
}

/// Also at the moment before more is asked for.
TEST_F(PulledTextTest, NeverHasLessThanItsBufferWhileTheServerIsThere) {
  PulledText pulled = make(50'000);
  ASSERT_EQ(pulled.read(0, 1).value(), "");
  serve(pulled);
  for (std::uint64_t at = 0; at < 150'000;) {
    at += pulled.read(at, 1000).value().size();
    serve(pulled);
    ASSERT_GE(pulled.bytes_ahead(), 50'000U) << at;
  }
}

TEST(PulledTextBuffer, IsMinutesOfTheLineWithinBounds) {
  EXPECT_EQ(PulledText::buffer_for(480, seconds(600)).bytes, 288'000U);
  EXPECT_EQ(PulledText::buffer_for(30, seconds(1)).bytes, PulledText::kMinBuffer);
  EXPECT_EQ(PulledText::buffer_for(11'520, seconds(86'400)).bytes, PulledText::kMaxBuffer);
}

}  // namespace
}  // namespace dripline::gateway
