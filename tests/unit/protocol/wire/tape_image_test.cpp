#include "protocol/wire/tape_image.hpp"

#include <gtest/gtest.h>
#include <algorithm>

namespace dripline::wire {
namespace {

using enum CharacterCode;

constexpr std::string_view kProgram = "N1G1X-25Y4F8\nN2Y0\nN3M30\n";

std::vector<std::byte> bytes(std::string_view text) {
  const auto view = std::as_bytes(std::span(text));
  return {view.begin(), view.end()};
}

std::vector<std::byte> punched(const TapeForm& form, std::string_view text,
                               std::size_t piece = 1000) {
  std::vector<std::byte> rows;
  TapePunch punch(form);
  EXPECT_TRUE(punch.begin(rows));
  for (std::size_t at = 0; at < text.size(); at += piece) {
    EXPECT_TRUE(punch.punch(text.substr(at, piece), rows));
  }
  punch.finish(rows);
  return rows;
}

struct ReadTape {
  std::string text, error;
  TapeSummary summary;
};

ReadTape read(const TapeReading& reading, std::span<const std::byte> rows,
              std::size_t piece = 1000) {
  ReadTape result;
  TapeReader reader(reading);
  Result<void> done;
  for (; done && !rows.empty(); rows = rows.subspan(std::min(piece, rows.size()))) {
    done = reader.read(rows.first(std::min(piece, rows.size())), result.text);
  }
  if (done) done = reader.finish(result.text);
  if (!done) result.error = done.error().what;
  result.summary = reader.summary();
  return result;
}

TEST(TapeImage, HasLeaderRewindStopEndOfBlockAndTrailer) {
  TapeForm form;
  form.code = Eia;
  form.leader = 2;
  form.trailer = 3;
  using namespace std::string_view_literals;
  EXPECT_EQ(punched(form, "G4\n"), bytes("\0\0\x0B\x80\x67\x04\x80\0\0\0"sv));
  EXPECT_EQ(punched(form, "%\nG4"), bytes("\0\0\x0B\x80\x67\x04\x80\0\0\0"sv));
  form.has_rewind_stop = false;
  EXPECT_EQ(punched(form, "G4\n"), bytes("\0\0\x67\x04\x80\0\0\0"sv));
}

class BothCodes : public testing::TestWithParam<CharacterCode> {};

TEST_P(BothCodes, ReadBackWhatWasPunchedHoweverItIsCut) {
  TapeForm form;
  form.code = GetParam();
  form.title = "SHAFT-4 2/3";
  const auto rows = punched(form, kProgram);
  EXPECT_EQ(punched(form, kProgram, 1), rows);
  for (const std::size_t piece : {std::size_t{1}, std::size_t{7}, rows.size()}) {
    const auto tape = read({form.code}, rows, piece);
    EXPECT_EQ(tape.error, "");
    EXPECT_EQ(tape.text, "%\n" + std::string(kProgram));
    EXPECT_EQ(tape.summary.blocks, 4U);
    EXPECT_EQ(tape.summary.leader, 100U);
    EXPECT_EQ(tape.summary.trailer, 100U);
    EXPECT_TRUE(tape.summary.has_rewind_stop);
    EXPECT_GT(tape.summary.skipped, 30U);  // the title
    EXPECT_EQ(tape.summary.lost_block, "");
  }
}

TEST_P(BothCodes, LeavesOutDeletedRowsInTheMiddleOfAWord) {
  TapeForm form;
  form.code = GetParam();
  auto rows = punched(form, kProgram);
  rows.insert(rows.begin() + 108, 3, std::byte{delete_row(form.code)});
  const auto tape = read({form.code}, rows);
  EXPECT_EQ(tape.text, "%\n" + std::string(kProgram));
  EXPECT_EQ(tape.summary.deletes, 3U);
}

TEST_P(BothCodes, FindsAFlippedHoleAfterTheFirstEndOfBlockAndNotBefore) {
  TapeForm form;
  form.code = GetParam();
  form.leader = 0;
  form.end_of_block = EndOfBlock::Lf;
  auto rows = punched(form, kProgram);
  rows[4] ^= std::byte{0x02};
  const auto tape = read({form.code}, rows);
  EXPECT_NE(tape.error.find("row 5, line 2, column 3: 0x"), std::string::npos) << tape.error;
  auto replaced = read({form.code, true, true}, rows);
  EXPECT_EQ(replaced.summary.wrong, 1U);
  EXPECT_EQ(replaced.text, "%\nN1?1X-25Y4F8\nN2Y0\nN3M30\n");
  rows = punched(form, kProgram);
  rows.insert(rows.begin(), {std::byte{0x03}, std::byte{0x07}});
  EXPECT_EQ(read({form.code}, rows).error, "");
}

INSTANTIATE_TEST_SUITE_P(, BothCodes, testing::Values(Eia, Iso),
                         [](const auto& tested) { return std::string(code_name(tested.param)); });

TEST(TapeImage, EndsAtTheClosingRewindStopAndReadsOnAfterTheNextEndOfBlock) {
  TapeForm form;
  form.leader = 0;
  auto rows = punched(form, "N1M2\n%\n%\nN5M30\n%");
  rows.insert(rows.end(), {std::byte{0x01}, std::byte{0x02}});  // junk after the trailer
  const auto tape = read({Iso}, std::span(rows).first(rows.size() - 2));
  EXPECT_EQ(tape.text, "%\nN1M2\n%\n%\nN5M30\n%\n") << tape.error;
}

TEST(TapeImage, ReportsTheBlockThatIsLostWithoutAnEndOfBlockBeforeIt) {
  TapeForm form;
  form.has_rewind_stop = false;
  const auto rows = punched(form, kProgram);
  const auto tape = read({Iso}, rows);
  EXPECT_EQ(tape.text, "N2Y0\nN3M30\n");
  EXPECT_EQ(tape.summary.lost_block, "N1G1X-25Y4F8");
  EXPECT_EQ(read({Iso, false}, rows).text, kProgram);
}

TEST(TapeImage, TakesBlanksInsideAnEiaBlockOrNot) {
  TapeForm form;
  form.code = Eia;
  auto rows = punched(form, kProgram);
  rows.insert(rows.begin() + 104, std::byte{0});
  EXPECT_EQ(read({Eia}, rows).text, "%\n" + std::string(kProgram));
  EXPECT_NE(read({Eia, true, false, true}, rows).error, "");
  EXPECT_EQ(read({Eia, true, false, true}, punched(form, kProgram)).error, "");
}

TEST(TapeImage, RefusesATapeWithoutABlock) {
  const auto tape = read({Iso}, bytes("\x11\x22\x33"));
  EXPECT_EQ(tape.error, "3 rows without an end of block of the ISO code");
}

TEST(TapeImage, RefusesFeedAndTitlesBeyondTheirLimits) {
  std::vector<std::byte> rows;
  TapeForm form;
  form.leader = kMaxTapeFeed + 1;
  EXPECT_FALSE(TapePunch(form).begin(rows));
  form.leader = 0;
  form.title = std::string(kMaxTapeTitle + 1, 'A');
  EXPECT_FALSE(TapePunch(form).begin(rows));
  form.title = "a";
  EXPECT_FALSE(TapePunch(form).begin(rows));
  EXPECT_TRUE(rows.empty());
}

TEST(TapeTitle, HoldsNoEndOfBlockOfAnyCode) {
  std::vector<std::byte> rows;
  ASSERT_TRUE(punch_title("ABCDEFGHIJKLMNOPQRSTUVWXYZ 0123456789-./", rows));
  for (const auto row : rows) {
    for (const auto code : {Eia, Iso, Ascii}) {
      const auto kind = decode_row(code, static_cast<std::uint8_t>(row)).kind;
      EXPECT_NE(kind, RowKind::BlockEnd);
      EXPECT_NE(kind, RowKind::CarriageReturn);
    }
  }
}

}  // namespace
}  // namespace dripline::wire
