// Axes of a real machine, a board of the Grbl class, with lengths of tools: they are at the
// program's position + length, and everything that the gateway shows and keeps agrees with it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gateway/machine/grbl/grbl_machine.hpp"
#include "tests/support/grbl/board.hpp"
#include "tests/unit/gateway/app/position_fixture.hpp"

namespace dripline::gateway {
namespace {

using interpreter::Dialect;
using machine::grbl::GrblMachine;
using test_support::GrblBoard;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr const char* kTools =
    "[[tool]]\nnumber = 1\nlength = 50.0\n[[tool]]\nnumber = 2\nlength = 80.0\n";

class Axes : public testing::Test {
 protected:
  void start(const Dialect& control, const std::string& toml = kTools,
             GrblBoard::Options options = {}) {
    board.emplace(std::move(options));
    shop = std::make_unique<Shop>(control, toml, "1x");
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
        const std::string in = board->take_output();
        const auto out = machine->exchange(std::as_bytes(std::span(in)));
        board->receive(out.real_time + out.lines);
      }
    };
    shop->restart_gateway();
    ASSERT_TRUE(shop->run_until([&] { return shop->status && machine->notice().empty(); }));
  }
  /// Of the axes' moves so far.
  std::vector<std::string> moves() const {
    std::vector<std::string> moves;
    for (const std::string& line : board->lines)
      if (line.starts_with("G0") || line.starts_with("G1") || line.starts_with("G38"))
        moves.push_back(line);
    return moves;
  }
  double z() const { return board->position()[2]; }
  double shown_z() {
    (void)shop->run_until([&] { return false; }, std::chrono::milliseconds(5000));
    return shop->at(2);
  }

  std::optional<GrblBoard> board;
  std::unique_ptr<Shop> shop;
  GrblMachine* machine = nullptr;
};

TEST_F(Axes, AreAtPositionAndLengthWhileThePositionIsTheProgram) {
  start(interpreter::kRs274NgcDialect);
  EXPECT_EQ(shop->run("G21 G90 F600\nG43 H1\nG0 X3 Z-20\nM2\n"), "completed");
  EXPECT_NEAR(z(), 30, 1e-3);
  EXPECT_NEAR(shown_z(), -20, 1e-3);
  EXPECT_NEAR(shop->at(0), 3, 1e-3);
}

TEST_F(Axes, StayWhenALengthAloneComesIntoForceOrEnds) {
  start(interpreter::kRs274NgcDialect);
  ASSERT_EQ(shop->run("G21 G90 F600\nG0 Z40\nG43 H1\nM2\n"), "completed");
  EXPECT_NEAR(z(), 40, 1e-3);
  EXPECT_NEAR(shown_z(), -10, 1e-3) << "as the control shows it at once";
  ASSERT_EQ(shop->mdi("G49\n"), "completed");
  EXPECT_NEAR(z(), 40, 1e-3);
  EXPECT_NEAR(shown_z(), 40, 1e-3);
}

TEST_F(Axes, GoOnFromWhereTheyAreWhenMdiContinuesWithTheLength) {
  start(interpreter::kRs274NgcDialect);
  ASSERT_EQ(shop->run("G21 G90 F600\nG43 H1\nG0 Z-20\nM2\n"), "completed");
  ASSERT_EQ(shop->mdi("G91 G0 Z-1\n"), "completed");
  EXPECT_NEAR(z(), 29, 1e-3);
  ASSERT_EQ(shop->mdi("G90 G43 H2 G0 Z5\n"), "completed");
  EXPECT_NEAR(z(), 85, 1e-3);
}

// A program begins with no length: its first positions are those of the axes.
TEST_F(Axes, BeginAProgramWithoutTheToolOfTheLast) {
  start(interpreter::kRs274NgcDialect);
  ASSERT_EQ(shop->run("G21 G90 F600\nG43 H1\nG0 Z-20\nM2\n"), "completed");
  ASSERT_EQ(shop->run("G21 G91\nG0 Z1\nM2\n"), "completed");
  EXPECT_NEAR(z(), 31, 1e-3);
  EXPECT_NEAR(shown_z(), 31, 1e-3);
}

// Tip positions are inside the travel.
TEST_F(Axes, AreInsideTheirTravelWithTheLength) {
  GrblBoard::Options options;
  options.settings = {{20, "1"}, {132, "100"}, {22, "1"}};
  options.start = {0, 0, -1, 0};
  start(interpreter::kRs274NgcDialect, kTools, options);
  EXPECT_THAT(
      shop->run("G21 G90 F600\nG0 Z-70\nG43 H1\nG0 Z-49\nM2\n"),
      AllOf(StartsWith("MCH0001"), HasSubstr("Z 1 mm"), HasSubstr("before the first move")));
  EXPECT_TRUE(moves().empty());
}

// The contact is where the tip is: #5063 and the record.
TEST_F(Axes, GiveTheContactOfAProbeAsThePositionOfTheTip) {
  GrblBoard::Options options;
  options.surface_z = 37.5;
  options.start = {0, 0, 90, 0};
  start(interpreter::kRs274NgcDialect, kTools, options);
  ASSERT_EQ(shop->run("G21 G90 F600\nG43 H1\nG0 Z20\nG38.2 Z-30 F300\n#1=#5063\nG0 Z[#1+7]\nM2\n"),
            "completed");
  EXPECT_NEAR(z(), 44.5, 1e-3) << "7 above the contact, whatever the length is";
  const auto probed = std::ranges::find(shop->records, dds::RecordKind::Probe, &dds::Record::kind);
  ASSERT_NE(probed, shop->records.end());
  EXPECT_THAT(probed->text, HasSubstr("-12.5"));
}

// The lengths of a Fanuc control: an axis takes them in with its own next move.
TEST_F(Axes, OfAFanucTakeALengthInWhenTheirOwnMoveComes) {
  start(interpreter::kFanucDialect);
  EXPECT_EQ(shop->run("O1\nG21 G90 F600\nG0 X3. Z9.\nG43 H1 Z-20.\nG91 G28 Z0\nM30\n"),
            "completed");
  EXPECT_NEAR(z(), 0, 1e-3) << "the reference point is one of the axes";
  EXPECT_NEAR(shown_z(), 0, 1e-3);
  EXPECT_THAT(shop->run("O1\nG21 G90 F600\nG43 H1\nG0 X8.\nM30\n"),
              AllOf(StartsWith("MCH0008"), HasSubstr("Z is 50.000 mm and was 0.000 mm"),
                    HasSubstr("(line 4, found before the first move)")));
  EXPECT_NEAR(board->position()[0], 3, 1e-3);
}

TEST_F(Axes, OfAFanucKeepTheLengthThatMdiContinuesWith) {
  start(interpreter::kFanucDialect);
  ASSERT_EQ(shop->run("O1\nG21 G90 F600\nG43 H1 G0 Z-20.\nM30\n"), "completed");
  ASSERT_EQ(shop->mdi("G0 X7.\n"), "completed");
  EXPECT_NEAR(z(), 30, 1e-3);
  // The MDI that brings a length, and the next that does not move its axis.
  ASSERT_EQ(shop->mdi("G43 H2\n"), "completed");
  EXPECT_THAT(shop->mdi("G0 X8.\n"), AllOf(StartsWith("MCH0008"), HasSubstr("Z is 80.000 mm")));
  EXPECT_NEAR(z(), 30, 1e-3);
}

TEST_F(Axes, AreWhereAToolTouchesOff) {
  start(interpreter::kFanucDialect);
  ASSERT_EQ(shop->mdi("G21 G90 G43 H1 G0 Z-20.\n"), "completed");
  EXPECT_THAT(shop->set("tool 2 Z -5 mm G54"), StartsWith("tool.2.length is 35.000 mm"))
      << "the axis is at 30";
  ASSERT_EQ(shop->run("O1\nG21 G90\nG43 H2 G0 Z1.\nM30\n"), "completed");
  EXPECT_NEAR(z(), 36, 1e-3);
  EXPECT_THAT(shop->set("datum G54 Z 0 mm"), StartsWith("G54.Z is 1.000")) << "of the tip";
  ASSERT_EQ(shop->run("O1\nG21 G90\nG43 H2 G0 Z2.\nM30\n"), "completed");
  EXPECT_NEAR(z(), 38, 1e-3);
}

// What a restart shows and does is by the tip; the axes go with the length.
TEST_F(Axes, AreBroughtBackWithTheLengthByARestart) {
  start(interpreter::kRs274NgcDialect);
  shop->set_checkpoint_interval(std::chrono::milliseconds(50));
  shop->push("P", "G21 G90 F1200\nG43 H1\nG0 Z-20\nG1 X30\nY20\nX60\nG49\nG0 Z70\nM2\n");
  const auto first = shop->start_command("P");
  ASSERT_TRUE(shop->send(first).accepted);
  ASSERT_TRUE(shop->run_until([&] { return board->position()[1] > 10; }));
  dds::Command abort = shop->command(dds::CommandAction::Abort);
  abort.run = first.run;
  ASSERT_TRUE(shop->send(abort).accepted);
  ASSERT_TRUE(shop->run_until([&] { return shop->gateway->status().run.empty(); }));
  EXPECT_NEAR(z(), 30, 1e-3);
  board->done.clear();
  dds::Command again = shop->start_command("P");
  again.argument = "restart=" + first.run + " at=executed";
  ASSERT_TRUE(shop->send(again).accepted) << shop->results.at(again.id).reason;
  const std::size_t before = shop->count(dds::RecordKind::RunEnded);
  ASSERT_TRUE(shop->run_until([&] {
    dds::Command resume = shop->command(dds::CommandAction::Resume);
    resume.run = again.run;
    (void)shop->send(resume);
    return shop->count(dds::RecordKind::RunEnded) > before;
  }));
  EXPECT_EQ(dds::decode_run_end(shop->records.back().text)->outcome, dds::RunOutcome::Completed)
      << shop->records.back().text;
  ASSERT_FALSE(board->done.empty());
  for (const auto& done : board->done)
    EXPECT_GE(done.at[2], 30 - 1e-3) << "no axis is lower than the program's tip + 50";
  EXPECT_NEAR(z(), 70, 1e-3);
  EXPECT_NEAR(board->position()[0], 60, 1e-3);
}

TEST_F(Axes, AreLeftByAnAbortWithTheirLength) {
  start(interpreter::kRs274NgcDialect);
  ASSERT_THAT(shop->abort_when("G21 G90 F600 G43 H1\nG1 X50 Z100\n",
                               [&] { return board->position()[0] > 20; }),
              StartsWith("aborted"));
  const double rests = z();
  EXPECT_GT(rests, 20);
  EXPECT_NEAR(shown_z(), rests - 50, 1e-3);
  EXPECT_THAT(shop->set("tool 2 Z 0 mm G54"), StartsWith(fmt::format("tool.2.Z is {:.3f}", rests)))
      << "from the axes";
}

}  // namespace
}  // namespace dripline::gateway
