#include "gateway/machine/linuxcnc/command_writer.hpp"

#include <gmock/gmock.h>
#include <cmath>

namespace dripline::machine::linuxcnc {
namespace {

using interpreter::SpindleState;
using testing::ElementsAre;
using testing::IsEmpty;

TEST(LinuxCncCommands, ATurningSpindleIsTurnedOnAgainAfterAToolChange) {
  LinuxCncCommands writer;
  streamed::CommandWriter::Lines lines;
  EXPECT_FALSE(writer.spindle({{}, SpindleState::Counterclockwise, 1200, {}, {}}, lines));
  EXPECT_THAT(lines, ElementsAre("M4S1200"));
  lines.clear();
  EXPECT_FALSE(writer.tool({.origin = {}, .number = 3, .offset = {}}, lines));
  EXPECT_THAT(lines, ElementsAre("T3", "M6", "M4S1200"));
  lines.clear();
  EXPECT_FALSE(writer.spindle({}, lines));
  EXPECT_FALSE(writer.tool({.origin = {}, .number = 4, .offset = {}}, lines));
  EXPECT_THAT(lines, ElementsAre("M5", "T4", "M6"));
  lines.clear();
  EXPECT_FALSE(
      writer.tool({.origin = {}, .number = 5, .is_preselection = true, .offset = {}}, lines));
  EXPECT_THAT(lines, ElementsAre("T5"));
}

TEST(LinuxCncCommands, AToolThatIsInTheSpindleIsNamedAndNotChanged) {
  LinuxCncCommands writer;
  streamed::CommandWriter::Lines lines;
  EXPECT_FALSE(writer.spindle({{}, SpindleState::Clockwise, 1200, {}, {}}, lines));
  lines.clear();
  EXPECT_FALSE(
      writer.tool({.origin = {}, .number = 3, .offset = {}, .is_in_spindle = true}, lines));
  EXPECT_THAT(lines, ElementsAre("M61Q3")) << "no M6, and the spindle continues";
}

TEST(LinuxCncCommands, CoolantIsSwitchedAsAWhole) {
  LinuxCncCommands writer;
  streamed::CommandWriter::Lines lines;
  EXPECT_FALSE(writer.coolant({{}, true, true}, lines));
  EXPECT_THAT(lines, ElementsAre("M7", "M8"));
  lines.clear();
  EXPECT_FALSE(writer.coolant({{}, true, false}, lines));
  EXPECT_THAT(lines, ElementsAre("M9", "M8"));
}

TEST(LinuxCncCommands, OutputsAndFunctionsOfTheBuilder) {
  LinuxCncCommands writer;
  streamed::CommandWriter::Lines lines;
  EXPECT_FALSE(writer.pin({{}, {}, 2, true, 150.0}, lines));
  EXPECT_THAT(lines, ElementsAre("M64P2", "G4P0.150", "M65P2"));
  lines.clear();
  EXPECT_FALSE(writer.miscellaneous({{}, 101}, lines));
  EXPECT_THAT(lines, ElementsAre("M101"));
  lines.clear();
  EXPECT_FALSE(writer.miscellaneous({.origin = {}, .code = 199, .p = 5, .q = -0.25}, lines));
  EXPECT_THAT(lines, ElementsAre("M199P5Q-0.25"));
  EXPECT_TRUE(writer.miscellaneous({.origin = {}, .code = 100, .p = INFINITY}, lines));
  lines.clear();
  EXPECT_FALSE(writer.miscellaneous({.origin = {}, .code = 67, .e = 3, .q = -0.5}, lines));
  EXPECT_THAT(lines, ElementsAre("M68E3Q-0.5")) << "the motion before it has ended";
}

TEST(LinuxCncCommands, AdaptiveFeedIsLinuxCncs) {
  LinuxCncCommands writer;
  streamed::CommandWriter::Lines lines;
  EXPECT_FALSE(writer.miscellaneous({.origin = {}, .code = 52, .p = 1}, lines));
  EXPECT_FALSE(writer.miscellaneous({.origin = {}, .code = 52, .p = 0}, lines));
  EXPECT_THAT(lines, ElementsAre("M52P1", "M52P0"));
}

TEST(LinuxCncCommands, WhatLinuxCncLacksIsRefused) {
  LinuxCncCommands writer;
  streamed::CommandWriter::Lines lines;
  EXPECT_TRUE(writer.miscellaneous({{}, 25}, lines));
  EXPECT_FALSE(writer.miscellaneous({{}, 6}, lines)) << "the tool came with its number";
  EXPECT_TRUE(writer.spindle({{}, SpindleState::Oriented, 0, {}, {}}, lines));
  EXPECT_TRUE(writer.spindle({{}, SpindleState::Clockwise, 0, Length::mm(100'000), {}}, lines));
  EXPECT_TRUE(writer.tool({.origin = {}, .number = -1, .offset = {}}, lines));
  streamed::TextRules rules;
  rules.max_rpm = 6000;
  rules.max_rpm_setting = " ([SPINDLE_0]...)";
  writer.begin(rules);
  const auto refusal = writer.spindle({{}, SpindleState::Clockwise, 6001, {}, {}}, lines);
  ASSERT_TRUE(refusal);
  EXPECT_EQ(refusal->text, "spindle speed 6001 is above the machine's 6000 rpm ([SPINDLE_0]...)");
  EXPECT_THAT(lines, IsEmpty());
}

}  // namespace
}  // namespace dripline::machine::linuxcnc
