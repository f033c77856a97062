#include "server/offsets/setup_value.hpp"

#include <gtest/gtest.h>
#include <string>

namespace dripline::offsets {
namespace {

constexpr const char* kSetup = R"(# lathe 1, set up by Meyer
units = "mm"

[[tool]]
number = 3          # finishing
X = 12.5
Z = 40.0
wear = { X = 0.1, Z = -0.02 }   # corrected on 2 March

[[tool]]
number = 4

[[offset]]
name = "G54"
X = 0.0
Z = -120.25

[[variable]]
name = "#500"
value = 7
)";

SetupTarget target(const char* text) {
  const auto parsed = parse_setup_target(text);
  EXPECT_TRUE(parsed) << text;
  return parsed.value_or(SetupTarget{});
}

TEST(SetupValue, ReadsWhatIsThereAndZeroOtherwise) {
  EXPECT_EQ(value_in_setup(kSetup, target("T3.wear.X")), 0.1);
  EXPECT_EQ(value_in_setup(kSetup, target("T3.Z")), 40.0);
  EXPECT_EQ(value_in_setup(kSetup, target("G54.Z")), -120.25);
  EXPECT_EQ(value_in_setup(kSetup, target("#500")), 7.0);
  EXPECT_EQ(value_in_setup(kSetup, target("T4.wear.X")), 0.0);
  EXPECT_EQ(value_in_setup(kSetup, target("T9.wear.X")), 0.0);
  EXPECT_EQ(value_in_setup("", target("G55.X")), 0.0);
}

TEST(SetupValue, ChangesOneNumberAndNothingElse) {
  const auto changed = with_value(kSetup, target("T3.wear.X"), 0.0925, 4);
  ASSERT_TRUE(changed) << changed.error().what;
  std::string expected = kSetup;
  expected.replace(expected.find("0.1,"), 3, "0.0925");
  EXPECT_EQ(*changed, expected);
  EXPECT_EQ(value_in_setup(*with_value(kSetup, target("G54.Z"), -120, 4), target("G54.Z")), -120.0);
  EXPECT_EQ(value_in_setup(*with_value(kSetup, target("#500"), -1.5, 4), target("#500")), -1.5);
}

struct Place {
  const char* name;
  const char* text;
  const char* target;
};
class Places : public testing::TestWithParam<Place> {};
TEST_P(Places, TakeAValueThatWasNotThere) {
  const auto changed = with_value(GetParam().text, target(GetParam().target), -0.0125, 4);
  ASSERT_TRUE(changed) << changed.error().what;
  EXPECT_EQ(value_in_setup(*changed, target(GetParam().target)), -0.0125) << *changed;
  const auto again = with_value(*changed, target(GetParam().target), 0.5, 4);
  ASSERT_TRUE(again) << again.error().what;
  EXPECT_EQ(value_in_setup(*again, target(GetParam().target)), 0.5) << *again;
}
INSTANTIATE_TEST_SUITE_P(
    , Places,
    testing::Values(
        Place{"no_setup", "", "T3.wear.X"}, Place{"no_tool", kSetup, "T7.wear.Z"},
        Place{"no_wear", kSetup, "T4.wear.X"}, Place{"no_key_in_wear", kSetup, "T3.wear.radius"},
        Place{"empty_wear", "[[tool]]\nnumber = 3\nwear = {}\n", "T3.wear.X"},
        Place{"last_line_without_end", "[[tool]]\nnumber = 3", "T3.wear.X"},
        Place{"inline_tools", "tool = [ { number = 3 }, { number = 4 } ]\n", "T3.wear.X"},
        Place{"no_offset", kSetup, "G55.X"}, Place{"no_axis", kSetup, "G54.Y"},
        Place{"dotted_offset", "[[offset]]\nname = \"G54.1P1\"\n", "G54.1P1.X"},
        Place{"no_variable", kSetup, "#501"},
        Place{"letters",
              "# \xC3\x9C\xC3\x9F\n[[tool]]\nnumber = 3 # \xC3\x98\nwear = { X = 1.0 }\n",
              "T3.wear.X"}),
    [](const auto& i) { return std::string{i.param.name}; });

TEST(SetupValue, RefusesALayoutThatItCannotWriteInto) {
  EXPECT_FALSE(with_value("tool = [ { number = 3 } ]\n", target("T4.wear.X"), 1, 4));
  EXPECT_FALSE(with_value("[[tool]\n", target("T4.wear.X"), 1, 4));
}

TEST(SetupValue, ListsWhatASetupStates) {
  const auto values = values_in_setup(kSetup);
  ASSERT_TRUE(values);
  std::string all;
  for (const auto& value : *values) all += fmt::format("{}={} ", value.target, value.value);
  EXPECT_EQ(all, "T3.X=12.5 T3.Z=40 T3.wear.X=0.1 T3.wear.Z=-0.02 G54.X=0 G54.Z=-120.25 ");
  EXPECT_EQ(unit_of_setup(kSetup).value(), "mm");
  EXPECT_EQ(unit_of_setup("").value(), "");
}

TEST(SetupTarget, RefusesWhatNoSetupHas) {
  for (const char* text : {"", "T3.wear.Q", "T0.X", "T3.tip", "G54.Q", ".X", "T3x.X", "a b",
                           "\"x\".X", "T99999999999.X"})
    EXPECT_FALSE(parse_setup_target(text)) << text;
  EXPECT_EQ(target("T12.wear.radius").tool, 12);
}

TEST(SetupValue, XOfALatheIsARadiusUnlessTheControlStoresDiameters) {
  const auto kind = [](const char* setup, const char* control, const char* target) {
    return kind_of_x(setup, control, parse_setup_target(target).value()).value();
  };
  constexpr const char* kDiameter = "[control]\nstored_x = \"diameter\"\n";
  EXPECT_EQ(kind("", "centurion", "T3.wear.X"), "radius");
  EXPECT_EQ(kind("", "fanuc-t", "T3.wear.X"), "radius");
  EXPECT_EQ(kind("", "centurion", "G54.X"), "radius");
  EXPECT_EQ(kind(kDiameter, "centurion", "G54.X"), "diameter");
  EXPECT_EQ(kind(kDiameter, "centurion", "T3.wear.X"), "radius") << "of tools always";
  EXPECT_EQ(kind("", "tnc155", "T3.radius"), "radius");
  EXPECT_EQ(kind("", "centurion", "T3.wear.Z"), "");
  EXPECT_EQ(kind("", "fanuc", "G54.X"), "") << "a mill has no diameters";
  EXPECT_EQ(kind("", "centurion", "#500"), "");
}

}  // namespace
}  // namespace dripline::offsets
