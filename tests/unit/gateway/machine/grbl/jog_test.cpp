#include "tests/unit/gateway/machine/grbl/grbl_shop.hpp"

namespace dripline::machine::grbl::test {
namespace {

class GrblJog : public testing::Test {
 protected:
  static Jog of_x(double distance, double feed = 600) {
    return {.axis = Axis::X, .distance = distance, .feed_per_minute = feed};
  }
  static bool ends(GrblShop& shop, double seconds = 30) {
    return shop.pass_until([&] { return !shop.machine.is_jogging(); }, seconds);
  }
  GrblShop shop;
};

TEST_F(GrblJog, IsOneLineOfTheBoardAndEndsWhereTheBoardReportsRest) {
  shop.machine.set_panel({.feed_override = 2});
  ASSERT_TRUE(shop.machine.jog(of_x(-2.5)));
  EXPECT_TRUE(shop.machine.is_jogging());
  EXPECT_EQ(shop.machine.jog(of_x(1)).error().code, Errc::Busy);
  ASSERT_TRUE(shop.pass_until([&] { return shop.board.is_moving(); }, 1));
  shop.pass(0.2);
  EXPECT_FALSE(shop.machine.check_begin(shop.machine.status().position)) << "no program begins";
  ASSERT_TRUE(ends(shop));
  EXPECT_EQ(shop.board.jogs, std::vector<std::string>{"$J=G21G91X-2.5F600"});
  EXPECT_EQ(shop.machine.jog_fault(), "");
  EXPECT_NEAR(shop.x(), -2.5, 1e-9);
  EXPECT_FALSE(shop.board.is_moving());
  EXPECT_TRUE(shop.recorder.lines.empty());
}

TEST_F(GrblJog, ABeginningProgramIsWhereTheJogHasEnded) {
  shop.begin();
  shop.program.line(10, 0, 1200);
  shop.program.end();
  ASSERT_TRUE(shop.pass_until_over());
  ASSERT_TRUE(shop.machine.jog(of_x(1.25)));
  ASSERT_TRUE(ends(shop));
  ASSERT_TRUE(shop.machine.check_begin(Program::at(11.25, 0)));
  shop.begin(11.25);
  shop.program.line(12, 0, 1200);
  shop.program.end();
  ASSERT_TRUE(shop.pass_until_over());
  EXPECT_EQ(shop.machine.state(), MachineState::Completed) << shop.alarm();
  EXPECT_NEAR(shop.board.position()[0], 12, 1e-3);
}

TEST_F(GrblJog, EachStopCancelsIt) {
  const std::vector<std::function<void(GrblMachine&)>> stops{
      [](GrblMachine& machine) { machine.stop_jog(); },
      [](GrblMachine& machine) { machine.hold(); }, [](GrblMachine& machine) { machine.abort(); },
      [](GrblMachine& machine) { machine.set_panel({.feed_override = 0}); },
      [](GrblMachine& machine) { machine.set_panel({.emergency_stop = true}); }};
  for (std::size_t i = 0; i < stops.size(); ++i) {
    for (const bool is_hal : {false, true}) {
      GrblShop other({.is_grbl_hal = is_hal});
      ASSERT_TRUE(other.machine.jog(of_x(50)));
      ASSERT_TRUE(other.pass_until([&] { return other.board.traveled() > 2; }, 5));
      stops[i](other.machine);
      ASSERT_TRUE(ends(other, 2)) << i;
      const double rested = other.board.traveled();
      EXPECT_LT(rested, 4) << i;
      other.pass(3);
      EXPECT_EQ(other.board.traveled(), rested) << i;
      EXPECT_NEAR(other.x(), other.board.position()[0], 1e-3) << "it knows where it is";
      EXPECT_TRUE(other.machine.check_begin(other.machine.status().position)) << i;
      EXPECT_EQ(other.machine.jog(of_x(1)).has_value(), i < 3) << i;
    }
  }
}

/// A real-time byte overtakes the line; some boards drop the line then, and answer nothing.
TEST_F(GrblJog, ACancelAtOnceIsNotLost) {
  for (const bool is_hal : {false, true}) {
    GrblShop other({.is_grbl_hal = is_hal});
    ASSERT_TRUE(other.machine.jog(of_x(50)));
    other.machine.stop_jog();
    ASSERT_TRUE(ends(other, 3));
    EXPECT_LT(other.board.traveled(), 1.5);
    const double rested = other.board.traveled();
    other.pass(5);
    EXPECT_EQ(other.board.traveled(), rested);
    EXPECT_TRUE(other.machine.check_begin(other.machine.status().position)) << other.alarm();
    EXPECT_TRUE(other.machine.jog(of_x(1)));
  }
}

TEST_F(GrblJog, ABoardThatIgnoresTheCancelIsHeldAndReset) {
  shop.board.ignores_jog_cancel = true;
  ASSERT_TRUE(shop.machine.jog(of_x(200)));
  ASSERT_TRUE(shop.pass_until([&] { return shop.board.traveled() > 1; }, 5));
  shop.machine.stop_jog();
  ASSERT_TRUE(ends(shop, 6));
  const double rested = shop.board.traveled();
  EXPECT_LT(rested, 40);
  shop.pass(3);
  EXPECT_EQ(shop.board.traveled(), rested);
  EXPECT_TRUE(shop.machine.check_begin(shop.machine.status().position));
}

TEST_F(GrblJog, TheBoardsRefusalAndItsAlarmAreItsFault) {
  shop.board.refuses_line = 1;
  ASSERT_TRUE(shop.machine.jog(of_x(1)));
  ASSERT_TRUE(ends(shop));
  EXPECT_EQ(shop.machine.jog_fault().substr(0, 33), "the board refuses it: error 20, t")
      << shop.machine.jog_fault();
  EXPECT_EQ(shop.board.traveled(), 0);
  ASSERT_TRUE(shop.machine.jog(of_x(20)));
  ASSERT_TRUE(shop.pass_until([&] { return shop.board.traveled() > 1; }, 5));
  shop.board.raise_alarm(1);
  ASSERT_TRUE(ends(shop));
  EXPECT_NE(shop.machine.jog_fault().find("in alarm 1"), std::string::npos)
      << shop.machine.jog_fault();
  EXPECT_FALSE(shop.machine.jog(of_x(1)));
}

/// The board ends the step by itself; the gateway finds it at rest, or stops it.
TEST_F(GrblJog, ALostLineEndsItHereAndMovesNothingAgain) {
  ASSERT_TRUE(shop.machine.jog(of_x(5)));
  ASSERT_TRUE(shop.pass_until([&] { return shop.board.traveled() > 1; }, 5));
  shop.is_cut = true;
  shop.machine.line_lost("the line is closed");
  EXPECT_FALSE(shop.machine.is_jogging());
  EXPECT_NE(shop.machine.jog_fault(), "");
  EXPECT_FALSE(shop.machine.jog(of_x(5)));
  shop.pass(2);
  EXPECT_NEAR(shop.board.position()[0], 5, 1e-6);
  shop.is_cut = false;
  shop.machine.line_opened();
  shop.pass(3);
  EXPECT_NEAR(shop.board.position()[0], 5, 1e-6);
  EXPECT_NEAR(shop.x(), 5, 1e-6);
  EXPECT_EQ(shop.board.jogs.size(), 1U);
}

TEST_F(GrblJog, ALineThatWasLostInTransitIsFoundOut) {
  shop.board.swallows_lines = true;
  ASSERT_TRUE(shop.machine.jog(of_x(5)));
  ASSERT_TRUE(ends(shop, 20));
  EXPECT_NE(shop.machine.jog_fault().find("has not answered a line"), std::string::npos)
      << shop.machine.jog_fault();
  EXPECT_EQ(shop.board.traveled(), 0);
}

TEST_F(GrblJog, IsRefusedWhereTheBoardIsNotReady) {
  GrblShop locked({.is_locked = true});
  EXPECT_FALSE(locked.machine.jog(of_x(1))) << "not homed";
  EXPECT_FALSE(shop.machine.jog({.axis = Axis::A, .distance = 1, .feed_per_minute = 100}));
  EXPECT_FALSE(shop.machine.jog(of_x(1e-5))) << "less than a step";
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(shop.machine.jog(of_x(nan)));
  EXPECT_FALSE(shop.machine.jog(of_x(1, nan)));
  EXPECT_FALSE(shop.machine.jog(of_x(1, 0)));
  shop.board.open_door();
  shop.pass(1);
  EXPECT_FALSE(shop.machine.jog(of_x(1)));
  shop.board.close_door();
  shop.pass(1);
  shop.is_cut = true;
  shop.machine.line_lost("gone");
  EXPECT_FALSE(shop.machine.jog(of_x(1)));
  GrblShop running;
  running.begin();
  running.program.line(10, 0, 1200);
  ASSERT_TRUE(running.pass_until([&] { return running.x() > 1; }));
  EXPECT_FALSE(running.machine.jog(of_x(1)));
  EXPECT_EQ(shop.board.jogs.size() + running.board.jogs.size(), 0U);
}

TEST_F(GrblJog, EndsWithinTheTravelOfTheBoard) {
  GrblShop limited({.settings = {{20, "1"}, {130, "8"}}});
  const auto beyond = limited.machine.jog(of_x(-8.1));
  ASSERT_FALSE(beyond);
  EXPECT_NE(beyond.error().what.find("outside the machine's travel of -8 to 0"), std::string::npos)
      << beyond.error().what;
  EXPECT_TRUE(limited.machine.jog(of_x(-8)));
  EXPECT_TRUE(ends(limited));
  EXPECT_NEAR(limited.x(), -8, 1e-6);
}

}  // namespace
}  // namespace dripline::machine::grbl::test
