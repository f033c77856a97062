#include <gtest/gtest.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>
#include <csignal>
#include <fstream>

#include "protocol/serial/channel.hpp"
#include "protocol/serial/impl/port_lock.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/line/pty.hpp"

namespace dripline::serial {
namespace {

using namespace std::chrono_literals;
using test_support::eventually;
using test_support::Pty;

Result<std::unique_ptr<Channel>> open(const std::string& path,
                                      std::string_view format = "9600n81") {
  wire::LineSettings settings;
  EXPECT_TRUE(wire::apply_short_form(format, settings));
  return open_channel(path, settings, 1s);
}

std::string read_all(Channel& channel) {
  std::array<std::byte, 64> room;
  std::string text;
  for (;;) {
    const auto got = channel.read(room);
    EXPECT_TRUE(got) << got.error().what;
    if (!got || got->bytes == 0) return text;
    text.append(reinterpret_cast<const char*>(room.data()), got->bytes);
  }
}

std::string all_characters() {
  std::string text;
  for (int i = 0; i < 256; ++i) text += static_cast<char>(i);
  return text;
}

TEST(TtyChannel, CarriesEveryCharacterBothWays) {
  const Pty pty;
  auto channel = open(pty.path());
  ASSERT_TRUE(channel) << channel.error().what;
  const std::string text = all_characters();
  const auto taken = (*channel)->write(std::as_bytes(std::span(text)));
  ASSERT_TRUE(taken);
  EXPECT_EQ(*taken, 256U);
  EXPECT_EQ(pty.read(256), text);
  pty.write(text);
  std::string got;
  EXPECT_TRUE(eventually([&] { return (got += read_all(**channel)).size() >= 256; }, 2s));
  EXPECT_EQ(got, text);
}

TEST(TtyChannel, ReportsAHangUp) {
  Pty pty;
  auto channel = open(pty.path());
  ASSERT_TRUE(channel);
  pty.unplug();
  std::array<std::byte, 8> room;
  const auto got = (*channel)->read(room);
  ASSERT_FALSE(got);
  EXPECT_EQ(got.error().code, Errc::Io);
  EXPECT_NE(got.error().what.find(pty.path()), std::string::npos);
}

TEST(TtyChannel, PutsTheSettingsBackOnClosing) {
  const Pty pty;
  termios before{}, during{}, after{};
  ASSERT_EQ(::tcgetattr(pty.slave(), &before), 0);
  ::cfsetospeed(&before, B300);
  before.c_lflag |= ECHO;
  ASSERT_EQ(::tcsetattr(pty.slave(), TCSANOW, &before), 0);
  {
    auto channel = open(pty.path(), "4800e71");
    ASSERT_TRUE(channel);
    ASSERT_EQ(::tcgetattr(pty.slave(), &during), 0);
    EXPECT_EQ(::cfgetospeed(&during), static_cast<speed_t>(B4800));
    EXPECT_EQ(during.c_lflag & ECHO, 0U);
  }
  ASSERT_EQ(::tcgetattr(pty.slave(), &after), 0);
  EXPECT_EQ(::cfgetospeed(&after), static_cast<speed_t>(B300));
  EXPECT_EQ(after.c_lflag & ECHO, static_cast<tcflag_t>(ECHO));
}

TEST(TtyChannel, RefusesWhatIsNotThere) {
  const auto channel = open("/dev/ttyNONE7");
  ASSERT_FALSE(channel);
  EXPECT_EQ(channel.error().code, Errc::NotFound);
  EXPECT_NE(channel.error().what.find("/dev/ttyNONE7"), std::string::npos);
}

TEST(TtyChannel, RefusesWhatIsNoTty) {
  const auto channel = open("/dev/null");
  ASSERT_FALSE(channel);
  EXPECT_EQ(channel.error().code, Errc::Unsupported);
}

TEST(TtyChannel, RefusesARateThatTtysDoNotHaveAndLetsThePortBe) {
  const Pty pty;
  wire::LineSettings settings;
  settings.baud = 12345;
  const auto channel = open_channel(pty.path(), settings, 1s);
  ASSERT_FALSE(channel);
  EXPECT_NE(channel.error().what.find("baud 12345"), std::string::npos) << channel.error().what;
  EXPECT_TRUE(open(pty.path()));
}

TEST(TtyChannel, RefusesAPortInUseAndNamesItsOwner) {
  const Pty pty;
  int ready[2], done[2];
  ASSERT_EQ(::pipe(ready), 0);
  ASSERT_EQ(::pipe(done), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    const auto held = open(pty.path());
    char byte = held ? 'y' : 'n';
    if (::write(ready[1], &byte, 1) != 1 || ::read(done[0], &byte, 1) < 0) ::_exit(1);
    ::_exit(0);
  }
  char byte = 0;
  ASSERT_EQ(::read(ready[0], &byte, 1), 1);
  ASSERT_EQ(byte, 'y');
  const auto channel = open(pty.path());
  ASSERT_FALSE(channel);
  EXPECT_EQ(channel.error().code, Errc::Busy);
  const std::string owner = "serial_test (pid " + std::to_string(child) + ")";
  EXPECT_NE(channel.error().what.find(owner), std::string::npos) << channel.error().what;
  ASSERT_EQ(::write(done[1], "x", 1), 1);
  ASSERT_EQ(::waitpid(child, nullptr, 0), child);
  EXPECT_TRUE(open(pty.path())) << "free again, although its owner did not release it";
}

TEST(PortLock, RespectsTheLockFileOfAnotherProgram) {
  const Pty pty;
  const test_support::TemporaryFolder folder;
  const test_support::ChildProcess other({"/bin/sleep", "60"}, folder.path() / "output");
  std::string name = pty.device().substr(5);
  std::replace(name.begin(), name.end(), '/', '_');
  std::ofstream(folder.path() / ("LCK.." + name)) << "      " << other.pid() << "\n";
  ASSERT_TRUE(eventually([&] {  // it has become itself
    std::string program;
    std::ifstream("/proc/" + std::to_string(other.pid()) + "/comm") >> program;
    return program == "sleep";
  }));
  const auto lock = PortLock::take(pty.slave(), pty.device(), folder.path());
  ASSERT_FALSE(lock);
  EXPECT_EQ(lock.error().code, Errc::Busy);
  EXPECT_NE(lock.error().what.find("sleep (pid " + std::to_string(other.pid()) + ")"),
            std::string::npos)
      << lock.error().what;
}

TEST(PortLock, TakesOverTheLockFileOfAProgramThatIsGone) {
  const Pty pty;
  const test_support::TemporaryFolder folder;
  std::string name = pty.device().substr(5);
  std::replace(name.begin(), name.end(), '/', '_');
  const auto file = folder.path() / ("LCK.." + name);
  std::ofstream(file) << "   4194399\n";
  {
    const auto lock = PortLock::take(pty.slave(), pty.device(), folder.path());
    ASSERT_TRUE(lock) << lock.error().what;
    pid_t pid = 0;
    std::ifstream(file) >> pid;
    EXPECT_EQ(pid, ::getpid());
  }
  EXPECT_FALSE(std::filesystem::exists(file));
}

}  // namespace
}  // namespace dripline::serial
