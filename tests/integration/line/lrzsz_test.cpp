#include <gtest/gtest.h>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/support/child_process.hpp"
#include "tests/support/line/host_line.hpp"
#include "tests/support/line/pty.hpp"
#include "tests/support/temporary_folder.hpp"

/// XMODEM against Debian's lrzsz as a real peer, both directions, over a pty cable.
namespace dripline::integration {
namespace {

using namespace std::chrono_literals;
using test_support::ChildProcess;
using test_support::eventually;
using test_support::HostLine;
using test_support::PtyCable;

class Lrzsz : public testing::TestWithParam<bool> {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists("/usr/bin/sz"))
      GTEST_SKIP() << "lrzsz is not installed: XMODEM is not tried against a real peer";
    for (int line = 1; line <= 300; ++line)
      text_ += "N" + std::to_string(line) + " G1 X2.5 Z-1.25\n";
  }
  wire::LineSettings settings() const {
    wire::LineSettings settings = (*wire::find_template("xmodem"))->settings;
    settings.baud = 115200;
    settings.end_of_block = wire::EndOfBlock::Lf;
    settings.xmodem_crc = GetParam();
    return settings;
  }
  /// The peer's program between two pipes: on a tty it would throw away, at its end, what the other
  /// side of a pty has not read yet.
  ChildProcess peer(const std::string& command) const {
    return ChildProcess({"/bin/sh", "-c",
                         "cat <" + cable_.control() + " | (" + command + " 2>" +
                             (folder_.path() / "errors").string() + "; echo $? >" +
                             status_.string() + ") | cat >" + cable_.control()},
                        folder_.path() / "output");
  }
  /// The program's exit status, once it has ended well or not.
  std::string status() const {
    std::string text;
    eventually([&] { return bool(std::ifstream(status_) >> text); }, 60s);
    return text;
  }

  test_support::TemporaryFolder folder_;
  std::filesystem::path status_ = folder_.path() / "status";
  PtyCable cable_;
  std::string text_;
};

TEST_P(Lrzsz, TakesWhatWeSend) {
  const auto file = folder_.path() / "received.nc";
  // In its folder: since lrzsz 0.12.21-10+deb12u1 it takes no path.
  const auto rz = peer("cd " + folder_.path().string() + " && /usr/bin/rz --xmodem --binary " +
                       (GetParam() ? "--with-crc " : "") + file.filename().string());
  HostLine host(cable_.host(), settings());
  host.send(text_);
  ASSERT_EQ(status(), "0");
  EXPECT_TRUE(eventually([&] { return host.is_idle(); }));
  EXPECT_TRUE(host.failures().empty()) << testing::PrintToString(host.failures());
  std::ifstream in(file, std::ios::binary);
  std::ostringstream got;
  got << in.rdbuf();
  std::string received = got.str();
  while (!received.empty() && received.back() == '\x1A')
    received.pop_back();  // XMODEM has no length
  EXPECT_EQ(received, text_);
}

TEST_P(Lrzsz, SendsWhatWeTake) {
  const auto file = folder_.path() / "program.nc";
  std::ofstream(file, std::ios::binary) << text_;
  const auto sz = peer("/usr/bin/sz --xmodem --binary " + file.string());
  HostLine host(cable_.host(), settings());
  host.receive();
  ASSERT_EQ(status(), "0");
  EXPECT_TRUE(eventually([&] { return host.transfers_received() == 1; }));
  EXPECT_EQ(host.last_received(), text_);
}

INSTANTIATE_TEST_SUITE_P(, Lrzsz, testing::Bool(),
                         [](const auto& i) { return i.param ? "crc" : "checksum"; });

}  // namespace
}  // namespace dripline::integration
