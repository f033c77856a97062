// One axis by one step, without a program.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/unit/gateway/app/jog_fixture.hpp"
#include "tests/unit/gateway/app/toy_motion.hpp"

namespace dripline::gateway {
namespace {

using dds::CommandAction;
using interpreter::Dialect;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;
using namespace std::chrono_literals;

// CEN-222, HD-072.
TEST(Jog, MovesOneAxisByTheStepAndAnswersWhereItIs) {
  JogShop shop(interpreter::kFanucDialect);
  EXPECT_EQ(shop.jog("X -1.5 mm F300"), "X -1.5 mm");
  EXPECT_EQ(shop.at(0), -1.5);
  EXPECT_EQ(shop.at(1), 0);
  EXPECT_EQ(shop.jog("X 1 in F10"), "X 0.9409 in");
  EXPECT_NEAR(shop.at(0), 23.9, 1e-9);
  EXPECT_EQ(shop.jog("C 90 deg"), "C 90 degrees");
  const auto reply = shop.send(shop.jog_command("Z 0.01 mm"));
  EXPECT_EQ(nlohmann::json::parse(reply.values),
            nlohmann::json::parse(
                R"({"axis":"Z","moved":0.01,"position":0.01,"reached":true,"unit":"mm"})"));
  EXPECT_EQ(shop.count(dds::RecordKind::RunStarted), 0U);
}

TEST(Jog, OfALathesXIsOfItsDiameter) {
  JogShop shop(interpreter::kFanucLatheDialect);
  EXPECT_EQ(shop.jog("X 4 mm F300"), "X diameter 4 mm");
  EXPECT_EQ(shop.at(0), 2) << "the API's positions are radii";
  EXPECT_EQ(shop.jog("Z -4 mm F300"), "Z -4 mm");
  EXPECT_EQ(shop.at(2), -4);
}

TEST(Jog, TakesItsTimeAndIsShownMeanwhile) {
  JogShop shop(interpreter::kFanucDialect);
  const auto command = shop.begin("X 10 mm F600");
  shop.pass(500ms);
  EXPECT_NEAR(shop.at(0), 5, 0.2);
  EXPECT_EQ(shop.gateway->status().mode, dds::ControllerMode::Manual);
  ASSERT_TRUE(shop.gateway->status().jog);
  EXPECT_TRUE(shop.gateway->status().jog->is_moving);
  EXPECT_EQ(shop.results.count(command.id), 0U);
  EXPECT_EQ(shop.end_of(command), "X 10 mm");
  EXPECT_EQ(shop.gateway->status().mode, dds::ControllerMode::Automatic);
  EXPECT_EQ(shop.refusal(), "");
}

TEST(Jog, IsNotRepeatedHoweverOftenItsCommandComes) {
  JogShop shop(interpreter::kFanucDialect);
  const auto command = shop.begin("X 5 mm F600");
  for (int i = 0; i < 4; ++i) {
    shop.pass(50ms);
    shop.gateway->receive(command, shop.clock.steady);
  }
  EXPECT_EQ(shop.end_of(command), "X 5 mm");
  shop.results.clear();
  EXPECT_EQ(shop.answer_to(command), "X 5 mm") << "the answer that was kept";
  shop.pass(2s);
  EXPECT_EQ(shop.at(0), 5);
  shop.restart_gateway();
  EXPECT_EQ(shop.at(0), 0) << "a simulated machine begins at its start";
  shop.results.clear();
  shop.gateway->receive(command, shop.clock.steady);
  shop.pass(1s);
  EXPECT_EQ(shop.at(0), 0) << "nor does the next process move";
}

TEST(Jog, IsNotBegunByTheNextProcess) {
  JogShop shop(interpreter::kFanucDialect);
  const auto command = shop.begin("X 20 mm F600");
  shop.pass(200ms);
  shop.restart_gateway();
  shop.gateway->receive(command, shop.clock.steady);
  shop.pass(3s);
  EXPECT_EQ(shop.at(0), 0);
  dds::Command of_another = command;
  of_another.session = 0;
  EXPECT_THAT(shop.answer_to(of_another), StartsWith("refused: the command names no session"));
}

TEST(Jog, ThatComesLateOrAfterAStopIsRefused) {
  JogShop shop(interpreter::kFanucDialect);
  auto late = shop.jog_command("X 1 mm");
  late.deadline = shop.steady_time();
  shop.pass(100ms);
  EXPECT_THAT(shop.answer_to(late),
              AllOf(StartsWith("refused: "), HasSubstr("after its deadline")));
  auto overtaken = shop.jog_command("X 1 mm");
  (void)shop.send(shop.stop());
  EXPECT_EQ(shop.answer_to(overtaken),
            "refused: a later command has stopped the machine meanwhile");
  EXPECT_EQ(shop.at(0), 0);
}

TEST(Jog, IsRefusedWhileAnotherMoves) {
  JogShop shop(interpreter::kFanucDialect);
  const auto first = shop.begin("X 10 mm F600");
  EXPECT_EQ(shop.jog("X -10 mm F600"), "refused: the machine is being jogged");
  EXPECT_EQ(shop.jog("Z 1 mm"), "refused: the machine is being jogged");
  EXPECT_EQ(shop.run("G21 G90 G1 X1. F600\nM30\n"), "refused: the machine is being jogged");
  EXPECT_EQ(shop.mdi("G0 X1.\n"), "refused: the machine is being jogged");
  EXPECT_EQ(shop.set("datum G54 X 0 mm"), "refused: the machine is being jogged");
  EXPECT_EQ(shop.panel("home"), "refused the machine is being jogged");
  EXPECT_EQ(shop.end_of(first), "X 10 mm");
}

TEST(Jog, EachStopEndsItAndItsAnswerStatesWhere) {
  const std::vector<std::pair<std::string, std::function<void(JogShop&)>>> stops{
      {"by command", [](JogShop& shop) { (void)shop.send(shop.stop()); }},
      {"by command", [](JogShop& shop) { (void)shop.send(shop.command(CommandAction::Hold)); }},
      {"by command", [](JogShop& shop) { (void)shop.send(shop.command(CommandAction::Abort)); }},
      {"at the machine's panel", [](JogShop& shop) { (void)shop.panel("hold"); }},
      {"at the machine's panel", [](JogShop& shop) { (void)shop.panel("abort"); }},
      {"by the emergency stop", [](JogShop& shop) { (void)shop.panel("emergency-stop on"); }},
      {"by the feed override",
       [](JogShop& shop) {
         auto override = shop.command(CommandAction::FeedOverride);
         override.value = 0;
         (void)shop.send(override);
       }},
      {"with the gateway",
       [](JogShop& shop) { shop.gateway->receive(StopRequested{15}, shop.clock.steady); }},
  };
  for (const auto& [why, stop] : stops) {
    JogShop shop(interpreter::kFanucDialect);
    const auto command = shop.begin("X 50 mm F1200");
    shop.pass(500ms);
    stop(shop);
    const std::string end = shop.end_of(command);
    EXPECT_THAT(end, AllOf(StartsWith("X "), HasSubstr("mm, stopped " + why)));
    const double at = shop.at(0);
    EXPECT_GT(at, 5) << why;
    EXPECT_LT(at, 20) << why;
    EXPECT_FALSE(nlohmann::json::parse(shop.results[command.id].values)["reached"]);
    shop.pass(2s);
    EXPECT_EQ(shop.at(0), at) << why;
  }
}

TEST(Jog, AStopOfJogsTouchesNoRun) {
  JogShop shop(interpreter::kFanucDialect);
  EXPECT_EQ(shop.answer_to(shop.stop()), "refused: nothing is jogged");
  shop.push("O1", "O1\nG21 G90 G1 X50. F600\nM30\n");
  ASSERT_TRUE(shop.start("O1").accepted);
  shop.pass(500ms);
  EXPECT_EQ(shop.answer_to(shop.stop()), "refused: nothing is jogged");
  EXPECT_EQ(shop.ended().outcome, dds::RunOutcome::Completed);
}

TEST(Jog, IsRefusedWithinARunHeldOrNot) {
  JogShop shop(interpreter::kFanucDialect);
  shop.push("O1", "O1\nG21 G90 G1 X50. F600\nM30\n");
  ASSERT_TRUE(shop.start("O1").accepted);
  shop.pass(500ms);
  EXPECT_THAT(shop.jog("Z 1 mm"), AllOf(StartsWith("refused: run "), HasSubstr("is active")));
  EXPECT_THAT(shop.refusal(), HasSubstr("is active"));
  (void)shop.send(shop.command(CommandAction::Hold));
  shop.pass(500ms);
  EXPECT_THAT(shop.jog("Z 1 mm"), AllOf(StartsWith("refused: run "), HasSubstr("is active")));
  (void)shop.send(shop.command(CommandAction::Resume));
  EXPECT_EQ(shop.ended().outcome, dds::RunOutcome::Completed);
  EXPECT_EQ(shop.at(2), 0);
}

TEST(Jog, NeedsTheRemoteEnableWhereAnOperatorIs) {
  JogShop shop(interpreter::kFanucDialect);
  shop.make_attended();
  EXPECT_THAT(shop.jog("X 1 mm"), StartsWith("refused: the machine's operator has not given"));
  EXPECT_THAT(shop.refusal(), HasSubstr("remote enable"));
  EXPECT_EQ(shop.panel("remote-enable on"), "ok");
  EXPECT_EQ(shop.refusal(), "");
  EXPECT_EQ(shop.jog("X 1 mm"), "X 1 mm");
  const auto command = shop.begin("X 50 mm F1200");
  shop.pass(300ms);
  EXPECT_EQ(shop.panel("remote-enable off"), "ok");
  EXPECT_THAT(shop.end_of(command), HasSubstr("stopped without the remote enable"));
}

TEST(Jog, IsAsLargeAndAsQuickAsTheGatewayAllows) {
  JogShop shop(interpreter::kFanucDialect);
  shop.allow_jogs(1, 300);
  EXPECT_EQ(shop.jog("X 1.001 mm"), "refused: a step of 1.001 mm: this gateway takes 1 at most");
  EXPECT_EQ(shop.jog("X 0.1 in"),
            "refused: a step of 0.1 in: this gateway takes 0.0393701 at most");
  EXPECT_EQ(shop.jog("A -2 deg"), "refused: a step of 2 deg: this gateway takes 1 at most");
  EXPECT_EQ(shop.jog("X 1 mm F301"),
            "refused: a feed of 301 mm/min: this gateway takes 300 at most");
  EXPECT_THAT(shop.jog("X 1 mm F5"), HasSubstr("would take 12 s: 10 s at most"));
  EXPECT_THAT(shop.jog("X 1e300 mm"), StartsWith("refused: a step of"));
  for (const char* bad : {"", "X", "X 1", "X nan mm", "X inf mm", "X 0 mm", "X 1 deg", "C 1 mm",
                          "Q 1 mm", "x 1 mm", "X 1 mm F0", "X 1 mm F-5", "X 1 mm Fnan", "X 1 mm F",
                          "X 1 mm 5", "X 1 mm F5 ", "X  1 mm", "XY 1 mm"})
    EXPECT_THAT(shop.jog(bad), StartsWith("refused: ")) << bad;
  EXPECT_EQ(shop.jog("U 1 mm"), "refused: this machine has no axis U");
  EXPECT_EQ(shop.at(0), 0);
  shop.allow_jogs(0, 300);
  EXPECT_THAT(shop.jog("X 0.001 mm"), HasSubstr("allows no jog"));
  EXPECT_EQ(shop.gateway->status().jog->step, 0);
}

struct LimitCase {
  std::string name;
  const Dialect& control;
  std::string toml, allowed, refused, reason;
};
void PrintTo(const LimitCase& shown, std::ostream* out) {
  *out << shown.name;
}
class JogLimits : public testing::TestWithParam<LimitCase> {};

TEST_P(JogLimits, AreThoseOfTheControl) {
  JogShop shop(GetParam().control, GetParam().toml);
  EXPECT_THAT(shop.jog(GetParam().refused),
              AllOf(StartsWith("refused: "), HasSubstr(GetParam().reason)));
  EXPECT_EQ(shop.at(0), 0);
  EXPECT_THAT(shop.jog(GetParam().allowed), testing::Not(StartsWith("refused")));
}

INSTANTIATE_TEST_SUITE_P(
    , JogLimits,
    testing::Values(LimitCase{"stroke_limits", interpreter::kFanucDialect,
                              "[control]\nstroke_limits = [{ X = -5.0 }, { X = 5.0 }]\n", "X -5 mm",
                              "X -5.1 mm", "is beyond stroke limit 1"},
                    LimitCase{"tnc", interpreter::kTnc155Dialect,
                              "[control]\nlimit_high = { X = 5.0 }\n", "X 5 mm", "X 5.1 mm", "X+"}),
    [](const auto& row) { return row.param.name; });

TEST(Jog, MdiAfterItBeginsWhereTheAxisIs) {
  JogShop shop(interpreter::kFanucDialect, "[[tool]]\nnumber = 1\nlength = 50.0\n");
  ASSERT_EQ(shop.run("G21 G90 G1 F6000 X10.\nG43 H1 G0 Z-20.\nG91\nM30\n"), "completed");
  EXPECT_EQ(shop.jog("X 2.5 mm"), "X 12.5 mm");
  EXPECT_EQ(shop.jog("Z 1 mm"), "Z -19 mm");
  ASSERT_EQ(shop.mdi("G21 G91 G1 X1. Z1. F6000\n"), "completed");
  EXPECT_NEAR(shop.at(0), 13.5, 1e-9);
  EXPECT_NEAR(shop.at(2), 32, 1e-9) << "of no tool: -19 + 50 + 1";
  EXPECT_THAT(shop.records.back().run, testing::Not(testing::IsEmpty()));
  ASSERT_EQ(shop.mdi("G90 G54 G1 X3. F6000\n"), "completed");
  EXPECT_NEAR(shop.at(0), 3, 1e-9);
}

TEST(Jog, ADatumSetAfterItIsThatOfTheNewPlace) {
  JogShop shop(interpreter::kFanucDialect);
  ASSERT_EQ(shop.mdi("G21 G90 G0 X10.\n"), "completed");
  ASSERT_EQ(shop.jog("X 2.5 mm"), "X 12.5 mm");
  EXPECT_THAT(shop.set("datum G54 X 0 mm"), StartsWith("G54.X is 12.500 mm"));
  ASSERT_EQ(shop.mdi("G21 G90 G54 G1 X1. F6000\n"), "completed");
  EXPECT_NEAR(shop.at(0), 13.5, 1e-9);
}

TEST(Jog, IsRefusedWithMachineLockAndAnEmergencyStop) {
  JogShop shop(interpreter::kFanucDialect);
  auto lock = shop.command(CommandAction::Switch);
  lock.argument = "machine_lock";
  lock.value = 1;
  ASSERT_TRUE(shop.send(lock).accepted);
  EXPECT_EQ(shop.jog("X 1 mm"), "refused: machine lock is on: the axes do not move");
  lock = shop.command(CommandAction::Switch);
  lock.argument = "machine_lock";
  ASSERT_TRUE(shop.send(lock).accepted);
  EXPECT_EQ(shop.panel("emergency-stop on"), "ok");
  EXPECT_THAT(shop.jog("X 1 mm"), HasSubstr("emergency stop"));
  EXPECT_EQ(shop.panel("emergency-stop off"), "ok");
  EXPECT_EQ(shop.jog("X 1 mm"), "X 1 mm");
}

/// A full disk: the answer waits with the records, and the command is not begun again.
TEST(Jog, WhoseAnswerCannotBeKeptIsNotRepeatedEither) {
  JogShop shop(interpreter::kFanucDialect);
  shop.outbox_bytes = 160 * 1024;
  shop.acknowledges = false;
  shop.make_attended();
  (void)shop.panel("remote-enable on");
  for (int i = 1; i < 5000; ++i)
    if (shop.set(fmt::format("datum G54 X {} mm", i)).starts_with("refused: ")) break;
  for (int i = 0; i < 300; ++i) {  // their records wait for room, and all after them
    (void)shop.panel("remote-enable off");
    (void)shop.panel("remote-enable on");
  }
  const auto command = shop.jog_command("X 0.1 mm F6000");
  const std::string first = shop.answer_to(command);
  const double at = shop.at(0);
  EXPECT_EQ(shop.answer_to(command), first);
  shop.pass(500ms);
  EXPECT_EQ(shop.at(0), at);
  const auto moving = shop.begin("X 10 mm F600");
  const auto refused = shop.jog_command("X 1 mm F6000");
  EXPECT_EQ(shop.answer_to(refused), "refused: the machine is being jogged");
  EXPECT_EQ(shop.end_of(moving), fmt::format("X {:.4g} mm", at + 10));
  EXPECT_EQ(shop.answer_to(refused), "refused: the machine is being jogged") << "as before";
}

TEST(Jog, IsRefusedByAMachineThatHasNone) {
  JogShop shop(interpreter::kFanucDialect);
  shop.motion = [](machine::ExecutionSink& sink) {
    return std::make_unique<ToyMotion>(sink, true);
  };
  shop.restart_gateway();
  EXPECT_THAT(shop.jog("X 1 mm"), StartsWith("refused: this machine moves by programs alone"));
  EXPECT_FALSE(shop.gateway->status().jog) << "the page shows no buttons";
}

/// Who has given it has not seen the stop.
TEST(JogAfterAStop, MovesNothingThatWasGivenBeforeOrAsTheAxesStopped) {
  JogShop shop(interpreter::kFanucDialect);
  const auto now = [&] {
    return std::chrono::duration_cast<std::chrono::microseconds>(
        shop.clock.steady.time_since_epoch());
  };
  const auto at = [&](dds::Command command, std::chrono::microseconds given) {
    command.given = given;
    return command;
  };
  const auto mdi = [&] {
    shop.push("MDI", "G21 G91 G1 X5 F600\n");
    dds::Command command = shop.start_command("MDI");
    command.argument = dds::kMdiStart;
    return command;
  };
  const auto command = shop.begin("X 50 mm F1200");
  shop.pass(300ms);
  const auto before = now();
  shop.pass(200ms);
  dds::Command hold = shop.command(CommandAction::Hold);
  hold.run.clear();
  ASSERT_TRUE(shop.send(at(hold, now())).accepted);
  EXPECT_THAT(shop.end_of(command), HasSubstr("stopped by command"));
  const double rests = shop.at(0);
  EXPECT_THAT(shop.answer_to(at(shop.jog_command("X 5 mm F600"), before)),
              HasSubstr("a later command has stopped the machine"));
  EXPECT_THAT(shop.answer_to(at(mdi(), before)),
              HasSubstr("a later command has stopped the machine"));
  shop.pass(200ms);
  EXPECT_THAT(shop.answer_to(at(shop.jog_command("X 5 mm F600"), now())),
              HasSubstr("look at the machine, then repeat it"));
  EXPECT_THAT(shop.answer_to(at(mdi(), now())), HasSubstr("look at the machine, then repeat it"));
  EXPECT_EQ(shop.at(0), rests);
  shop.pass(1s);
  EXPECT_THAT(shop.answer_to(at(shop.jog_command("X 5 mm F600"), now())), StartsWith("X "));
}

}  // namespace
}  // namespace dripline::gateway
