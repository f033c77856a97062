#include "clients/tools/comparison/text_comparison.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <algorithm>

namespace dripline::comparison {
namespace {

using interpreter::MemorySource;
using interpreter::ProgramSource;

TextResult compare(const std::string& a, const std::string& b, TextOptions options = {},
                   std::string_view control = "fanuc") {
  MemorySource first(a), second(b);
  const auto result =
      compare_text({first, a.size(), control}, {second, b.size(), control}, options);
  EXPECT_TRUE(result) << result.error().what;
  return result ? *result : TextResult{};
}

std::string apply(const std::string& a, const std::string& b, const TextResult& result) {
  std::string made;
  std::size_t at = 0;
  for (const TextHunk& hunk : result.hunks) {
    made += a.substr(at, hunk.first.offset - at);
    made += b.substr(hunk.second.offset, hunk.second.size);
    at = hunk.first.offset + hunk.first.size;
  }
  return made + a.substr(at);
}

std::string random_text() {
  const auto lines = *rc::gen::container<std::vector<std::string>>(
      rc::gen::element<std::string>("G0 X1", "G1 X2 F100", "M30", "", "\r", "(A)", "X1\r"));
  std::string text;
  for (const auto& line : lines) text += line + "\n";
  if (*rc::gen::arbitrary<bool>()) text += "X9";
  return text;
}

RC_GTEST_PROP(TextComparison, ItsHunksTurnTheFirstTextIntoTheSecond, ()) {
  const std::string a = random_text(), b = random_text();
  const TextResult result = compare(a, b);
  RC_ASSERT(apply(a, b, result) == b);
  RC_ASSERT(result.is_same == (a == b));
  for (std::size_t i = 1; i < result.hunks.size(); ++i) {
    RC_ASSERT(result.hunks[i].first.offset >
              result.hunks[i - 1].first.offset + result.hunks[i - 1].first.size);
  }
}

std::string blocks(int from, int to) {
  std::string text;
  for (int i = from; i < to; ++i) text += "X" + std::to_string(i) + "\n";
  return text;
}

TEST(TextComparison, HunksHaveTheirLinesAndTheirPlace) {
  const auto result = compare("A\nB\nC\nD\n", "A\nC\nX\nY\nD\n");
  ASSERT_EQ(result.hunks.size(), 2u);
  EXPECT_EQ(result.hunks[0].first.line, 2u);
  EXPECT_EQ(result.hunks[0].first.count, 1u);
  EXPECT_EQ(result.hunks[0].second.line, 2u);
  EXPECT_EQ(result.hunks[0].second.count, 0u);
  EXPECT_EQ(result.hunks[1].first.line, 4u);
  EXPECT_EQ(result.hunks[1].second.line, 3u);
  EXPECT_EQ(result.hunks[1].second.count, 2u);
}

TEST(TextComparison, ManyWindowsApartItFindsEachChange) {
  const std::string middle = blocks(0, 50'000), end = blocks(50'000, 90'000);
  const std::string a = "(A)\n" + middle + "G4 P1\n" + end + "M2\n";
  const std::string b = "(B)\n" + blocks(-3000, 0) + middle + end + "M30\n";
  const auto result = compare(a, b);
  EXPECT_EQ(apply(a, b, result), b);
  EXPECT_EQ(result.hunk_count, 3u);
  EXPECT_EQ(result.first_lines, 3u);
  EXPECT_EQ(result.second_lines, 3002u);
}

TEST(TextComparison, TextsWithoutACommonLineAreOneHunk) {
  std::string a, b;
  for (int i = 0; i < 200'000; ++i) {
    a += "X" + std::to_string(i) + "\n";
    b += "Y" + std::to_string(i) + "\n";
  }
  const auto result = compare(a, b);
  EXPECT_EQ(result.hunk_count, 1u);
  EXPECT_EQ(result.second_lines, 200'000u);
}

TEST(TextComparison, AMissingEndOfTheLastLineIsADifference) {
  EXPECT_FALSE(compare("M30\n", "M30").is_same);
  EXPECT_EQ(compare("M30\n", "M30").change, TextChange::None);
}

TEST(TextComparison, NormalizedIgnoresNumbersCommentsBlanksCaseAndFormsOfNumbers) {
  const TextOptions normalized{.normalized = true};
  const std::string a = "O0100\nN10 G01 X1.0 Y2.50 (CUT)\nN20 M30\n";
  const std::string b = "(NEW)\r\no100\r\n\r\nN5 g1x1.y2.5\r\nm30";
  EXPECT_TRUE(compare(a, b, normalized).is_same);
  EXPECT_FALSE(compare(a, b).is_same);
  const auto other = compare(a, "O100\nG1 X1. Y2.6\nM30\n", normalized);
  ASSERT_EQ(other.hunks.size(), 1u);
  EXPECT_EQ(other.hunks[0].first.line, 2u);
  EXPECT_EQ(other.hunks[0].second.line, 2u);
}

struct ClassCase {
  std::string_view name;
  std::string a, b;
  TextChange expected;
};
class ClassOfAnEdit : public testing::TestWithParam<ClassCase> {};
TEST_P(ClassOfAnEdit, Is) {
  EXPECT_EQ(compare(GetParam().a, GetParam().b).change, GetParam().expected);
}
INSTANTIATE_TEST_SUITE_P(
    , ClassOfAnEdit,
    testing::Values(
        ClassCase{"comment", "G1 X1 (A)\nM30\n", "(B)\nG01 X1\nM30\n", TextChange::None},
        ClassCase{"numbers", "N1 X1\nN2 M30\n", "N10 X1\nN20 M30\n", TextChange::BlockNumbers},
        ClassCase{"feed", "G1 X1. F100\nM30\n", "(A)\nG1 X1. F90\nM30\n", TextChange::FeedAndSpeed},
        ClassCase{"offsets", "G54\nG1 X1. F1\n", "G55\nG1 X1. F2\n", TextChange::Offsets},
        ClassCase{"geometry", "X1.\nX2.\n", "X1.\nX3.\n", TextChange::Other}),
    [](const auto& tested) { return std::string(tested.param.name); });

/// A text of any size that repeats one piece, with another line somewhere.
class LongSource final : public ProgramSource {
 public:
  LongSource(std::uint64_t size, std::uint64_t changed) : size_(size), changed_(changed) {
    while (piece_.size() < kPiece) piece_ += "G1 X10.123 Y-4.5\n";
    piece_.resize(kPiece - 1);
    piece_ += '\n';
    other_ = piece_;
    other_.replace(other_.find('X'), 6, "X99.12");
  }
  interpreter::TextWindow fetch(interpreter::ProgramIndex, std::uint64_t offset,
                                std::size_t) override {
    interpreter::TextWindow window{interpreter::TextWindow::State::Ready, {}, false, {}};
    const std::string& piece = offset / kPiece == changed_ ? other_ : piece_;
    if (offset < size_) window.text = std::string_view(piece).substr(offset % kPiece);
    largest_ = std::max(largest_, window.text.size());
    window.reaches_end = offset + window.text.size() >= size_;
    return window;
  }
  interpreter::ProgramLookup find(std::string_view) override { return {}; }

  static constexpr std::uint64_t kPiece = 1 << 16;

 private:
  std::uint64_t size_, changed_;
  std::string piece_, other_;
  std::size_t largest_ = 0;
};

TEST(TextComparison, OneChangedLineOfAGibibyteIsFoundInBoundedMemory) {
  constexpr std::uint64_t kSize = 1 << 30;
  constexpr std::uint64_t kChanged = 9000;
  LongSource first(kSize, kSize), second(kSize, kChanged);
  const auto result = compare_text({first, kSize, "fanuc"}, {second, kSize, "fanuc"});
  ASSERT_TRUE(result);
  ASSERT_EQ(result->hunks.size(), 1u);
  EXPECT_EQ(result->hunks[0].first.offset, kChanged * LongSource::kPiece);
  EXPECT_EQ(result->first_lines, 1u);
  EXPECT_EQ(result->change, TextChange::Other);
}

TEST(TextComparison, ALineBeyondTheLimitIsComparedInParts) {
  const std::string a = std::string(200'000, 'A') + "\nM30\n";
  std::string b = a;
  b[150'000] = 'B';
  EXPECT_EQ(apply(a, b, compare(a, b)), b);
}

}  // namespace
}  // namespace dripline::comparison
