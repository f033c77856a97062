// M functions of our interpreter at LinuxCNC: tools, outputs, those of the builder.
#include <gtest/gtest.h>

#include "tests/integration/linuxcnc/program_path.hpp"

namespace dripline::integration {
namespace {

class LinuxCncFunctions : public LinuxCncPrograms {
 protected:
  LinuxCncFunctions() {
    table = "T1 P1 Z0 D10\nT2 P2 Z0 D6\n";
    tools = "[[tool]]\nnumber = 1\n[[tool]]\nnumber = 2\n";
  }
  void prepare() override {
    linuxcnc->add_to_ini("EMCIO", "TOOL_CHANGE_POSITION = 7 8 9");
    linuxcnc->add_function(101);
  }
};

TEST_F(LinuxCncFunctions, GetTheirWords) {
  run("G21 M101 P5 Q-2.5\nM2\n");
  EXPECT_EQ(linuxcnc->arguments_of(101), "5.000000 -2.500000");
}

// What stops, ends and inhibits is done by other events.
TEST_F(LinuxCncFunctions, ThatLeaveNothingToTheMachineAreNoReasonToRefuseAProgram) {
  run("G21 M49\nM48\nG0 X1\nM30\n");
  EXPECT_TRUE(rests());
  EXPECT_NEAR(x(), 1, 0.001);
}

// M2 leaves it on, but the next program of ours begins without.
TEST_F(LinuxCncFunctions, AdaptiveFeedIsOfTheProgram) {
  LinuxCncItself itself(linuxcnc->ini());
  run("G21 M52 P1\nG0 X1\nM2\n");
  itself.run("G21 G90 G0 X2\nM2\n");
  ASSERT_TRUE(wait([&] { return rests() && std::fabs(x() - 2) < 0.001; }));
  EXPECT_TRUE(itself.is_adaptive());
  run("G21 G0 X3\nM2\n");
  itself.run("G21 G90 G0 X4\nM2\n");
  EXPECT_FALSE(itself.is_adaptive());
}

TEST_F(LinuxCncFunctions, SwitchOutputsAndReadInputs) {
  run("G21 M64 P1\nM66 P2 L0\nG0 X[#5399*5]\nM65 P1\nM66 P2\nG0 Z[#5399*5+1]\nM62 P1\nG0 X6\n"
      "M66 P2\nG0 Z[#5399*5+2]\nM2\n");
  EXPECT_TRUE(rests());
  EXPECT_NEAR(x(), 6, 0.001);
  EXPECT_NEAR(z(), 7, 0.001);
  EXPECT_TRUE(std::ranges::any_of(linuxcnc->samples(), [](const LinuxCnc::Sample& sample) {
    return std::fabs(sample.at[0] - 5) < 0.001 && std::fabs(sample.at[2] - 1) < 0.001;
  }));
}

TEST_F(LinuxCncFunctions, WriteAndReadAnalogValues) {
  run("G21 M68 E1 Q2.5\nM66 E2 L0\nG0 X#5399\nM67 E1 Q4\nG0 Y1\nM66 E2\nG0 X#5399\nM2\n");
  EXPECT_TRUE(rests());
  EXPECT_NEAR(x(), 4, 0.001);
  EXPECT_TRUE(std::ranges::any_of(linuxcnc->samples(), [](const LinuxCnc::Sample& sample) {
    return std::fabs(sample.at[0] - 2.5) < 0.001 && std::fabs(sample.at[1]) < 0.001;
  }));
}

TEST_F(LinuxCncFunctions, AToolIsNamedWithoutAChange) {
  run("G21 G0 X1 Z2\nM61 Q2\nG0 X3\nM2\n");
  for (const auto& sample : linuxcnc->samples())
    EXPECT_LE(sample.at[1], 0.001) << "the tool was changed at Y 8";
}

// LinuxCNC's own tool change position: nothing of the program is moved from there.
TEST_F(LinuxCncFunctions, AToolChangeThatMovesTheAxesEndsTheProgram) {
  begin();
  interpreter::MemorySource source("G21 G0 X1 Z2\nT1 M6\nG0 X3\nM2\n");
  const auto interpreter = interpret(source, machine->events());
  while (interpreter->step(1) == interpreter::StepState::Ran) {
  }
  ASSERT_TRUE(wait_over());
  EXPECT_EQ(machine->state(), MachineState::Alarmed);
  EXPECT_EQ(alarm().substr(0, 7), "MCH0009") << alarm();
  EXPECT_TRUE(rests());
  EXPECT_NEAR(x(), 7, 0.001) << "where LinuxCNC changes tools, and not at X3";
}

TEST_F(LinuxCncFunctions, AToolChangeWhereTheAxesAreIsOne) {
  run("G21 G0 X7 Y8 Z9\nT1 M6\nG0 X3\nM2\n");
  EXPECT_TRUE(rests());
  EXPECT_NEAR(x(), 3, 0.001);
}

}  // namespace
}  // namespace dripline::integration
