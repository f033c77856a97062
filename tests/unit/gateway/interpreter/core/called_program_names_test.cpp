#include "gateway/interpreter/core/called_program_names.hpp"

#include <gtest/gtest.h>
#include <algorithm>

namespace dripline::interpreter {
namespace {

using Names = std::vector<std::string>;

bool holds(const Names& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

TEST(CalledProgramNames, BeginWithTheMostLiteral) {
  const Names names = called_program_names("O0002");
  ASSERT_GE(names.size(), 2u);
  EXPECT_EQ(names[0], "O0002");
  EXPECT_EQ(names[1], "O0002.nc");
  EXPECT_EQ(called_program_names("SIDE-A").front(), "SIDE-A");
}

TEST(CalledProgramNames, TryANumberInItsForms) {
  for (const char* called : {"O0002", "O2", "2", "0002"}) {
    const Names names = called_program_names(called);
    for (const char* name :
         {"O0002.nc", "O2", "O2.nc", "O00002", "o0002.nc", "2.nc", "2.h", "2.i", "2.ngc"}) {
      EXPECT_TRUE(holds(names, name)) << called << ' ' << name;
    }
  }
}

TEST(CalledProgramNames, TakeOtherNamesAsTheyAre) {
  for (const char* called : {"pocket", "O12B"}) {
    for (const auto& name : called_program_names(called)) {
      EXPECT_TRUE(name.starts_with(called)) << name;
    }
    EXPECT_TRUE(holds(called_program_names(called), std::string(called) + ".ngc"));
  }
}

TEST(CalledProgramNames, NeverLeaveTheFolder) {
  for (const char* called : {"../2", "/etc/passwd", ".hidden", ""}) {
    EXPECT_EQ(called_program_names(called), Names{}) << called;
  }
}

}  // namespace
}  // namespace dripline::interpreter
