#include "gateway/machine/streamed/machine_check.hpp"

#include <gtest/gtest.h>

namespace dripline::machine::streamed {
namespace {

using interpreter::MachineData;

TextRules found() {
  TextRules rules;
  rules.axes[0] = TextRules::AxisRules{};
  rules.axes[0]->travel = TextRules::Range{-400, 400};
  rules.axes[0]->max_rate = 12'000;
  rules.max_rpm = 6'000;
  return rules;
}

MachineData same() {
  MachineData stated;
  stated.axes[0] = {.min = -400, .max = 400, .max_rate = 12'000};
  stated.max_rpm = 6'000;
  stated.homing = true;
  return stated;
}

TEST(MachineCheck, TakesWhatAgreesAndWhatIsNotStated) {
  EXPECT_TRUE(check_machine(same(), found()));
  EXPECT_TRUE(check_machine({}, found()));
}

TEST(MachineCheck, NamesTheSettingThatDiffers) {
  TextRules rules = found();
  rules.homes = false;
  rules.homing_setting = " ($22)";
  EXPECT_EQ(check_machine(same(), rules).error().what,
            "homing is on in the setup and off on the machine ($22)");
  rules = found();
  rules.axes[0]->rate_setting = " ($110)";
  rules.axes[0]->max_rate = 500;
  EXPECT_EQ(check_machine(same(), rules).error().what,
            "the rate of X is 12000 in the setup and 500 on the machine ($110)");
}

struct DifferenceCase {
  const char* name;
  const char* text;
  void (*change)(MachineData&);
};

class MachineDifference : public testing::TestWithParam<DifferenceCase> {};

TEST_P(MachineDifference, IsNamedWithBothValues) {
  MachineData stated = same();
  GetParam().change(stated);
  const auto checked = check_machine(stated, found());
  ASSERT_FALSE(checked);
  EXPECT_EQ(checked.error().code, Errc::Conflict);
  EXPECT_EQ(checked.error().what, GetParam().text);
}

INSTANTIATE_TEST_SUITE_P(
    , MachineDifference,
    testing::Values(
        DifferenceCase{"travel",
                       "the travel of X is -300 to 400 in the setup and -400 to 400 on the machine",
                       [](MachineData& it) { it.axes[0]->min = -300; }},
        DifferenceCase{"rate", "the rate of X is 9000 in the setup and 12000 on the machine",
                       [](MachineData& it) { it.axes[0]->max_rate = 9'000; }},
        DifferenceCase{"axis", "the setup has an axis C, the machine has not",
                       [](MachineData& it) { it.axes[5] = MachineData::AxisData{}; }},
        DifferenceCase{"spindle", "max_rpm is 8000 in the setup and 6000 on the machine",
                       [](MachineData& it) { it.max_rpm = 8'000; }},
        DifferenceCase{"homing", "homing is off in the setup, the machine must be homed",
                       [](MachineData& it) { it.homing = false; }}),
    [](const auto& i) { return std::string{i.param.name}; });

}  // namespace
}  // namespace dripline::machine::streamed
