#include "clients/cli/program_folder.hpp"

#include <gtest/gtest.h>
#include <fstream>

#include "tests/support/temporary_folder.hpp"

namespace dripline::cli {
namespace {

using Names = std::vector<std::string>;

TEST(CalledProgramNames, TryTheNumberInItsForms) {
  const Names start{"O2.nc", "O0002.nc", "2.nc", "2.h", "2.i"};
  for (const char* name : {"O0002", "O2", "2", "0002"}) {
    const auto names = called_program_names(name);
    ASSERT_GE(names.size(), start.size());
    EXPECT_EQ(Names(names.begin(), names.begin() + 5), start) << name;
  }
}

TEST(CalledProgramNames, TakeOtherNamesAsTheyAre) {
  EXPECT_EQ(called_program_names("SLOT"), (Names{"SLOT", "SLOT.nc"}));
  EXPECT_EQ(called_program_names("O12B"), (Names{"O12B", "O12B.nc"}));
}

TEST(CalledProgramNames, NeverLeaveTheFolder) {
  EXPECT_EQ(called_program_names("../2"), Names{});
  EXPECT_EQ(called_program_names("/etc/passwd"), Names{});
  EXPECT_EQ(called_program_names(".hidden"), Names{});
  EXPECT_EQ(called_program_names(""), Names{});
}

TEST(LoadCalledProgram, GivesTheFirstThatIsThere) {
  const test_support::TemporaryFolder folder;
  const auto load = [&] { return load_called_program(folder.path().string(), "O2"); };
  EXPECT_EQ(load(), std::nullopt);
  std::ofstream(folder.path() / "2.h") << "third";
  EXPECT_EQ(load(), "third");
  std::ofstream(folder.path() / "O0002.nc") << "second";
  EXPECT_EQ(load(), "second");
  std::ofstream(folder.path() / "O2.nc") << "first";
  EXPECT_EQ(load(), "first");
}

}  // namespace
}  // namespace dripline::cli
