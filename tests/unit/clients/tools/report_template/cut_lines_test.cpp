#include "protocol/measurement/cut_line.hpp"
#include "tests/unit/clients/tools/report_template/reading.hpp"

namespace dripline::report_template {
namespace {

using measurement::cut_line;

constexpr char kCountedParts[] = R"(
nominal = 40
tolerance = 0.05
[[line]]
form = "PART {part}"
starts_part = true
[[line]]
form = "COUNT {expected}"
[[line]]
form = "{count} D40 {actual}"
characteristic = "D40"
[[line]]
form = "END {expected}"
ends_part = true
)";

constexpr char kCutBores[] = R"(
nominal = 40
tolerance = 0.05
[[line]]
form = "BORE {feature}"
[[line]]
form = "D {actual}"
characteristic = "D{feature}"
[[line]]
form = "S {actual}"
characteristic = "S{ordinal}"
[[line]]
form = "END"
ends_part = true
)";

const char kNotWholeLine[] =
    "incomplete: '1 D40 40.0' is not whole: it ended without its end of block, nothing is taken "
    "from it";

/// 40.09 with a pause in it.
TEST(CutLines, GiveNoValueAndLeaveTheirPartUnknown) {
  Reading reading(kCountedParts);
  reading.take("PART P8").take(cut_line("1 D40 40.0")).take("9").take("END 1");
  EXPECT_EQ(reading.brought,
            (Brought{"[", kNotWholeLine, "? " + cut_line("1 D40 40.0"), "? 9",
                     "missing: 0 lines with values came, 1 were expected", "] unknown"}));
}

TEST(CutLines, AreUsualLinesAgainInTheNextPart) {
  Reading reading(kCountedParts);
  reading.take("PART P8").take(cut_line("1 D40 40.0")).take("9").take("END 1");
  reading.brought.clear();
  reading.take("PART P9").take("1 D40 40.01").take("END 1");
  EXPECT_EQ(reading.brought, (Brought{"[", "D40=40.01 good", "] good"}));
}

TEST(CutLines, OpenAPartThatIsUnknown) {
  Reading reading(kCutBores);
  reading.take(cut_line("D 40.0")).take("9").take("END");
  ASSERT_EQ(reading.brought.size(), 5u);
  EXPECT_EQ(reading.brought.front(), "[");
  EXPECT_EQ(reading.brought.back(), "] unknown");
}

TEST(CutLines, BeforeAPartLeaveItUnknown) {
  Reading reading(kCutBores);
  reading.take(cut_line("BOR")).take("E 1").take("S 40.01").take("END");
  EXPECT_EQ(reading.brought.back(), "] unknown");
  Reading begun(kCountedParts);
  begun.take(cut_line("PAR")).take("PART P8").take("1 D40 40.01").take("END 1");
  EXPECT_EQ(begun.brought.back(), "] good") << "it began with a line of its own";
}

/// `D 40.0` of another line looks like a value.
TEST(CutLines, HaveARestThatIsNoValueEither) {
  Reading reading(kCutBores);
  reading.take("BORE 1").take("D 40.01").take(cut_line("REMARK ")).take("D 40.02").take("END");
  EXPECT_EQ(reading.values.size(), 1u);
  EXPECT_EQ(reading.brought.at(4),
            "incomplete: 'D 40.02' may be the rest of 'REMARK', which is not whole: nothing is "
            "taken from it");
  EXPECT_EQ(reading.brought.back(), "] unknown");
}

TEST(CutLines, LeaveNoNameInForceThatTheyMayHaveChanged) {
  Reading reading(kCutBores);
  reading.take("BORE 1").take("D 40.01").take(cut_line("BORE ")).take("2").take("D 40.02");
  ASSERT_EQ(reading.values.size(), 1u) << "it is no D1";
  EXPECT_EQ(reading.brought.back(), "bad_value: field feature of 'D{feature}' did not come");
  Reading ordinals(kCutBores);
  ordinals.take("S 40.01").take(cut_line("S 40.0")).take("9").take("S 40.03");
  ASSERT_EQ(ordinals.values.size(), 1u) << "it is no S2";
}

TEST(CutLines, AreKnownAfterARestart) {
  Reading reading(kCutBores);
  reading.take(cut_line("BOR"));
  const auto& state = reading.interpreter().state();
  const auto again = parse_state(to_json(state));
  ASSERT_TRUE(again);
  EXPECT_EQ(*again, state);
  EXPECT_TRUE(again->is_after_cut);
}

TEST(CutLines, KeepTheirTextWithinARecord) {
  EXPECT_EQ(measurement::printed_line(cut_line("D 40.0")), "D 40.0");
  EXPECT_EQ(cut_line(std::string(5000, 'X')).size(), 4096u);
  EXPECT_TRUE(measurement::is_cut(cut_line(std::string(5000, 'X'))));
  EXPECT_FALSE(measurement::is_cut("D 40.0"));
}

TEST(Counts, ThatContradictEachOtherLeaveThePartUnknown) {
  Reading reading(kCountedParts);
  reading.take("PART P1").take("COUNT 3").take("1 D40 40.01").take("END 1");
  EXPECT_EQ(reading.brought, (Brought{"[", "D40=40.01 good",
                                      "bad_value: expected in 'END 1' is 1, an earlier line has 3",
                                      "missing: lines 2 to 3 did not come", "] unknown"}));
  Reading other(kCountedParts);
  other.take("PART P1").take("COUNT 1").take("1 D40 40.01").take("END 2");
  EXPECT_EQ(other.brought.back(), "] unknown");
  Reading agreed(std::string("expected = 12\n") + kCountedParts);
  agreed.take("PART P1").take("COUNT 1").take("1 D40 40.01").take("END 1");
  EXPECT_EQ(agreed.brought.back(), "] good") << "the lines go before the template";
}

TEST(PartEnds, ThatComeTwiceMakeNoSecondPart) {
  Reading reading(kCountedParts);
  reading.take("PART P1").take("1 D40 40.01").take("END 1").take("END  1").take("END 1");
  EXPECT_EQ(reading.brought, (Brought{"[", "D40=40.01 good", "] good",
                                      "doubled: 'END  1' came again: its part has ended",
                                      "doubled: 'END 1' came again: its part has ended"}));
  reading.brought.clear();
  reading.take("LOAD 12").take("END 1").end();
  EXPECT_EQ(reading.brought,
            (Brought{"? LOAD 12", "[", "missing: 0 lines with values came, 1 were expected",
                     "] unknown"}))
      << "not with a line between: what it may have had is missing";
}

}  // namespace
}  // namespace dripline::report_template
