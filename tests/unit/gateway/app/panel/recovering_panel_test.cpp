#include <gtest/gtest.h>

#include "gateway/report/motion_journal.hpp"
#include "tests/unit/gateway/app/gateway_fixture.hpp"
#include "tests/unit/gateway/app/toy_motion.hpp"

namespace dripline::gateway {
namespace {

/// As a device whose link is not there yet; it is seen to rest when the stop is pressed.
class SlowToRest : public ToyMotion {
 public:
  SlowToRest(machine::ExecutionSink& sink, int& looks, int& aborts)
      : ToyMotion(sink), looks_(looks), aborts_(aborts) {}
  void abort() override {
    ++aborts_;
    ToyMotion::abort();
  }
  std::optional<machine::GivenAction::Point> rests_at() const override {
    constexpr int kEnough = 300;  // 3 s: a gateway that serves no panel fails its test, and ends
    if (!panel().emergency_stop && ++looks_ < kEnough) return std::nullopt;
    return machine::GivenAction::Point{};
  }

 private:
  int& looks_;
  int& aborts_;
};

TEST(PanelOfAGatewayThatRecovers, TakesStopsAndNothingElse) {
  GatewayFixture fixture{"1x"};
  int looks = 0, aborts = 0, aborts_at_hold = 0;
  fixture.motion = [&](machine::ExecutionSink& sink) {
    return std::make_unique<SlowToRest>(sink, looks, aborts);
  };
  fixture.restart_gateway();
  fixture.push("O1", "X1\nSTOP\nEND\n");
  ASSERT_TRUE(fixture.start("O1").accepted);
  fixture.close_gateway();
  {
    auto journal = report::MotionJournal::open(fixture.folder() / "motion.journal").value();
    report::MotionJournal::Entry entry;
    entry.place.executed = entry.action.origin.block = 100;
    entry.action.kind = machine::GivenAction::Kind::Motion;
    entry.action.ends_block = true;
    entry.action.end[0] = 1;
    journal.begin("run-1");
    journal.write(entry);
  }
  std::vector<std::string> answers;
  fixture.take_panel = [&] {
    std::vector<PanelRequest> requests;
    if (!answers.empty()) return requests;
    for (const char* line : {"home", "hold", "emergency-stop"})
      requests.push_back(
          {.command = parse_panel_command(line).value(), .answer = [&](std::string text) {
             answers.push_back(std::move(text));
             if (answers.size() == 2) aborts_at_hold = aborts;
           }});
    return requests;
  };
  looks = aborts = 0;
  fixture.restart_gateway();
  ASSERT_EQ(answers.size(), 3u);
  EXPECT_TRUE(answers[0].starts_with("refused the gateway waits")) << answers[0];
  EXPECT_TRUE(answers[1].starts_with("ok what the machine still had")) << answers[1];
  EXPECT_EQ(aborts_at_hold, 1) << "the device was stopped before the answer";
  EXPECT_EQ(answers[2], "ok");
  EXPECT_LT(looks, 3) << "and it took effect at once";
  EXPECT_NE(fixture.panel("status").find("emergency_stop=pressed"), std::string::npos);
}

}  // namespace
}  // namespace dripline::gateway
