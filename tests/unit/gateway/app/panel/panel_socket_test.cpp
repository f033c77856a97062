#include "gateway/app/panel/panel_socket.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>
#include <algorithm>
#include <condition_variable>
#include <cstring>
#include <ctime>
#include <mutex>
#include <thread>
#include <vector>

#include "protocol/base/descriptor.hpp"
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
    const int number = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    EXPECT_EQ(connect(number), 0);
    return number;
  }
  int connect(int number) const {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    const std::string path = folder_.path() / "panel";
    std::strncpy(address.sun_path, path.c_str(), sizeof address.sun_path - 1);
    return ::connect(number, reinterpret_cast<sockaddr*>(&address), sizeof address);
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

/// A new connection that cannot be accepted is no reason to do nothing but try.
TEST_F(OpenPanel, TakesNoProcessorWhileFilesAreShortAndAnswersAfterwards) {
  const int waiting = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const int free = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
  ::close(free);
  ::rlimit before{}, short_of_files{};
  ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &before), 0);
  short_of_files = {static_cast<::rlim_t>(free), before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &short_of_files), 0);
  EXPECT_EQ(connect(waiting), 0);
  EXPECT_EQ(::write(waiting, "answer x\n", 9), 9);
  const std::clock_t begun = std::clock();  // of the process
  std::this_thread::sleep_for(std::chrono::milliseconds(600));
  EXPECT_LT(std::clock() - begun, CLOCKS_PER_SEC / 20);
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &before), 0);
  EXPECT_EQ(read_all(waiting, 1), "ok x\n");
  ::close(waiting);
}

TEST_F(OpenPanel, TakesTheSocketOfAFormerProcessOver) {
  socket_.reset();
  EXPECT_EQ(ask_panel(folder_.path(), "status").error().code, Errc::NotFound);
  SetUp();
  EXPECT_EQ(ask_panel(folder_.path(), "answer again").value(), "ok again");
}

/// What a panel was asked, for a test that answers as late as it wants.
class HeldPanel : public testing::Test {
 protected:
  void SetUp() override {
    auto opened = PanelSocket::open(folder_.path(), [this](PanelRequest request) {
      std::unique_lock lock(mutex_);
      asked_.push_back(std::move(request));
      changed_.notify_all();
      changed_.wait(lock, [this] { return !is_frozen_; });
    });
    ASSERT_TRUE(opened) << opened.error().what;
    socket_ = *std::move(opened);
  }
  void TearDown() override { set_frozen(false); }
  /// The socket's thread stops at its next request, as a process that is stopped.
  void set_frozen(bool is_frozen) {
    const std::lock_guard lock(mutex_);
    is_frozen_ = is_frozen;
    changed_.notify_all();
  }
  Descriptor ask(const std::string& line) const {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    const std::string path = folder_.path() / "panel";
    std::strncpy(address.sun_path, path.c_str(), sizeof address.sun_path - 1);
    Descriptor socket(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
    EXPECT_EQ(::connect(socket.get(), reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    EXPECT_EQ(::write(socket.get(), line.data(), line.size()), static_cast<ssize_t>(line.size()));
    return socket;
  }
  /// Why the request of this number is late.
  std::string late(std::size_t number) {
    std::unique_lock lock(mutex_);
    const bool is_there =
        changed_.wait_for(lock, std::chrono::seconds(30), [&] { return asked_.size() > number; });
    EXPECT_TRUE(is_there);
    return is_there ? asked_[number].why_late() : "not there";
  }
  static void outlast_the_limit() {
    std::this_thread::sleep_for(PanelSocket::kMaxAge + std::chrono::seconds(1));
  }

  test_support::TemporaryFolder folder_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<PanelRequest> asked_;
  bool is_frozen_ = false;
  std::unique_ptr<PanelSocket> socket_;
};

/// However long the panel was silent before.
TEST_F(HeldPanel, ARequestIsNotLateAtFirst) {
  outlast_the_limit();
  const Descriptor one = ask("cycle-start\n");
  EXPECT_EQ(late(0), "");
  outlast_the_limit();
  EXPECT_NE(late(0).find(" s old"), std::string::npos) << late(0);
}

TEST_F(HeldPanel, ARequestWhoseSenderHasGoneIsLate) {
  Descriptor one = ask("cycle-start\n");
  (void)late(0);
  one = Descriptor();
  EXPECT_EQ(late(0), "its sender waits no longer");
}

/// The process may not have been executed when it came: its age counts from the last look.
TEST_F(HeldPanel, WhatCameWhileTheProcessWasStoppedIsLate) {
  set_frozen(true);
  const Descriptor first = ask("status\n");
  (void)late(0);
  const Descriptor second = ask("cycle-start\n");
  outlast_the_limit();
  set_frozen(false);
  EXPECT_NE(late(1).find(" s old"), std::string::npos) << late(1);
}

/// The time of an answer is not the next request's.
TEST_F(HeldPanel, TheNextRequestOfASlowOneIsNotLate) {
  const Descriptor one = ask("status\n");
  (void)late(0);
  outlast_the_limit();
  {
    const std::lock_guard lock(mutex_);
    asked_[0].answer("ok");
  }
  char answer[3];
  ASSERT_EQ(::read(one.get(), answer, sizeof answer), 3);
  ASSERT_EQ(::write(one.get(), "hold\n", 5), 5);
  EXPECT_EQ(late(1), "");
}

/// A button box polls the status of a gateway that hangs, a stop is pressed, and it gives up.
TEST_F(HeldPanel, AStopOfASenderThatHasGoneTakesEffect) {
  {
    const Descriptor one = ask("status\ncycle-start\nhold\n");
    (void)late(0);
  }
  std::unique_lock lock(mutex_);
  ASSERT_TRUE(changed_.wait_for(lock, std::chrono::seconds(30), [&] { return asked_.size() > 1; }));
  EXPECT_EQ(asked_[1].command.verb, PanelCommand::Verb::Hold);
}

/// Button boxes that poll a gateway that hangs, and one of them had a stop pressed.
TEST_F(HeldPanel, AStopOfAConnectionThatMakesRoomTakesEffect) {
  const Descriptor stopped = ask("status\ncycle-start\nhold\n");
  (void)late(0);
  std::vector<Descriptor> others;
  for (std::size_t i = 1; i <= PanelSocket::kMaxConnections; ++i) {
    others.push_back(ask("status\n"));
    (void)late(i - 1);
  }
  std::unique_lock lock(mutex_);
  const bool is_stopped = changed_.wait_for(lock, std::chrono::seconds(30), [&] {
    return std::ranges::any_of(asked_, [](const PanelRequest& request) {
      return request.command.verb == PanelCommand::Verb::Hold;
    });
  });
  EXPECT_TRUE(is_stopped);
  EXPECT_TRUE(std::ranges::none_of(asked_, [](const PanelRequest& request) {
    return request.command.verb == PanelCommand::Verb::CycleStart;
  }));
}

/// It reads no answer, and so the next one is too much for it.
TEST_F(HeldPanel, AStopOfAConnectionThatReadsNothingTakesEffect) {
  const Descriptor one = ask("status\nhold\n");
  (void)late(0);
  {
    const std::lock_guard lock(mutex_);
    asked_[0].answer(std::string(17'000, 'x'));
  }
  std::unique_lock lock(mutex_);
  ASSERT_TRUE(changed_.wait_for(lock, std::chrono::seconds(30), [&] { return asked_.size() > 1; }));
  EXPECT_EQ(asked_[1].command.verb, PanelCommand::Verb::Hold);
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
