#include "clients/cli/offline/offline_program.hpp"

#include <gtest/gtest.h>
#include <fstream>

#include "tests/support/temporary_folder.hpp"

namespace dripline::cli {
namespace {

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

TEST(LoadCalledProgram, FindsTheFilesOfLinuxCnc) {
  const test_support::TemporaryFolder folder;
  std::ofstream(folder.path() / "pocket.ngc") << "by name";
  std::ofstream(folder.path() / "100.ngc") << "by number";
  EXPECT_EQ(load_called_program(folder.path().string(), "pocket"), "by name");
  EXPECT_EQ(load_called_program(folder.path().string(), "100"), "by number");
}

}  // namespace
}  // namespace dripline::cli
