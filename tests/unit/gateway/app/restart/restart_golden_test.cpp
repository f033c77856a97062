// Every golden program of every control, cut off at some moment and restarted: the path before and
// after is the path of an undisturbed run. Every third program once; with DRIPLINE_RESTARTS all of
// them, so often.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <cstdlib>
#include <map>
#include <random>

#include "tests/golden/golden_case.hpp"
#include "tests/unit/gateway/app/restart/restart_fixture.hpp"

namespace dripline::gateway {
namespace {

using interpreter::GoldenCase;

constexpr const char* kSpeed = "300x";

int restarts() {
  const char* wanted = std::getenv("DRIPLINE_RESTARTS");
  return wanted != nullptr ? std::atoi(wanted) : 1;
}

class RestartOfGolden : public testing::TestWithParam<std::string> {
 protected:
  struct Whole {
    RestartFixture::Path path;
    dds::RunEndText end;
    std::size_t steps = 0;
  };
  std::unique_ptr<RestartFixture> shop() const {
    const auto control = interpreter::find_dialect(golden.control).value();
    auto made = std::make_unique<RestartFixture>(*control, setup_of(golden, *control), kSpeed);
    made->loader = loader_of(golden);
    made->set_checkpoint_interval(std::chrono::milliseconds(200));
    made->push("P", golden.program());
    made->restart_gateway();
    made->path.clear();
    return made;
  }
  /// Nothing: this program is not run by a gateway.
  std::optional<Whole> run_whole() const {
    const auto undisturbed = shop();
    if (!undisturbed->start_program("P").accepted) return std::nullopt;
    if (!undisturbed->run_on(20'000)) return std::nullopt;
    return Whole{undisturbed->path, undisturbed->last_end(), undisturbed->steps()};
  }
  /// No approach leads to a tilted tool (RestartOfAHead), nor on a lathe from a place where the
  /// tool has not been (LatheApproach); the simulated axes are where the run began.
  bool is_left_to_operator(const std::string& reason) {
    for (const char* why : {"the tool is tilted", "is known to be free", "continues the thread",
                            "is known to be clear"}) {
      if (reason.find(why) == std::string::npos) continue;
      ++refused[why];
      if (std::getenv("DRIPLINE_RESTARTS") != nullptr)
        std::printf("%s/%s: %s\n", golden.control.c_str(), golden.name.c_str(), reason.c_str());
      return true;
    }
    return false;
  }
  void cut_off_and_restart(const Whole& whole, std::size_t steps) {
    const auto cut = shop();
    ASSERT_TRUE(cut->start_program("P").accepted);
    const std::string run = cut->last_run();
    if (cut->run_on(steps)) return;  // it was too late
    cut->restart_gateway();
    ASSERT_TRUE(cut->run_until([&] { return cut->count(dds::RecordKind::RunEnded) == 1; }));
    const std::uint64_t executed = cut->last_end().executed;
    cut->path.clear();
    const auto report = cut->begin_restart("P", run);
    if (!report.is_object() && is_left_to_operator(cut->last_end().reason)) return;
    ASSERT_TRUE(report.is_object())
        << cut->start_answer.reason << cut->last_end().reason << " after block " << executed;
    EXPECT_EQ(report["after"]["block"], executed);
    if (executed > 0) {
      EXPECT_EQ(report["proof"]["path"], "equal");
    }
    states += report["proof"]["state"] == "equal";
    ASSERT_TRUE(cut->cycle_start());
    ASSERT_TRUE(cut->run_on());
    EXPECT_EQ(cut->last_end().outcome, whole.end.outcome) << cut->last_end().reason;
    EXPECT_EQ(difference(whole.path, cut->path, executed), "") << "after block " << executed;
    ++done;
  }

  GoldenCase golden;
  int done = 0, states = 0;
  std::map<std::string, int> refused;  ///< by reason
};

TEST_P(RestartOfGolden, CutsThePathOfAnUndisturbedRun) {
  std::mt19937 random{20261123};
  const bool takes_all = std::getenv("DRIPLINE_RESTARTS") != nullptr;
  constexpr std::size_t kFew = 60;
  const auto names = interpreter::golden_names(GetParam());
  const int stride = takes_all || names.size() < kFew ? 1 : 3;
  int number = 0;
  for (const auto& name : names) {
    if (number++ % stride != 0) continue;
    golden = interpreter::read_golden_case(name.control, name.name);
    SCOPED_TRACE(name.control + "/" + name.name);
    const auto whole = run_whole();
    if (!whole || whole->steps < 2) continue;
    for (int i = 0; i < restarts() && !HasFatalFailure(); ++i) {
      cut_off_and_restart(*whole,
                          std::uniform_int_distribution<std::size_t>(1, whole->steps - 1)(random));
    }
  }
  RecordProperty("restarts", done);
  RecordProperty("states_compared", states);
  std::printf("%s: %d restarts, %d with a state to compare\n", GetParam().c_str(), done, states);
  for (const auto& [why, count] : refused)
    std::printf("%s: %d refused, %s\n", GetParam().c_str(), count, why.c_str());
  int left = 0;  // to the operator: a program at one height alone is
  for (const auto& [why, count] : refused) left += count;
  EXPECT_GT(done + left, 5);
}

INSTANTIATE_TEST_SUITE_P(, RestartOfGolden,
                         testing::Values("centurion", "fanuc", "itnc", "prototrak-plus", "rs274ngc",
                                         "tektronix-1704", "tnc155"),
                         [](const auto& i) {
                           std::string name = i.param;
                           std::erase(name, '-');
                           return name;
                         });

/// Nothing was executed: what the control checks at a start, that called programs are there, it
/// checks again, before anything moves.
TEST(RestartOfATnc, ChecksForCalledProgramsAgain) {
  const auto golden = interpreter::read_golden_case("tnc155", "alarm-program-missing");
  const auto control = interpreter::find_dialect(golden.control).value();
  RestartFixture shop(*control, setup_of(golden, *control), kSpeed);
  shop.loader = loader_of(golden);
  shop.push("P", golden.program());
  shop.restart_gateway();
  ASSERT_TRUE(shop.start_program("P").accepted);
  const std::string run = shop.last_run();
  ASSERT_FALSE(shop.run_on(1));
  shop.restart_gateway();
  ASSERT_TRUE(shop.run_until([&] { return shop.count(dds::RecordKind::RunEnded) == 1; }));
  ASSERT_EQ(shop.last_end().executed, 0u);
  shop.path.clear();
  ASSERT_TRUE(shop.begin_restart("P", run).is_object()) << shop.last_end().reason;
  ASSERT_TRUE(shop.cycle_start());
  ASSERT_TRUE(shop.run_on());
  EXPECT_EQ(shop.last_end().outcome, dds::RunOutcome::Alarmed) << shop.last_end().reason;
  EXPECT_THAT(shop.path, testing::Each(testing::Not(testing::HasSubstr(" line ")))) << "it moved";
}

}  // namespace
}  // namespace dripline::gateway
