#include "gateway/interpreter/core/option_rows.hpp"

#include <gmock/gmock.h>

#include "gateway/interpreter/core/setup.hpp"

namespace dripline::interpreter {
namespace {

using testing::HasSubstr;

struct Press {
  bool is_fast = true;
  int strokes = 4;
  double force = 0.5;
  double height = 12.7;  // mm
  Units units = Units::Millimeter;
  std::vector<std::int64_t> codes;
};

constexpr std::array kRows{
    row<&Press::is_fast>("fast", kFlag, "strokes in rapid"),
    row<&Press::strokes>("strokes", kWhole, "strokes of a part", {1, 16}),
    row<&Press::force>("force", kNumber, "force of a stroke", kPositive, "kN"),
    row<&Press::height>("height", kLength, "height of a stroke", kNotNegative),
    row<&Press::units>("show", "in|mm", "unit of the display"),
    row<&Press::codes>("codes", kWholes, "codes of the press", {0, 99, false, 2}),
    OptionRow<Press>{{"name", kText, "read in another file"}},
};
constexpr auto kOtherRows = in_table("option", kRows);

std::string error_of(const std::string& option) {
  Press press;
  const auto read = read_rows(kRows, parse_setup("[control]\n" + option)->control, press);
  return read ? "" : read.error().what;
}

TEST(OptionRows, ReadEachKindAndKeepTheInitialValuesOfAbsentKeys) {
  Press press;
  const auto setup = parse_setup(
      "units = \"in\"\n[control]\nfast = false\nstrokes = 16\nheight = 2\nshow = \"in\"\n"
      "codes = [1, 99]\nname = 3\n");
  ASSERT_TRUE(read_rows(kRows, setup->control, press));
  EXPECT_FALSE(press.is_fast);
  EXPECT_EQ(press.strokes, 16);
  EXPECT_EQ(press.force, 0.5);
  EXPECT_EQ(press.height, 50.8);
  EXPECT_EQ(press.units, Units::Inch);
  EXPECT_EQ(press.codes, (std::vector<std::int64_t>{1, 99}));
}

TEST(OptionRows, NameTheKeyTheValueAndTheLimit) {
  EXPECT_EQ(error_of("strokes = 17"), "[control] strokes: 17 is not a number from 1 to 16");
  EXPECT_EQ(error_of("force = 0"), "[control] force: 0 is not more than 0");
  EXPECT_EQ(error_of("height = -1.5"), "[control] height: -1.5 is less than 0");
  EXPECT_EQ(error_of("codes = [1, 100]"), "[control] codes: 100 is not 0 to 99");
  EXPECT_EQ(error_of("codes = [1, 2, 3]"), "[control] codes: 3 entries, at most 2");
  EXPECT_EQ(error_of("show = \"cm\""), "line 2: [control] show: expected one of in, mm");
  EXPECT_THAT(error_of("stroke = 1"), HasSubstr("no such option; it has: fast, strokes, force"));

  Press press;
  const auto setup = parse_setup("[control]\nstrokes = 0");
  EXPECT_EQ(read_rows(kOtherRows, setup->control, press).error().what,
            "option strokes: 0 is not a number from 1 to 16");
}

TEST(OptionRows, AreListedWithTheInitialValuesAsDefaults) {
  std::vector<std::string> defaults;
  for (const ListedOption& option : list_rows(kRows)) defaults.push_back(option.fallback);
  EXPECT_EQ(defaults,
            (std::vector<std::string>{"true", "4", "0.5", "12.7 mm", "mm", "none", "none"}));
  EXPECT_EQ(kRows[2].range.text(), "above 0");
  EXPECT_EQ(kRows[3].range.text(), "0 or more");
  EXPECT_EQ((OptionRange{0, 1, true}.text()), "above 0 and up to 1");
  EXPECT_EQ((OptionRange{1, 1e12}.text()), "1 to 1000000000000");
}

}  // namespace
}  // namespace dripline::interpreter
