#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "gateway/interpreter/core/program_source.hpp"
#include "gateway/interpreter/registry.hpp"
#include "protocol/wire/tape_image.hpp"
#include "tests/support/event_log.hpp"

/// Punched tapes of the 1704, from rows of holes to motion. Rows: TK-02, TK-03, TK-05, TK-07.
namespace dripline::interpreter {
namespace {

using wire::CharacterCode;

constexpr std::string_view kProgram = "%\nN1X10000Y5000F800M03\nN2G01X20000\nM30\n";

std::vector<std::byte> punched(CharacterCode code, std::string_view text = kProgram) {
  wire::TapePunch punch({.code = code,
                         .end_of_block = wire::EndOfBlock::Lf,
                         .leader = 40,
                         .trailer = 20,
                         .title = "P7"});
  std::vector<std::byte> rows;
  EXPECT_TRUE(punch.begin(rows));
  EXPECT_TRUE(punch.punch(text, rows));
  punch.finish(rows);
  return rows;
}

Result<std::string> read(CharacterCode code, const std::vector<std::byte>& rows) {
  wire::TapeReader reader({.code = code});
  std::string text;
  if (const auto done = reader.read(rows, text); !done) return fail(done.error());
  if (const auto done = reader.finish(text); !done) return fail(done.error());
  return text;
}

std::vector<std::string> run(const std::string& text) {
  MemorySource source(text);
  EventLog log;
  auto interpreter = (*find_dialect("tektronix-1704"))->make(Setup{}, source, log);
  EXPECT_TRUE(interpreter);
  while ((*interpreter)->step(100) == StepState::Ran) {
  }
  return log.lines();
}

class TapeOfCode : public testing::TestWithParam<CharacterCode> {};

TEST_P(TapeOfCode, RunsAsItsListing) {
  const auto text = read(GetParam(), punched(GetParam()));
  ASSERT_TRUE(text) << text.error().what;
  EXPECT_EQ(run(*text), run(std::string(kProgram)));
}

TEST_P(TapeOfCode, IsRefusedWithTheOtherCodeChosen) {
  const auto other = GetParam() == CharacterCode::Eia ? CharacterCode::Iso : CharacterCode::Eia;
  EXPECT_FALSE(read(other, punched(GetParam())));
}

TEST_P(TapeOfCode, DeletesMeanNothingAnywhere) {
  const std::byte all_holes{GetParam() == CharacterCode::Eia ? std::uint8_t{0x7f}
                                                             : std::uint8_t{0xff}};
  std::vector<std::byte> rows;
  for (const std::byte row : punched(GetParam())) {
    rows.push_back(row);
    if (rows.size() > 60) rows.push_back(all_holes);
  }
  const auto text = read(GetParam(), rows);
  ASSERT_TRUE(text) << text.error().what;
  EXPECT_EQ(run(*text), run(std::string(kProgram)));
}

TEST_P(TapeOfCode, AHoleTooManyStopsTheReaderAndNamesTheRow) {
  auto rows = punched(GetParam());
  const std::size_t in_a_block = rows.size() - 35;
  rows[in_a_block] ^= std::byte{0x08};
  const auto text = read(GetParam(), rows);
  ASSERT_FALSE(text);
  EXPECT_EQ(text.error().code, Errc::Corrupt);
  EXPECT_NE(text.error().what.find(std::to_string(in_a_block + 1)), std::string::npos)
      << text.error().what;
}

INSTANTIATE_TEST_SUITE_P(, TapeOfCode, testing::Values(CharacterCode::Eia, CharacterCode::Iso),
                         [](const auto& row) {
                           return std::string(row.param == CharacterCode::Eia ? "eia" : "iso");
                         });

}  // namespace
}  // namespace dripline::interpreter
