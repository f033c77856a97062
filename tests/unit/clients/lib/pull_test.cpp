#include "clients/lib/pull.hpp"

#include <gtest/gtest.h>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "tests/support/temporary_folder.hpp"
#include "tests/unit/clients/support/fake_server.hpp"

namespace dripline::client {
namespace {

using test_support::FakeServer;

class Pull : public testing::Test {
 protected:
  Pull() {
    options.program = "O0200";
    options.retry.wait = [this](std::chrono::milliseconds) { return ++waits > 0; };
  }
  std::string path() const { return (folder.path() / "out.nc").string(); }
  std::string written() const {
    std::ifstream file(path(), std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
  }
  std::size_t files() const {
    return static_cast<std::size_t>(
        std::distance(std::filesystem::directory_iterator(folder.path()), {}));
  }
  FakeServer server;
  Client client{ServerAddress{server.url(), FakeServer::kToken, {}}};
  PullOptions options;
  test_support::TemporaryFolder folder;
  int waits = 0;
};

TEST_F(Pull, WritesTheWholeProgramFromRanges) {
  const std::string text = std::string(8 * 1024 * 1024, 'A') + "the rest";
  server.add_program("O0200", text);
  const auto revision = pull_program_to_file(client, options, path());
  ASSERT_TRUE(revision) << revision.error().what;
  EXPECT_TRUE(written() == text);
  EXPECT_EQ(server.longest_piece(), 8u * 1024 * 1024);
  EXPECT_EQ(files(), 1u);
}

TEST_F(Pull, TakesTheRevisionAskedFor) {
  server.add_program("O0200", "first\n");
  server.add_program("O0200", "second\n");
  options.revision = 1;
  ASSERT_TRUE(pull_program_to_file(client, options, path()));
  EXPECT_EQ(written(), "first\n");
}

TEST_F(Pull, NamesARevisionThatDoesNotExist) {
  server.add_program("O0200", "first\n");
  options.revision = 7;
  const auto revision = pull_program_to_file(client, options, path());
  ASSERT_FALSE(revision);
  EXPECT_EQ(revision.error().what, "program O0200 has no revision 7, its latest is 1");
  EXPECT_EQ(files(), 0u);
}

TEST_F(Pull, ContinuesAfterABrokenConnection) {
  server.add_program("O0200", "G1 X1\nM30\n");
  server.cut_content(2);
  const auto revision = pull_program_to_file(client, options, path());
  ASSERT_TRUE(revision) << revision.error().what;
  EXPECT_EQ(written(), "G1 X1\nM30\n");
  EXPECT_EQ(waits, 2);
}

TEST_F(Pull, ReportsADamagedChunkAtOnce) {
  server.add_program("O0200", std::string(1'000'000, 'A'));
  server.damage_content_at(700'000);
  const auto revision = pull_program_to_file(client, options, path());
  ASSERT_FALSE(revision);
  EXPECT_EQ(revision.error().what, "chunk 3 is damaged");
  EXPECT_EQ(revision.error().code, Errc::Corrupt);
  EXPECT_EQ(waits, 1);
  EXPECT_EQ(files(), 0u);
}

TEST_F(Pull, RefusesWrongBytesAndLeavesTheOldFile) {
  std::ofstream(path()) << "old";
  server.add_program("O0200", "G1 X1\nM30\n");
  server.corrupt_content("O0200");
  const auto revision = pull_program_to_file(client, options, path());
  ASSERT_FALSE(revision);
  EXPECT_EQ(revision.error().code, Errc::Corrupt);
  EXPECT_EQ(written(), "old");
  EXPECT_EQ(files(), 1u);
}

TEST_F(Pull, RefusesWrongBytesAndLeavesNoFile) {
  server.add_program("O0200", "G1 X1\nM30\n");
  server.corrupt_content("O0200");
  ASSERT_FALSE(pull_program_to_file(client, options, path()));
  EXPECT_EQ(files(), 0u);
}

TEST_F(Pull, NamesAFileThatCannotBeWritten) {
  server.add_program("O0200", "M30\n");
  const auto revision =
      pull_program_to_file(client, options, (folder.path() / "no" / "such" / "out.nc").string());
  ASSERT_FALSE(revision);
  EXPECT_EQ(revision.error().kind, Failure::Kind::Local);
  EXPECT_NE(revision.error().what.find("no/such/out.nc"), std::string::npos);
}

TEST_F(Pull, WritesAnEmptyProgram) {
  server.add_program("O0200", "");
  ASSERT_TRUE(pull_program_to_file(client, options, path()));
  EXPECT_EQ(files(), 1u);
  EXPECT_EQ(written(), "");
}

}  // namespace
}  // namespace dripline::client
