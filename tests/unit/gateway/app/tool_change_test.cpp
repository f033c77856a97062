#include <gtest/gtest.h>

#include "gateway/interpreter/core/dialects.hpp"
#include "tests/unit/gateway/app/gateway_fixture.hpp"

/// Where tools are changed by hand the machine waits, and the operator is shown which tool.
namespace dripline::gateway {
namespace {

using dds::CommandAction;
using dds::Execution;
using dds::RunOutcome;

interpreter::Setup setup_of(const std::string& toml) {
  auto setup = interpreter::parse_setup(toml);
  EXPECT_TRUE(setup) << setup.error().what;
  return *setup;
}

struct ToolChangeCase {
  std::string name;
  const interpreter::Dialect& control;
  std::string program;
  std::string without_changer;  ///< setup
  std::string with_changer;
  std::string message;
};

void PrintTo(const ToolChangeCase& shown, std::ostream* out) {
  *out << shown.name;
}

class ToolChangeAtTheGateway : public testing::TestWithParam<ToolChangeCase> {};

// CEN-142, HD-135: PROGRAM_STOPPED until resume.
TEST_P(ToolChangeAtTheGateway, WaitsWithoutAChanger) {
  const ToolChangeCase& given = GetParam();
  GatewayFixture fixture(given.control, setup_of(given.without_changer), "max");
  fixture.push("1", given.program);
  ASSERT_TRUE(fixture.start("1").accepted);
  ASSERT_TRUE(fixture.run_until(
      [&] { return fixture.status && fixture.status->execution == Execution::ProgramStopped; }));
  EXPECT_EQ(fixture.status->message, given.message);
  const double there = fixture.status->position[0];
  for (int turn = 0; turn < 50; ++turn) fixture.run_until([&] { return true; });
  EXPECT_EQ(fixture.status->position[0], there) << "it waits for as long as it takes";
  EXPECT_EQ(fixture.count(dds::RecordKind::RunEnded), 0U);
  ASSERT_TRUE(fixture.send(fixture.command(CommandAction::Resume)).accepted);
  EXPECT_EQ(fixture.ended().outcome, RunOutcome::Completed);
  EXPECT_NE(fixture.status->position[0], there);
}

TEST_P(ToolChangeAtTheGateway, GoesOnWithAChanger) {
  const ToolChangeCase& given = GetParam();
  GatewayFixture fixture(given.control, setup_of(given.with_changer), "max");
  fixture.push("1", given.program);
  ASSERT_TRUE(fixture.start("1").accepted);
  EXPECT_EQ(fixture.ended().outcome, RunOutcome::Completed);
  EXPECT_EQ(fixture.count(dds::RecordKind::Stop), 0U);
}

INSTANTIATE_TEST_SUITE_P(
    , ToolChangeAtTheGateway,
    testing::Values(ToolChangeCase{"centurion", interpreter::kCenturionDialect,
                                   "O0002\nG0 X2\nT0202\nM6 (DRILL)\nG0 X3\nM30\n", "",
                                   "[control]\ntool_changer = true\n", "tool change: DRILL"},
                    ToolChangeCase{
                        "tnc155", interpreter::kTnc155Dialect,
                        "0 BEGIN PGM 1 MM\n1 L X+2 R0 F9000 M06\n2 L X+3\n3 END PGM 1 MM\n",
                        "[control]\nm06_stop = true\n", "", "tool change"}),
    [](const auto& given) { return given.param.name; });

// FAN-059, NGC-029: a changer does it, and nothing waits.
TEST(ToolChange, IsNoStopWhereTheMachineHasAChanger) {
  const auto runs_through = [](const interpreter::Dialect& control, const std::string& program) {
    GatewayFixture fixture(control, {}, "max");
    fixture.push("1", program);
    EXPECT_TRUE(fixture.start("1").accepted);
    return fixture.ended().outcome == RunOutcome::Completed &&
           fixture.count(dds::RecordKind::Stop) == 0;
  };
  EXPECT_TRUE(
      runs_through(interpreter::kFanucDialect, "%\nO0001\nG90 G21 G00 X2.\nT2 M06\nX3.\nM30\n%\n"));
  EXPECT_TRUE(runs_through(interpreter::kRs274NgcDialect, "G21 G90 G0 X2\nT2 M6\nG0 X3\nM2\n"));
}

}  // namespace
}  // namespace dripline::gateway
