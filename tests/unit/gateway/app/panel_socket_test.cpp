#include "gateway/app/panel/panel_socket.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>
#include <cstring>
#include <vector>

#include "tests/support/temporary_folder.hpp"

namespace dripline::gateway {
namespace {

class OpenPanel : public testing::Test {
 protected:
  void SetUp() override {
    auto opened = PanelSocket::open(folder_.path(), [](const PanelRequest& request) {
      request.answer("ok " + request.command.text);
    });
    ASSERT_TRUE(opened) << opened.error().what;
    socket_ = *std::move(opened);
  }
  /// A connection that sends nothing yet.
  int connect() const {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    const std::string path = folder_.path() / "panel";
    std::strncpy(address.sun_path, path.c_str(), sizeof address.sun_path - 1);
    const int number = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    EXPECT_EQ(::connect(number, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    return number;
  }
  static std::string read_all(int socket, std::size_t lines) {
    std::string text;
    char byte = 0;
    while (lines > 0 && ::read(socket, &byte, 1) == 1) {
      text += byte;
      if (byte == '\n') --lines;
    }
    return text;
  }

  test_support::TemporaryFolder folder_;
  std::unique_ptr<PanelSocket> socket_;
};

TEST_F(OpenPanel, IsOpenToItsOwnerOnly) {
  struct stat found {};
  ASSERT_EQ(::stat((folder_.path() / "panel").c_str(), &found), 0);
  EXPECT_EQ(found.st_mode & 0777, 0600U);
}

TEST_F(OpenPanel, AnswersEachLineInItsTurn) {
  EXPECT_EQ(ask_panel(folder_.path(), "answer 7").value(), "ok 7");
  const int one = connect();
  const std::string lines = "answer a\nnonsense\nanswer b\r\n";
  ASSERT_EQ(::write(one, lines.data(), lines.size()), static_cast<ssize_t>(lines.size()));
  const std::string answers = read_all(one, 3);
  EXPECT_TRUE(answers.starts_with("ok a\nrefused 'nonsense' is none of ")) << answers;
  EXPECT_TRUE(answers.ends_with("\nok b\n")) << answers;
  ::close(one);
}

TEST_F(OpenPanel, ClosesAConnectionThatNeverEndsItsLine) {
  const int one = connect();
  const std::string line(1000, 'x');
  ASSERT_EQ(::write(one, line.data(), line.size()), static_cast<ssize_t>(line.size()));
  EXPECT_EQ(read_all(one, 2), "refused a line of more than 256 bytes\n");
  ::close(one);
}

/// Forgotten connections never keep a stop from being heard.
TEST_F(OpenPanel, HearsANewConnectionHoweverManyAreSilent) {
  std::vector<int> silent;
  for (std::size_t i = 0; i < 3 * PanelSocket::kMaxConnections; ++i) silent.push_back(connect());
  EXPECT_EQ(ask_panel(folder_.path(), "answer heard").value(), "ok heard");
  for (const int one : silent) ::close(one);
}

TEST_F(OpenPanel, TakesTheSocketOfAFormerProcessOver) {
  socket_.reset();
  EXPECT_EQ(ask_panel(folder_.path(), "status").error().code, Errc::NotFound);
  SetUp();
  EXPECT_EQ(ask_panel(folder_.path(), "answer again").value(), "ok again");
}

TEST(PanelSocket, NeedsNoShortPath) {
  const test_support::TemporaryFolder folder;
  const auto deep = folder.path() / std::string(120, 'd');
  std::filesystem::create_directory(deep);
  const auto socket =
      PanelSocket::open(deep, [](const PanelRequest& request) { request.answer("ok"); });
  ASSERT_TRUE(socket) << socket.error().what;
  EXPECT_EQ(ask_panel(deep, "status").value(), "ok");
}

}  // namespace
}  // namespace dripline::gateway
