#include "protocol/base/names.hpp"

#include <gtest/gtest.h>

namespace dripline {
namespace {

TEST(ProgramName, AcceptsWhatShopsCallTheirPrograms) {
  for (const char* name : {"O0100", "flange rev B.nc", "1234.H", "a+b_c-d"})
    EXPECT_TRUE(check_program_name(name)) << name;
}

TEST(ProgramName, CannotLeaveItsFolder) {
  for (const char* name :
       {"../etc/passwd", "..", ".hidden", "a/b", "a\\b", "a\nb", " a", "a ", "", "x\xff"}) {
    EXPECT_FALSE(check_program_name(name)) << name;
  }
  EXPECT_FALSE(check_program_name(std::string(129, 'a')));
}

TEST(MachineName, IsSafeInPartitionsAndFiles) {
  EXPECT_TRUE(check_machine_name("lathe-1_b"));
  for (const char* name : {"", "Lathe", "-a", "a*", "a.b", "a b", "a/b"})
    EXPECT_FALSE(check_machine_name(name)) << name;
  EXPECT_FALSE(check_machine_name(std::string(65, 'a')));
}

}  // namespace
}  // namespace dripline
