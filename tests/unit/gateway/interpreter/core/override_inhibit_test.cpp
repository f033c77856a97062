#include <gtest/gtest.h>

#include "gateway/interpreter/core/dialects.hpp"
#include "tests/support/program_run.hpp"

/// What the programs of the milling controls keep the operator's hands off; the lathe's are in
/// tests/unit/gateway/interpreter/dialects/centurion.
namespace dripline::interpreter {
namespace {

using Lines = std::vector<std::string>;
using ControlSetup = interpreter::Setup;  // gtest keeps a private member named Setup

/// Feed, spindle and single block locked; when a hold acts (0 at once, 1 later, 2 one from before
/// later too); a tapping cycle.
template <const Dialect& kDialect>
Lines locks_of(const std::string& text, const ControlSetup& setup = {}) {
  DialectRun<kDialect> run(text, setup);
  EXPECT_EQ(run.step(), StepState::Ended) << run.alarm();
  return run.events("lock");
}

TEST(FanucOverrideInhibit, IsThatOfATapAndEndsAfterTheRetraction) {
  const Lines tap{"111 1 1", "000 2 0", "000 0 0"};
  EXPECT_EQ(locks_of<kFanucDialect>("G21 S500 M3\nG84 X0 Y0 Z-5. R2. F500\nG80\nM30\n"), tap);
  EXPECT_EQ(locks_of<kFanucDialect>("G21 S500 M4\nG74 X0 Y0 Z-5. R2. F500\nG80\nM30\n"), tap);
  EXPECT_EQ(locks_of<kFanucDialect>("G21 S500 M3\nG81 X0 Y0 Z-5. R2. F500\nG80\nM30\n"), Lines{});
}

TEST(FanucOverrideInhibit, IsThatOfTappingModeAndOfTheVariables) {
  EXPECT_EQ(locks_of<kFanucDialect>("G0 X1.\nG63\nG64\nM30\n"), (Lines{"110 1 0", "000 0 0"}));
  EXPECT_EQ(locks_of<kFanucDialect>("G63\nG0 X1.\nM30\n"), Lines{"110 1 0"});
  EXPECT_EQ(locks_of<kFanucDialect>("G0 X1.\n#3003=1\n#3004=2\n#3004=5\nM30\n"),
            (Lines{"001 0 0", "111 0 0", "001 1 0"}));
}

TEST(Rs274NgcPanelLock, IsThatOfATapAndOfTheOverrideCodes) {
  const Lines locks =
      locks_of<kRs274NgcDialect>("G21 G90 F500 S500 M3\nM49\nG84 X1 Z-5 R1\nM48\nM2\n");
  EXPECT_EQ(locks, (Lines{"110 0 0", "111 1 1", "110 0 0", "000 0 0"}));
}

TEST(Rs274NgcPanelLock, IsThatOfARigidTapAndOfTheStopSwitch) {
  const auto setup = parse_setup("[control]\nprofile = \"linuxcnc\"\n");
  ASSERT_TRUE(setup) << setup.error().what;
  EXPECT_EQ(locks_of<kRs274NgcDialect>("G21 S500 M3\nG33.1 Z-5 K1\nM53 P0\nM53 P1\nM2\n", *setup),
            (Lines{"111 1 1", "000 0 0", "000 1 0", "000 0 0"}));
}

/// HD-169
TEST(TncOverrideInhibit, IsThatOfTheTappingCycle) {
  EXPECT_EQ(locks_of<kTnc155Dialect>("0 BEGIN PGM 8 MM\n1 TOOL DEF 1 L+0,000 R+4,000\n"
                                     "2 TOOL CALL 1 Z S500\n3 L Z+5,000 R0 F9999 M03\n"
                                     "4 CYCL DEF 2.0 TAPPING\n5 CYCL DEF 2.1 SET-UP -2,000\n"
                                     "6 CYCL DEF 2.2 DEPTH -9,000\n7 CYCL DEF 2.3 DWELL 0,500\n"
                                     "8 CYCL DEF 2.4 F500\n9 L X+3,000 Y+1,000 R0 F9999 M99\n"
                                     "10 END PGM 8 MM\n"),
            (Lines{"111 1 1", "000 0 0"}));
}

}  // namespace
}  // namespace dripline::interpreter
