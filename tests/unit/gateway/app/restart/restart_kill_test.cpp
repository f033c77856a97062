// A gateway that is killed by SIGKILL at any instruction, for each control in a program with a
// subprogram, a loop, compensation and a cycle: the restart completes the part, and the path cut
// before and after is the path of an undisturbed run. DRIPLINE_RESTART_KILLS changes how often.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <random>
#include <thread>

#include "gateway/interpreter/registry.hpp"
#include "tests/support/child_process.hpp"
#include "tests/unit/gateway/app/restart/restart_fixture.hpp"
#include "tests/unit/gateway/app/restart/restart_parts.hpp"

namespace dripline::gateway {
namespace {

int kills() {
  const char* wanted = std::getenv("DRIPLINE_RESTART_KILLS");
  return wanted != nullptr ? std::atoi(wanted) : 2;
}

RestartFixture::Path read_path(const std::string& file) {
  std::ifstream in(file);
  RestartFixture::Path path;
  for (std::string line; std::getline(in, line);) path.push_back(line);
  return path;
}

class RestartAfterKill : public testing::TestWithParam<Part> {
 protected:
  std::unique_ptr<RestartFixture> shop() const {
    const auto control = interpreter::find_dialect(GetParam().control).value();
    auto setup = interpreter::parse_setup(GetParam().setup, control->units).value();
    auto made = std::make_unique<RestartFixture>(*control, std::move(setup), "20x");
    made->acknowledges = false;  // its records are read again by another process
    made->set_checkpoint_interval(std::chrono::milliseconds(200));
    made->push("P", GetParam().program);
    made->restart_gateway();
    made->path.clear();
    return made;
  }

  /// In a process of its own, which is killed after this time. Its path is in the file.
  void run_and_kill(RestartFixture& fixture, std::chrono::microseconds after) {
    fixture.close_gateway();
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      fixture.path_file = fixture.folder() / "path";
      fixture.restart_gateway();
      std::ofstream(fixture.folder() / "path", std::ios::trunc).close();
      (void)fixture.start_program("P");
      (void)fixture.run_on();
      ::_exit(0);
    }
    const auto path = fixture.folder() / "path";
    const auto has_begun = [&path] {
      std::error_code error;
      return std::filesystem::file_size(path, error) > 0 && !error;
    };
    EXPECT_TRUE(test_support::eventually(has_begun));
    std::this_thread::sleep_for(after);  // the moment of the kill is the test's subject
    ::kill(child, SIGKILL);
    int status = 0;
    ::waitpid(child, &status, 0);
  }

  void kill_and_restart(const RestartFixture::Path& whole, std::chrono::microseconds after) {
    const auto fixture = shop();
    run_and_kill(*fixture, after);
    const auto truth = fixture->execution_probe();
    const auto before = read_path(fixture->folder() / "path");
    fixture->restart_gateway();
    (void)fixture->start_command("P");  // the child's run is run-1
    // A command with the id of one of the child's would be answered as that one was.
    for (int i = 0; i < 10'000; ++i) (void)fixture->command(dds::CommandAction::Hold);
    const bool has_ended =
        fixture->run_until([&] { return fixture->count(dds::RecordKind::RunEnded) == 1; });
    if (!has_ended || fixture->last_end().outcome != dds::RunOutcome::Interrupted) return;
    const std::uint64_t executed = fixture->last_end().executed;
    EXPECT_GE(executed, truth.blocks_done);
    EXPECT_LE(executed, truth.blocks_begun);
    const std::size_t cut = length_up_to(whole, executed);
    ASSERT_GE(before.size(), cut);
    for (std::size_t i = 0; i < cut; ++i) ASSERT_EQ(before[i], whole[i]);

    const auto report = fixture->begin_restart("P", "run-1");
    ASSERT_TRUE(report.is_object())
        << fixture->start_answer.reason << fixture->last_end().reason << " after " << executed;
    EXPECT_EQ(report["after"]["block"], executed);
    if (executed > 0) {
      EXPECT_EQ(report["proof"]["path"], "equal");
    }
    states += report["proof"]["state"] == "equal";
    EXPECT_TRUE(fixture->run_until([&] {
      return fixture->status->waits_for == dds::WaitsFor::CycleStart;
    })) << "nothing moves before it";
    ASSERT_TRUE(fixture->cycle_start());
    ASSERT_TRUE(fixture->run_on());
    EXPECT_EQ(fixture->last_end().outcome, dds::RunOutcome::Completed)
        << fixture->last_end().reason;
    EXPECT_EQ(difference(whole, fixture->path, executed), "") << "after block " << executed;
    ++done;
  }

  int done = 0, states = 0;
};

TEST_P(RestartAfterKill, CompletesThePart) {
  const auto undisturbed = shop();
  ASSERT_TRUE(undisturbed->start_program("P").accepted);
  const auto begun = std::chrono::steady_clock::now();
  ASSERT_TRUE(undisturbed->run_on());
  const auto took = std::chrono::steady_clock::now() - begun;
  ASSERT_EQ(undisturbed->last_end().outcome, dds::RunOutcome::Completed)
      << undisturbed->last_end().reason;
  std::mt19937 random{20261123};
  const auto longest = std::chrono::duration_cast<std::chrono::microseconds>(took).count();
  int tries = 0;
  while (done < kills() && tries < 10 * kills() + 10 && !HasFailure()) {
    ++tries;
    kill_and_restart(
        undisturbed->path,
        std::chrono::microseconds(std::uniform_int_distribution<std::int64_t>(0, longest)(random)));
  }
  std::printf("%s: %d kills in mid-program, %d with a state to compare\n", GetParam().control, done,
              states);
  EXPECT_EQ(done, kills()) << "the kills must hit running programs";
}

INSTANTIATE_TEST_SUITE_P(, RestartAfterKill, testing::ValuesIn(kParts), [](const auto& i) {
  std::string name = i.param.control;
  std::erase(name, '-');
  return name;
});

}  // namespace
}  // namespace dripline::gateway
