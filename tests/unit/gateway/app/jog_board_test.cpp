// Jogs of a board of the Grbl class.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "gateway/machine/grbl/grbl_machine.hpp"
#include "tests/support/grbl/board.hpp"
#include "tests/unit/gateway/app/jog_fixture.hpp"

namespace dripline::gateway {
namespace {

using interpreter::Dialect;
using machine::grbl::GrblMachine;
using test_support::GrblBoard;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;
using namespace std::chrono_literals;

class JoggedBoard : public testing::Test {
 protected:
  void start(const Dialect& control, const std::string& toml = "",
             GrblBoard::Options options = {}) {
    board.emplace(std::move(options));
    shop = std::make_unique<JogShop>(control, toml);
    shop->motion = [this](machine::ExecutionSink& sink) {
      auto made = std::make_unique<GrblMachine>(GrblMachine::Settings{
          .sink = sink, .clock = std::shared_ptr<const Clock>(&shop->clock, [](const auto*) {})});
      machine = made.get();
      machine->line_opened();
      return made;
    };
    shop->each_turn = [this] {
      for (int i = 0; i < 10; ++i) {
        board->pass(0.001);
        const std::string in = is_cut ? std::string() : board->take_output();
        const auto out = machine->exchange(std::as_bytes(std::span(in)));
        if (!is_cut) board->receive(out.real_time + out.lines);
      }
    };
    shop->restart_gateway();
    ASSERT_TRUE(shop->run_until([&] { return shop->status && machine->notice().empty(); }));
  }
  std::optional<GrblBoard> board;
  std::unique_ptr<JogShop> shop;
  GrblMachine* machine = nullptr;
  bool is_cut = false;
};

TEST_F(JoggedBoard, AProgramAndMdiAfterItBeginWhereTheBoardIs) {
  start(interpreter::kRs274NgcDialect, "[[tool]]\nnumber = 1\nlength = 50.0\n");
  ASSERT_EQ(shop->run("G21 G90 F600\nG43 H1\nG0 X3 Z-20\nM2\n"), "completed");
  ASSERT_NEAR(board->position()[2], 30, 1e-3);
  EXPECT_EQ(shop->jog("Z 2 mm F600"), "Z -18 mm") << "as the machine shows it";
  EXPECT_NEAR(board->position()[2], 32, 1e-3);
  ASSERT_EQ(shop->mdi("G21 G91 G1 Z1 F600\n"), "completed");
  EXPECT_NEAR(board->position()[2], 33, 1e-3);
  EXPECT_EQ(shop->jog("X -1.25 mm F600"), "X 1.75 mm");
  ASSERT_EQ(shop->run("G21 G91 G1 X1 F600\nM2\n"), "completed");
  EXPECT_NEAR(board->position()[0], 2.75, 1e-3);
  EXPECT_EQ(board->jogs.size(), 2U);
}

TEST_F(JoggedBoard, WhoseAxisIsSlowerThanTheFeedIsWaitedFor) {
  start(interpreter::kFanucDialect, "", {.max_rate = 60});
  EXPECT_EQ(shop->end_of(shop->begin("X 5 mm F6000")), "X 5 mm");
  EXPECT_THAT(shop->end_of(shop->begin("X 50 mm F6000")),
              HasSubstr("stopped because its time was over"));
  EXPECT_LT(board->position()[0], 20);
}

TEST_F(JoggedBoard, ARefusalOfTheBoardIsTheAnswer) {
  start(interpreter::kFanucDialect);
  board->refuses_line = 1;
  EXPECT_THAT(shop->jog("X 1 mm F600"), StartsWith("refused: the board refuses it: error 20"));
  EXPECT_EQ(board->traveled(), 0);
  EXPECT_EQ(shop->jog("X 1 mm F600"), "X 1 mm");
}

TEST_F(JoggedBoard, ItsRunIsLeftToCycleStartAfterADoorWasOpened) {
  start(interpreter::kFanucDialect);
  shop->push("O1", "G21 G90 G1 X200. F600\nM30\n");
  ASSERT_TRUE(shop->start("O1").accepted);
  ASSERT_TRUE(shop->run_until([&] { return board->position()[0] > 1; }));
  board->open_door();
  shop->pass(1s);
  board->close_door();
  shop->pass(1s);
  const double rests = board->position()[0];
  const auto refused = shop->send(shop->command(dds::CommandAction::Resume));
  EXPECT_FALSE(refused.accepted);
  EXPECT_THAT(refused.reason, HasSubstr("cycle start at the machine's panel"));
  shop->pass(3s);
  EXPECT_EQ(board->position()[0], rests);
  EXPECT_EQ(shop->status->waits_for, dds::WaitsFor::CycleStart);
  EXPECT_THAT(shop->panel("cycle-start"), StartsWith("ok"));
  EXPECT_TRUE(shop->run_until([&] { return board->position()[0] > rests + 1; }));
}

TEST_F(JoggedBoard, AHeldJogReachesItsDistance) {
  start(interpreter::kFanucDialect);
  const auto command = shop->begin("X 12 mm F600 hold=a1");
  EXPECT_TRUE(shop->run_until([&] {
    (void)shop->jog("keep=a1");
    return shop->results.count(command.id) > 0;
  }));
  EXPECT_EQ(shop->end_of(command), "X 12 mm");
  EXPECT_NEAR(board->position()[0], 12, 1e-3);
  EXPECT_EQ(board->jogs.size(), 4U) << "in pieces of 3 mm";
}

TEST_F(JoggedBoard, AHeldJogStopsWhenItIsNotKept) {
  start(interpreter::kFanucDialect);
  const auto command = shop->begin("X 60 mm F600 hold=a1");
  for (int i = 0; i < 10; ++i) {
    shop->pass(100ms);
    EXPECT_EQ(shop->jog("keep=a1"), "");
  }
  const double at = board->position()[0];
  EXPECT_GT(at, 4);
  EXPECT_THAT(shop->end_of(command), HasSubstr("stopped since it was no longer held"));
  EXPECT_LT(board->position()[0] - at, 5);
}

/// However long it would be kept: the board has a piece, and nothing more comes.
TEST_F(JoggedBoard, AHeldJogWhoseLineIsLostStops) {
  start(interpreter::kFanucDialect);
  const auto command = shop->begin("X 60 mm F600 hold=a1");
  shop->pass(200ms);
  ASSERT_EQ(shop->jog("keep=a1"), "");
  is_cut = true;
  machine->line_lost("the line is closed");
  EXPECT_THAT(shop->end_of(command), StartsWith("refused: "));
  shop->pass(5s);
  EXPECT_LE(board->position()[0], 3.001);
}

TEST_F(JoggedBoard, AStepWhoseLineIsLostEndsByItselfAndIsNotRepeated) {
  start(interpreter::kFanucDialect);
  const auto command = shop->begin("X 5 mm F600");
  shop->pass(200ms);
  is_cut = true;
  machine->line_lost("the line is closed");
  EXPECT_THAT(shop->end_of(command), AllOf(StartsWith("refused: "), HasSubstr("last position")));
  shop->pass(3s);
  EXPECT_NEAR(board->position()[0], 5, 1e-6);
  is_cut = false;
  machine->line_opened();
  shop->pass(3s);
  EXPECT_NEAR(board->position()[0], 5, 1e-6);
  EXPECT_NEAR(shop->at(0), 5, 1e-6);
  EXPECT_EQ(board->jogs.size(), 1U);
}

TEST_F(JoggedBoard, AGatewayThatIsKilledMeanwhileFindsTheBoardAtRest) {
  start(interpreter::kFanucDialect);
  const auto command = shop->begin("X 2 mm F600");
  shop->pass(100ms);
  shop->restart_gateway();
  shop->gateway->receive(command, shop->clock.steady);
  shop->pass(5s);
  const double at = board->position()[0];
  EXPECT_LE(at, 2 + 1e-6);
  EXPECT_NEAR(shop->at(0), at, 1e-6);
  EXPECT_EQ(board->jogs.size(), 1U);
}

// The board rests in the middle of a block that a later jog completes along its path.
TEST_F(JoggedBoard, AJogAfterAnAlarmExecutesNoBlock) {
  start(interpreter::kRs274NgcDialect);
  shop->push("P", "G21 G90 F1200 G0 Y1\nG1 Z-1\nX10\nX20\nX30\nX40\nX50\nM2\n");
  const auto first = shop->start_command("P");
  ASSERT_TRUE(shop->send(first).accepted);
  ASSERT_TRUE(shop->run_until([&] { return board->position()[0] > 12; }));
  board->refuses_line = 1;
  ASSERT_TRUE(shop->run_until([&] { return shop->gateway->status().run.empty(); }));
  ASSERT_THAT(dds::decode_run_end(shop->records.back().text)->reason, StartsWith("GRB0002"));
  for (const double is_pressed : {1.0, 0.0}) {
    dds::Command command = shop->command(dds::CommandAction::Switch);
    command.run.clear();
    command.argument = "emergency_stop";
    command.value = is_pressed;
    ASSERT_TRUE(shop->send(command).accepted);
  }
  ASSERT_TRUE(shop->run_until([&] { return machine->notice().empty(); }));
  const double rested = board->position()[0];
  ASSERT_LT(rested, 40);
  ASSERT_TRUE(shop->jog("X 10 mm F1200").starts_with("X ")) << shop->refusal();
  ASSERT_NEAR(board->position()[0], rested + 10, 1e-3);

  dds::Command again = shop->start_command("P");
  again.argument = "restart=" + first.run + " at=executed";
  ASSERT_TRUE(shop->send(again).accepted) << shop->results.at(again.id).reason;
  const auto report = [&] {
    return std::ranges::find_if(shop->records, [&](const dds::Record& record) {
      return record.run == again.run && record.device == "restart";
    });
  };
  ASSERT_TRUE(shop->run_until([&] { return report() != shop->records.end(); }));
  // The first two lead to the cut, each other is 10 mm.
  const auto executed = 2 + static_cast<int>(rested / 10);
  EXPECT_EQ(nlohmann::json::parse(report()->text)["after"]["block"], executed) << report()->text;
}

TEST_F(JoggedBoard, NotHomedIsNotJogged) {
  board.emplace(GrblBoard::Options{.is_locked = true});
  shop = std::make_unique<JogShop>(interpreter::kFanucDialect);
  shop->motion = [this](machine::ExecutionSink& sink) {
    auto made = std::make_unique<GrblMachine>(GrblMachine::Settings{
        .sink = sink, .clock = std::shared_ptr<const Clock>(&shop->clock, [](const auto*) {})});
    machine = made.get();
    machine->line_opened();
    return made;
  };
  shop->restart_gateway();
  EXPECT_THAT(shop->jog("X 1 mm"), StartsWith("refused: "));
  EXPECT_EQ(board->jogs.size(), 0U);
}

}  // namespace
}  // namespace dripline::gateway
