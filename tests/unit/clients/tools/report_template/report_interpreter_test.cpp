#include "tests/unit/clients/tools/report_template/reading.hpp"

namespace dripline::report_template {
namespace {

TEST(ReportInterpreter, TakesLimitsFromTheLine) {
  Reading reading("[[line]]\nform = '{characteristic} {actual} NOM {nominal} TOL {tolerance}'\n");
  reading.take("D1 40.018 NOM 40.000 TOL 0.020").take("D1 40.021 NOM 40. TOL .02").end();
  EXPECT_EQ(reading.brought, (Brought{"[", "D1=40.018 good", "D1=40.021 scrap", "] scrap"}));
  EXPECT_EQ(reading.values[0].characteristic.lower, 40 - 0.02);
  EXPECT_EQ(reading.values[0].characteristic.decimals, 3);
}

TEST(ReportInterpreter, TakesLimitsFromTheTemplate) {
  Reading reading(R"(
unit = "inch"
[[line]]
form = "{characteristic} {actual}"
[characteristic.B]
name = "bore"
nominal = 1.5
upper_deviation = 0.002
lower_deviation = 0.001
rework = "below"
tool = "T3"
[characteristic.F]
upper = 0.01
)");
  reading.take("B 1.5000").take("B 1.5015").take("F 0.01").take("F 0.011").take("X 7").end();
  EXPECT_EQ(reading.brought, (Brought{"[", "bore=1.5000 rework", "bore=1.5015 good", "F=0.01 good",
                                      "F=0.011 scrap", "X=7 unknown", "] scrap"}));
  EXPECT_EQ(reading.values[0].tool, "T3");
  EXPECT_EQ(reading.values[0].characteristic.unit, "inch");
}

TEST(ReportInterpreter, ComputesTheActualValueFromTheDeviation) {
  Reading reading("[[line]]\nform = '{characteristic} NOM {nominal} DEV {deviation}'\n");
  reading.take("D NOM 10.000 DEV -  0.012");
  EXPECT_EQ(reading.brought, (Brought{"[", "D=9.988 unknown"}));
}

TEST(ReportInterpreter, ListsWhatMatchesNothing) {
  Reading reading("[[line]]\nform = 'D {actual}'\ncharacteristic = 'D'\n");
  reading.take("D 1.0").take("SPINDLE LOAD 12").take("D 1.0X").end();
  EXPECT_EQ(reading.brought,
            (Brought{"[", "D=1.0 unknown", "? SPINDLE LOAD 12", "? D 1.0X", "] unknown"}));
}

TEST(ReportInterpreter, KeepsTextsForTheLinesThatFollow) {
  Reading reading(R"(
[[line]]
form = "PART {part} SERIAL {serial}"
starts_part = true
[[line]]
form = "TOOL {tool} UNIT {unit}"
[[line]]
form = "BORE {feature}"
[[line]]
form = "D {actual}"
characteristic = "bore {feature}"
)");
  reading.take("PART A7 SERIAL 12").take("TOOL T4 UNIT INCH").take("BORE 3").take("D 1.0");
  EXPECT_EQ(reading.interpreter().state().part.number, "A7");
  EXPECT_EQ(reading.interpreter().state().part.serial, "12");
  reading.take("PART A7 SERIAL 13").take("D 1.0").end();
  EXPECT_EQ(reading.brought,
            (Brought{"[", "bore 3=1.0 unknown", "] unknown", "[",
                     "bad_value: field feature of 'bore {feature}' did not come", "] unknown"}));
  EXPECT_EQ(reading.values[0].tool, "T4");
  EXPECT_EQ(reading.values[0].characteristic.unit, "inch");
}

TEST(ReportInterpreter, EndsAPartWhenTheSerialNumberChanges) {
  Reading reading("[[line]]\nform = '{serial} D {actual}'\ncharacteristic = 'D'\n");
  reading.take("1 D 1.0").take("1 D 1.1").take("2 D 1.2").end();
  EXPECT_EQ(reading.brought, (Brought{"[", "D=1.0 unknown", "D=1.1 unknown", "] unknown", "[",
                                      "D=1.2 unknown", "] unknown"}));
}

constexpr const char* kSpread = R"(
[[line]]
form = ["NAME {characteristic}", "NOM {nominal} TOL {tolerance}", "ACT {actual}"]
[[line]]
form = "---"
ignore = true
[[line]]
form = "SINGLE {actual}"
characteristic = "single"
)";

TEST(ReportInterpreter, PutsLinesTogetherThatFollowEachOther) {
  Reading reading(kSpread);
  reading.take("NAME A").take("---").take("NOM 5.0 TOL 0.1").take("ACT 5.2").end();
  EXPECT_EQ(reading.brought, (Brought{"[", "A=5.2 scrap", "] scrap"}));
}

TEST(ReportInterpreter, ReportsLinesThatDoNotFollow) {
  Reading reading(kSpread);
  reading.take("NAME A").take("SINGLE 1.0").take("NAME B").end();
  EXPECT_EQ(reading.brought,
            (Brought{"incomplete: 'NOM {nominal} TOL {tolerance}' did not come after 'NAME A'", "[",
                     "single=1.0 unknown",
                     "incomplete: 'NOM {nominal} TOL {tolerance}' did not come after 'NAME B'",
                     "] unknown"}));
}

TEST(ReportInterpreter, TakesANominalFromTheLineBefore) {
  Reading reading(R"(
[[line]]
form = "NOM {nominal} TOL {tolerance}"
[[line]]
form = "ACT {actual}"
characteristic = "D"
)");
  reading.take("NOM 5.0 TOL 0.1").take("ACT 5.05").take("ACT 5.05");
  EXPECT_EQ(reading.brought, (Brought{"[", "D=5.05 good", "D=5.05 unknown"})) << "for one value";
}

constexpr const char* kCounted = R"(
[[line]]
form = "BEGIN"
starts_part = true
[[line]]
form = "{count} D {actual}"
characteristic = "D{count}"
lower = 0
[[line]]
form = "END {expected}"
ends_part = true
)";

TEST(CountedReport, IsCompleteInOrder) {
  Reading reading(kCounted);
  reading.take("BEGIN").take("1 D 1").take("2 D 1").take("END 2");
  EXPECT_EQ(reading.brought, (Brought{"[", "D1=1 good", "D2=1 good", "] good"}));
}

TEST(CountedReport, NamesMissingLines) {
  Reading reading(kCounted);
  reading.take("BEGIN").take("2 D 1").take("5 D 1").take("END 7");
  EXPECT_EQ(reading.brought, (Brought{"[", "D2=1 good", "D5=1 good", "missing: line 1 did not come",
                                      "missing: lines 3 to 4 did not come",
                                      "missing: lines 6 to 7 did not come", "] unknown"}));
}

TEST(CountedReport, TakesADoubledLineOnce) {
  Reading reading(kCounted);
  reading.take("BEGIN").take("1 D 1").take("1 D 1").take("END 1");
  EXPECT_EQ(reading.brought, (Brought{"[", "D1=1 good", "doubled: line 1 came again", "] good"}));
}

TEST(CountedReport, IsUnknownWhereALineCameWithTwoValues) {
  Reading reading(kCounted);
  reading.take("BEGIN").take("1 D 20.000").take("1 D 29.000").take("2 D 20.000").take("END 2");
  EXPECT_EQ(reading.brought,
            (Brought{"[", "D1=20.000 good",
                     "doubled: line 1 came again as '1 D 29.000', first as '1 D 20.000'",
                     "D2=20.000 good", "] unknown"}));
  Reading late(kCounted);
  late.take("BEGIN").take("2 D 1").take("1 D 1").take("1  D \t1").take("1 D 2").take("END 2");
  EXPECT_EQ(late.brought.at(4), "doubled: line 1 came again") << "blanks do not matter";
  EXPECT_EQ(late.brought.at(5), "doubled: line 1 came again as '1 D 2', first as '1 D 1'");
  EXPECT_EQ(late.brought.back(), "] unknown");
}

TEST(CountedReport, ComparesLongLinesToTheirEnds) {
  Reading reading(
      "[[line]]\nform = '{count} D {actual} {note:text}'\ncharacteristic = 'D'\nlower = 0\n");
  const std::string line = "1 D 1 " + std::string(300, 'x');
  reading.take(line + "\xc3\xa4").take(line + "\xc3\xa4");
  EXPECT_EQ(reading.brought.back(), "doubled: line 1 came again");
  reading.take(line + "\xc3\xb6").end();
  EXPECT_EQ(reading.brought.back(), "] unknown");
}

TEST(CountedReport, IsUnknownWithMoreLinesThanExpected) {
  Reading reading(kCounted);
  reading.take("BEGIN").take("1 D 1").take("2 D 1").take("3 D 1").take("END 2");
  EXPECT_EQ(reading.brought, (Brought{"[", "D1=1 good", "D2=1 good", "D3=1 good",
                                      "doubled: line 3 came, 2 were expected", "] unknown"}));
}

TEST(CountedReport, KeepsSomeLinesToCompare) {
  Reading reading(kCounted);
  reading.take("BEGIN");
  for (int i = 1; i <= 600; ++i) reading.take(fmt::format("{} D 1", i));
  EXPECT_EQ(reading.interpreter().state().kept.size(), 256u);
  reading.take("600 D 1").take("1 D 1").take("END 600");
  EXPECT_EQ(reading.brought.at(601), "doubled: line 600 came again");
  EXPECT_EQ(reading.brought.at(602),
            "doubled: line 1 came again as '1 D 1', too late to be compared with the first");
  EXPECT_EQ(reading.brought.back(), "] unknown");
}

TEST(CountedReport, TakesALateLine) {
  Reading reading(kCounted);
  reading.take("BEGIN").take("1 D 1").take("4 D 1").take("3 D 1").take("2 D 1").take("3 D 1");
  reading.take("END 4");
  EXPECT_EQ(reading.brought,
            (Brought{"[", "D1=1 good", "D4=1 good", "reordered: line 3 came after line 4",
                     "D3=1 good", "reordered: line 2 came after line 4", "D2=1 good",
                     "doubled: line 3 came again", "] good"}));
}

/// A count that is none, or cannot be read: its value is no other line's.
TEST(CountedReport, TakesNothingOfALineWithABadCount) {
  for (const auto& [count, why] :
       {std::pair("0", "at least 1"), std::pair("-1", "at least 1"),
        std::pair("99999999999", "no whole number, or too large"),
        std::pair("9999999999999999999", "'9999999999999999999' has more than 18 digits")}) {
    Reading reading(kCounted);
    reading.take("BEGIN").take("1 D 1").take(fmt::format("{} D 7", count)).take("2 D 1");
    reading.take("END 2");
    EXPECT_EQ(reading.brought,
              (Brought{"[", "D1=1 good", fmt::format("bad_value: count '{}': {}", count, why),
                       "D2=1 good", "] unknown"}));
  }
}

TEST(CountedReport, IsUnknownWithAnEndThatCountsNothing) {
  Reading negative(kCounted);
  negative.take("BEGIN").take("1 D 1").take("END -1");
  EXPECT_EQ(negative.brought,
            (Brought{"[", "D1=1 good", "bad_value: expected '-1': at least 0", "] unknown"}));
  Reading large(kCounted);
  large.take("BEGIN").take("1 D 1").take("END 99999999999");
  EXPECT_EQ(large.brought.back(), "] unknown");
}

TEST(CountedReport, GivesTheValueOfABadCountNoName) {
  Reading reading(R"([[line]]
form = "LINE {count}"
[[line]]
form = "D {actual}"
characteristic = "D{count}"
lower = 0
)");
  reading.take("LINE 1").take("D 1").take("LINE 0").take("D 7").end();
  EXPECT_EQ(reading.brought,
            (Brought{"[", "D1=1 good", "bad_value: count '0': at least 1",
                     "bad_value: field count of 'D{count}' did not come", "] unknown"}));
}

TEST(ReportInterpreter, GivesAValueNoOtherNameWhereItsOwnIsTooLong) {
  Reading reading("[[line]]\nform = '{characteristic} {actual}'\nlower = 0\n");
  reading.take("A 1").take(std::string(129, 'B') + " 7").end();
  EXPECT_EQ(reading.brought,
            (Brought{"[", "A=1 good", "bad_value: characteristic of 129 characters: at most 128",
                     "bad_value: a value without a characteristic", "] unknown"}));
}

TEST(ReportInterpreter, NamesEachValueThatCannotBeRead) {
  const std::string digits(20, '9');
  Reading reading(
      "[[line]]\nform = 'X{actual.X} Y{actual.Y} Z{actual.Z}'\ncharacteristic = "
      "'{characteristic}'\nlower = 0\n");
  reading.take(fmt::format("X{} Y{} Z1", digits, digits)).end();
  EXPECT_EQ(
      reading.brought,
      (Brought{fmt::format("bad_value: actual.X '{0}': '{0}' has more than 18 digits", digits),
               fmt::format("bad_value: actual.Y '{0}': '{0}' has more than 18 digits", digits), "[",
               "Z=1 good", "] unknown"}));
}

TEST(CountedReport, BeginsAgainWithItsFirstNumber) {
  Reading reading("[[line]]\nform = '{count} D {actual}'\ncharacteristic = 'D'\n");
  reading.take("1 D 1").take("2 D 2").take("1 D 3").end();
  EXPECT_EQ(reading.brought, (Brought{"[", "D=1 unknown", "D=2 unknown", "] unknown", "[",
                                      "D=3 unknown", "] unknown"}));
}

TEST(CountedReport, HasBoundedMemoryOfGaps) {
  Reading reading(kCounted);
  reading.take("BEGIN");
  for (int i = 1; i <= 600; ++i) reading.take(fmt::format("{} D 1", 2 * i));
  EXPECT_LE(reading.interpreter().state().missing.size(), 256u);
  reading.take("END 1200");
  EXPECT_EQ(std::ranges::count_if(reading.brought,
                                  [](const auto& one) { return one.starts_with("missing"); }),
            600);
}

TEST(CountedReport, IsUnknownWithoutItsEnd) {
  Reading next(kCounted);
  next.take("BEGIN").take("1 D 1").take("BEGIN").take("1 D 1").take("END 1");
  EXPECT_EQ(next.brought, (Brought{"[", "D1=1 good",
                                   "incomplete: the part's end did not come: the next part began",
                                   "] unknown", "[", "D1=1 good", "] good"}));
  Reading over(kCounted);
  over.take("BEGIN").take("1 D 1").end();
  EXPECT_EQ(over.brought,
            (Brought{"[", "D1=1 good", "incomplete: the part's end did not come: the report ended",
                     "] unknown"}));
}

TEST(ReportInterpreter, MissesTheEndWhenTheSerialNumberChanges) {
  Reading reading(
      "[[line]]\nform = '{serial} D {actual}'\ncharacteristic = 'D'\nlower = 0\n[[line]]\n"
      "form = 'END'\nends_part = true\n");
  reading.take("1 D 1").take("2 D 1").take("END");
  EXPECT_EQ(
      reading.brought,
      (Brought{"[", "D=1 good", "incomplete: the part's end did not come: serial number 2 came",
               "] unknown", "[", "D=1 good", "] good"}));
}

TEST(ReportInterpreter, CountsLinesWithoutNumbers) {
  const std::string counted =
      "expected = 3\n[[line]]\nform = '{characteristic} {actual}'\nlower = 0\n";
  EXPECT_EQ(Reading(counted).take("A 1").take("B 1").end().brought.at(3),
            "missing: 2 lines with values came, 3 were expected");
  EXPECT_EQ(Reading(counted).take("A 1").take("B 1").take("C 1").end().brought.at(4), "] good");
}

TEST(ReportInterpreter, MissesRequiredCharacteristics) {
  Reading reading(
      "[[line]]\nform = '{characteristic} {actual}'\n[characteristic.A]\nlower = 0\n"
      "[characteristic.B]\nrequired = true\n");
  reading.take("A 1").end();
  EXPECT_EQ(reading.brought,
            (Brought{"[", "A=1 good", "incomplete: B was not measured", "] unknown"}));
}

TEST(ReportInterpreter, RefusesLimitsThatExcludeEachOther) {
  Reading reading("[[line]]\nform = '{characteristic} {actual} {lower} {upper}'\n");
  reading.take("A 1 3 2").end();
  EXPECT_EQ(
      reading.brought,
      (Brought{"[", "bad_value: A: its lower limit 3 is above its upper limit 2", "] unknown"}));
}

TEST(ReportInterpreter, TakesOnlyItsSources) {
  Reading reading(
      "sources = ['probe']\n[[line]]\nform = 'PROBE contact Z {actual}'\n"
      "characteristic = 'Z{ordinal}'\n");
  reading.take("PROBE contact Z 1.0");
  EXPECT_TRUE(reading.brought.empty());
  reading.take(R"({"to":{"Z":-5},"until":"contact","tripped":true,"at":{"Z":-1.25}})", "probe");
  reading.take(R"({"to":{"Z":-5},"until":"contact","tripped":false,"at":{"Z":-5}})", "probe");
  EXPECT_EQ(reading.brought,
            (Brought{"[", "Z1=-1.250000 unknown",
                     R"(? {"to":{"Z":-5},"until":"contact","tripped":false,"at":{"Z":-5}})"}));
}

/// Whatever the lines are, the state can be written and read between any two of them.
TEST(ReportState, IsTheSameOverARestart) {
  const auto content = made(kCounted);
  ReportInterpreter whole(content);
  ReportState state;
  for (const char* line : {"BEGIN", "2 D 1", "x", "5 D 1", "3 D 1", "3 D 1", "END 7", "BEGIN"}) {
    ReportInterpreter resumed(content, state);
    const auto expected = whole.take({.text = line});
    const auto taken = resumed.take({.text = line});
    EXPECT_EQ(taken.events, expected.events) << line;
    const auto read = parse_state(to_json(resumed.state()));
    ASSERT_TRUE(read) << read.error().what;
    EXPECT_EQ(*read, resumed.state()) << line;
    state = *read;
  }
  EXPECT_EQ(parse_state("{}").error().code, Errc::Corrupt);
  state.kept[1] = "1 D 1";
  const std::string text = to_json(state), kept = R"("kept":[[1,"1 D 1"]],)";
  const auto at = text.find(kept);
  ASSERT_NE(at, std::string::npos) << text;
  const auto older = parse_state(std::string(text).erase(at, kept.size()));
  ASSERT_TRUE(older) << "states of older versions have none: " << older.error().what;
  EXPECT_TRUE(older->kept.empty());
  state.highest.reset();
  state.missing = {{1, 2}};
  EXPECT_EQ(parse_state(to_json(state)).error().code, Errc::Corrupt);
}

}  // namespace
}  // namespace dripline::report_template
