#include "tests/unit/gateway/machine/grbl/grbl_shop.hpp"

/// The board beside what the setup states of the machine.
namespace dripline::machine::grbl::test {
namespace {

using interpreter::MachineData;

MachineData stated(std::string_view toml) {
  const auto machine = interpreter::parse_machine_data(toml);
  EXPECT_TRUE(machine) << machine.error().what;
  return *machine;
}

/// Why a program does not begin; empty: it does.
std::string refusal(std::string_view toml, std::map<int, std::string> settings = {}) {
  GrblShop shop({.settings = std::move(settings)}, {}, stated(toml));
  const auto begins = shop.machine.check_begin({});
  return begins ? "" : begins.error().what;
}

TEST(GrblMachineCheck, TakesABoardThatIsTheMachineOfTheSetup) {
  GrblShop shop({.is_locked = true, .settings = {{20, "1"}, {22, "1"}}}, {},
                stated("[machine]\nX = { min = -300.0, max = 0.0, rate = 12000.0 }\n"
                       "max_rpm = 10000\nhoming = true"));
  ASSERT_TRUE(shop.machine.home());
  shop.pass(9);
  const auto begins = shop.machine.check_begin({});
  EXPECT_TRUE(begins) << begins.error().what;
}

TEST(GrblMachineCheck, NamesWhatDiffers) {
  EXPECT_EQ(refusal("[machine]\nZ = { rate = 500.0 }"),
            "the rate of Z is 500 in the setup and 12000 on the machine ($112)");
  EXPECT_EQ(refusal("[machine]\nX = { min = -300.0, max = 0.0 }"),
            "the setup has a travel of X, the machine has none ($20, $23, $130)");
  EXPECT_EQ(
      refusal("[machine]\nY = { min = -200.0, max = 0.0 }", {{20, "1"}}),
      "the travel of Y is -200 to 0 in the setup and -300 to 0 on the machine ($20, $23, $131)");
  EXPECT_EQ(refusal("[machine]\nA = { rate = 500.0 }"),
            "the setup has an axis A, the machine has not");
  EXPECT_EQ(refusal("[machine]\nmax_rpm = 24000"),
            "max_rpm is 24000 in the setup and 10000 on the machine ($30)");
  EXPECT_EQ(refusal("[machine]\nhoming = true"),
            "homing is on in the setup and off on the machine ($22)");
}

TEST(GrblMachineCheck, TakesNoSettingThatTheBoardHasNotStated) {
  EXPECT_EQ(refusal("", {{13, "none"}}), "the board does not state its setting $13");
  EXPECT_EQ(refusal("", {{131, "none"}}), "the board does not state its setting $131");
}

TEST(GrblMachineCheck, UnderstandsABoardThatReportsInInches) {
  GrblShop shop({.settings = {{13, "1"}}});
  shop.begin();
  shop.program.line(25.4, 0, 3000);
  shop.program.line(30, -5, 3000);
  shop.program.end();
  ASSERT_TRUE(shop.pass_until_over());
  EXPECT_EQ(shop.alarm(), "");
  EXPECT_NEAR(shop.x(), 30, 2e-3);
  EXPECT_NEAR(shop.board.position()[0], 30, 1e-6);
}

TEST(GrblMachineCheck, RefusesASpindleSpeedThatTheBoardWouldRaise) {
  GrblShop shop({.settings = {{31, "500"}}});
  shop.begin();
  shop.program.spindle(200);
  ASSERT_TRUE(shop.pass_until_over());
  EXPECT_EQ(shop.alarm(), "MCH0010 spindle speed 200 is below the machine's 500 rpm ($31)");
}

}  // namespace
}  // namespace dripline::machine::grbl::test
