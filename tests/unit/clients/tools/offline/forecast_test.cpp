#include "clients/tools/offline/forecast.hpp"

#include <gtest/gtest.h>
#include <algorithm>
#include <string>

#include "clients/tools/offline/offline_run.hpp"
#include "gateway/interpreter/core/program_source.hpp"
#include "gateway/interpreter/registry.hpp"

/// Reader limitation, on any line. Rows: TK-52, TK-53.
namespace dripline::interpreter {
namespace {

ForecastResult forecast(const std::string& text, const FeedLine& line) {
  MemorySource source(text);
  Forecast sink(line, text.size());
  const auto outcome = run_offline(**find_dialect("tektronix-1704"), Setup{}, source, sink);
  EXPECT_TRUE(outcome);
  return sink.finish();
}

/// A move of `counts` at 200 inch a minute, then a block of so many characters, and the end.
std::string two_blocks(int counts, std::size_t characters) {
  std::string next = "G00X900000";  // long enough to wait for nothing
  next.insert(next.begin(), characters - 1 - next.size(), ' ');
  return "%\nF2000G01X" + std::to_string(counts) + "\n" + next + "\nM30\n";
}

struct ReaderCase {
  const char* name;
  int counts;
  std::size_t characters;
  double characters_per_second;
  double feed;  ///< inch per minute: 60 L / (0.010 + (N - 1) / rate)
};
class ReaderLimit : public testing::TestWithParam<ReaderCase> {};

TEST_P(ReaderLimit, NamesTheFeedThatWouldDo) {
  const auto& row = GetParam();
  const auto result =
      forecast(two_blocks(row.counts, row.characters), {row.characters_per_second, 0.010, 0});
  ASSERT_EQ(result.starved, 1U);
  EXPECT_EQ(result.worst[0].line, 2U);
  EXPECT_EQ(result.worst[0].characters, row.characters);
  EXPECT_NEAR(result.worst[0].feed_that_would_do.inch(), row.feed, 0.05);
}

INSTANTIATE_TEST_SUITE_P(, ReaderLimit,
                         testing::Values(ReaderCase{"a_fiftieth_150", 200, 20, 150, 8.8},
                                         ReaderCase{"a_fiftieth_300", 200, 20, 300, 16.4},
                                         ReaderCase{"a_fiftieth_500", 200, 20, 500, 25.0},
                                         ReaderCase{"a_tenth_300", 1000, 20, 300, 81.8},
                                         ReaderCase{"a_tenth_long_block", 1000, 40, 300, 42.9},
                                         ReaderCase{"a_half_150", 5000, 40, 150, 111.1}),
                         [](const auto& row) { return std::string{row.param.name}; });

/// The reader that has read ahead and waits is not reading: T2 of 15 characters is .010 + 14/300 s,
/// and .05 inch in that time are 52.9 inch a minute.
TEST(Forecast, TheReadersRestIsNotReadingTime) {
  const auto result =
      forecast("%\nN001G00X5000Y5000F2000\nN002G01X5500\nN003X6000Y5100\nN004G00X9000Y9000\nM30\n",
               {300, 0.010, 0});
  ASSERT_GE(result.starved, 1U);
  const auto second = std::find_if(result.worst.begin(), result.worst.end(),
                                   [](const StarvedBlock& block) { return block.sequence == 2; });
  ASSERT_NE(second, result.worst.end());
  EXPECT_EQ(second->characters, 15U);
  EXPECT_NEAR(second->feed_that_would_do.inch(), 52.94, 0.01);
}

TEST(Forecast, TheFeedItNamesDoesIndeed) {
  EXPECT_EQ(forecast(two_blocks(1000, 20), {300, 0.010, 0}).starved, 1U);
  std::string slower = two_blocks(1000, 20);
  slower.replace(slower.find("F2000"), 5, "F818");
  EXPECT_EQ(forecast(slower, {300, 0.010, 0}).starved, 0U);
}

TEST(Forecast, ABufferCarriesShortBlocksOver) {
  // Nine long moves, then ten short ones: 0.3 s and 0.003 s each, 8 to 9 characters a block.
  std::string text = "%\nF2000G01X10000\n";
  for (int i = 2; i <= 10; ++i) text += "X" + std::to_string(i * 10'000).substr(0, 6) + "\n";
  for (int i = 1; i <= 10; ++i) text += "Y" + std::to_string(i * 100) + "\n";
  text += "G00Y0\nM30\n";
  const auto single = forecast(text, {100, 0, 0});
  const auto buffered = forecast(text, {100, 0, 200});
  EXPECT_GT(single.starved, 5U);
  EXPECT_EQ(buffered.starved, 0U);
  EXPECT_GT(single.wait_seconds, buffered.wait_seconds);
}

TEST(Forecast, NothingStarvesOnAFastLine) {
  const auto result = forecast(two_blocks(1000, 20), {1e6, 0, 0});
  EXPECT_EQ(result.starved, 0U);
  EXPECT_EQ(result.blocks, 3U);
}

}  // namespace
}  // namespace dripline::interpreter
