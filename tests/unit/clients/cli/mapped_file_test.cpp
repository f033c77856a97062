#include "clients/cli/offline/mapped_file.hpp"

#include <gtest/gtest.h>
#include <fstream>

#include "tests/support/temporary_folder.hpp"

namespace dripline::cli {
namespace {

class Mapped : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder.path() / name).string(); }
  test_support::TemporaryFolder folder;
};

TEST_F(Mapped, GivesTheBytesOfAFile) {
  std::ofstream(path("a.nc")) << "G1 X1\n";
  auto file = MappedFile::open(path("a.nc"));
  ASSERT_TRUE(file);
  const MappedFile moved = std::move(*file);
  EXPECT_EQ(moved.text(), "G1 X1\n");
}

TEST_F(Mapped, TakesAnEmptyFile) {
  std::ofstream(path("empty.nc")).flush();
  const auto file = MappedFile::open(path("empty.nc"));
  ASSERT_TRUE(file);
  EXPECT_EQ(file->text(), "");
}

TEST_F(Mapped, RefusesFoldersAndWhatIsNotThere) {
  EXPECT_EQ(MappedFile::open(folder.path().string()).error().code, Errc::Unsupported);
  const auto missing = MappedFile::open(path("no.nc"));
  EXPECT_EQ(missing.error().code, Errc::Io);
  EXPECT_NE(missing.error().what.find("no.nc"), std::string::npos);
}

}  // namespace
}  // namespace dripline::cli
