// The helper itself, with a module for Python that has no LinuxCNC.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/prctl.h>
#include <unistd.h>
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "gateway/machine/linuxcnc/helper_process.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/temporary_folder.hpp"

namespace dripline::machine::linuxcnc::test {
namespace {

namespace fs = std::filesystem;
using test_support::eventually;

class LinuxCncHelper : public testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists("/usr/bin/python3")) GTEST_SKIP() << "skipped: python3 is not installed";
    ::setenv("PYTHONDONTWRITEBYTECODE", "1", 1);
    ::setenv("PYTHONPATH", fs::absolute("tests/support/linuxcnc/double").c_str(), 1);
    // The helper wants a process of the task's name: this one, and none of the tests beside it.
    const std::string name = fmt::format("task{}", ::getpid());
    ASSERT_EQ(::prctl(PR_SET_NAME, name.c_str()), 0);
    std::ofstream(folder_.path() / "mill.ini") << "TASK = " << name << "\n";
    auto started = HelperProcess::start(folder_.path() / "mill.ini");
    ::unsetenv("PYTHONPATH");
    ASSERT_TRUE(started) << started.error().what;
    helper_.emplace(*std::move(started));
    ASSERT_TRUE(hears("\"status\"")) << said_;
  }
  void order(const std::string& members) {
    std::string line = fmt::format("{{\"n\":{},{}}}\n", ++number_, members);
    ASSERT_TRUE(helper_->write(line));
    ASSERT_EQ(line, "");
  }
  /// The helper says so within some time.
  bool hears(const std::string& text) {
    return eventually([&] {
      (void)helper_->read(said_);
      return said_.find(text) != std::string::npos;
    });
  }
  bool is_done(int number) { return hears(fmt::format("\"done\":{},", number)); }
  std::vector<std::string> sent() const {
    std::vector<std::string> lines;
    std::ifstream file(folder_.path() / "sent");
    for (std::string line; std::getline(file, line);) lines.push_back(line);
    return lines;
  }
  bool has_sent(const std::string& command) const {
    return std::ranges::count(sent(), command) > 0;
  }
  bool sends(const std::string& command) {
    return eventually([&] { return has_sent(command); });
  }
  /// LinuxCNC's task takes no more commands than it has.
  void make_busy() {
    std::ofstream(folder_.path() / "busy.new") << sent().size() << "\n";
    fs::rename(folder_.path() / "busy.new", folder_.path() / "busy");
  }
  void make_free() { fs::remove(folder_.path() / "busy"); }

  static constexpr const char* kJog = R"("do":"jog","axis":0,"velocity":10.0,"distance":2.0)";
  static constexpr const char* kOverride =
      R"("do":"override","feed":0.5,"rapid":1.0,"spindle":1.0)";
  std::string said_;  ///< by the helper

 private:
  test_support::TemporaryFolder folder_;
  std::optional<HelperProcess> helper_;
  int number_ = 0;
};

using Lines = std::vector<std::string>;

TEST_F(LinuxCncHelper, CarriesOrdersOutOneAfterAnother) {
  order(kOverride);
  order(kJog);
  ASSERT_TRUE(is_done(2));
  EXPECT_EQ(sent(), (Lines{"feedrate 0.5", "rapidrate 1.0", "spindleoverride 1.0", "mode 1",
                           "teleop_enable 1", "jog 2 0 0 10.0 2.0"}));
}

TEST_F(LinuxCncHelper, SendsAnEmergencyStopWhileAnOrderWaits) {
  make_busy();
  order(kJog);
  ASSERT_TRUE(sends("mode 1"));
  order(R"("do":"emergency")");
  EXPECT_TRUE(sends("state 1")) << "the task has not taken the command before it";
  make_free();
  ASSERT_TRUE(is_done(1));
  ASSERT_TRUE(is_done(2));
  order(R"("do":"reset")");
  ASSERT_TRUE(is_done(3));
  EXPECT_EQ(sent(), (Lines{"mode 1", "state 1", "state 1", "state 2"}))
      << "the jog never begins; the stop comes after the overtaken order, too";
}

TEST_F(LinuxCncHelper, SendsAStopOfAJogWhileTheJogWaits) {
  make_busy();
  order(kJog);
  ASSERT_TRUE(sends("mode 1"));
  order(R"("do":"stop_jog","axis":0)");
  EXPECT_TRUE(sends("jog 0 0 0"));
  make_free();
  ASSERT_TRUE(is_done(1));
  ASSERT_TRUE(is_done(2));
  order(kOverride);
  ASSERT_TRUE(is_done(3));
  EXPECT_FALSE(has_sent("jog 2 0 0 10.0 2.0"));
}

TEST_F(LinuxCncHelper, NeitherHomesNorRunsAfterAnAbort) {
  make_busy();
  order(R"("do":"home")");
  ASSERT_TRUE(sends("state 4"));
  order(R"("do":"run","file":"/nowhere")");
  order(R"("do":"abort")");
  EXPECT_TRUE(sends("abort"));
  make_free();
  for (const int number : {1, 2, 3}) ASSERT_TRUE(is_done(number));
  order(kOverride);
  ASSERT_TRUE(is_done(4));
  EXPECT_FALSE(has_sent("home -1"));
  EXPECT_FALSE(has_sent("auto 0 0"));
}

// An override is in force after the hold, too; a resume before it is not.
TEST_F(LinuxCncHelper, AHoldDropsAResumeAndKeepsAnOverride) {
  make_busy();
  order(kOverride);
  ASSERT_TRUE(sends("feedrate 0.5"));
  order(R"("do":"resume")");
  order(kOverride);
  order(R"("do":"pause")");
  EXPECT_TRUE(sends("auto 1"));
  make_free();
  for (const int number : {1, 2, 3, 4}) ASSERT_TRUE(is_done(number));
  EXPECT_FALSE(has_sent("auto 2"));
  EXPECT_EQ(std::ranges::count(sent(), "spindleoverride 1.0"), 2);
  order(R"("do":"resume")");
  EXPECT_TRUE(sends("auto 2")) << "one that comes later";
}

// Its status is an old one: what the axes do is not known.
TEST_F(LinuxCncHelper, EndsWhereTheTaskTakesNoCommand) {
  make_busy();
  order(kOverride);
  EXPECT_TRUE(hears("LinuxCNC takes no commands")) << said_;
}

}  // namespace
}  // namespace dripline::machine::linuxcnc::test
