#include "gateway/interpreter/core/shown_length.hpp"

#include <gtest/gtest.h>

namespace dripline::interpreter {
namespace {

TEST(ShownLength, IsInTheUnitsOfTheProgramAndNoFinerThanAControlResolves) {
  EXPECT_EQ(shown_length(Length::inch(0.05), Units::Inch), "0.05 in");
  EXPECT_EQ(shown_length(Length::mm(1.2700000000000014), Units::Millimeter), "1.27 mm");
  EXPECT_EQ(shown_number(Length::mm(-25.4), Units::Inch), "-1");
  EXPECT_EQ(shown_number(Length::mm(-0.00001), Units::Millimeter), "0");
  EXPECT_EQ(shown_number(Length::mm(100), Units::Millimeter), "100");
}

TEST(ShownLength, OfAnAxisIsADiameterWhereProgramsHaveIt) {
  const LengthDisplay lathe{.units = Units::Inch, .x_is_diameter = true};
  EXPECT_EQ(shown_axis(Axis::X, -12.7, lathe), "X diameter -1");
  EXPECT_EQ(shown_axis_number(Axis::X, 203.2, lathe), "16");
  EXPECT_EQ(shown_axis(Axis::Z, -12.7, lathe), "Z -0.5");
  EXPECT_EQ(shown_axis(Axis::X, -12.7, {.units = Units::Inch}), "X -0.5");
  EXPECT_EQ(shown_unit(Axis::X, Units::Inch), "in");
}

TEST(ShownLength, OfARotaryAxisIsDegreesInAnyUnit) {
  EXPECT_EQ(shown_axis(Axis::C, 90.5, {.units = Units::Inch}), "C 90.5");
  EXPECT_EQ(shown_unit(Axis::C, Units::Inch), "degrees");
}

}  // namespace
}  // namespace dripline::interpreter
