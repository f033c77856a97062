#include <gtest/gtest.h>
#include <string>

#include "gateway/interpreter/registry.hpp"

/// Rows: TK-56.
namespace dripline::interpreter {
namespace {

TEST(PlanningSheet, HasAColumnForEachWordInTheOrderOfTheManuscript) {
  const auto sheet =
      (*find_dialect("tektronix-1704"))
          ->list("%\nN1G1X12345Y-7F800M3\n(NOTHING)\nM8I10J-20N12\nX#\nM30\n%\nX1\n");
  ASSERT_TRUE(sheet);
  // clang-format off
  EXPECT_EQ(*sheet,
            "  N   G        X        Y        Z        I        J        K        R     F   S   T   M\n"
            "001  01    12345       -7                                                800          03\n"
            "012                                      10      -20                                  08\n"
            "! X#\n"
            "                                                                                      30\n");
  // clang-format on
}

}  // namespace
}  // namespace dripline::interpreter
