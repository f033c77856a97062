// What an edit is about: the class by which a policy accepts it without a look.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "clients/tools/comparison/program_comparison.hpp"
#include "gateway/interpreter/registry.hpp"

namespace dripline::comparison {
namespace {

using interpreter::MemorySource;

struct Edit {
  std::string_view name, control, text, from, to, expected;
};

std::string edited(const Edit& edit) {
  std::string text(edit.text);
  const auto at = text.find(edit.from);
  EXPECT_NE(at, std::string::npos);
  return text.replace(at, edit.from.size(), edit.to);
}

nlohmann::json compared(const Edit& edit) {
  const auto dialect = interpreter::find_dialect(edit.control);
  EXPECT_TRUE(dialect);
  const std::string before(edit.text), after = edited(edit);
  MemorySource first(before), second(after);
  ProgramOptions options;
  options.by = ProgramOptions::By::Motion;
  const auto result =
      compare_programs({.source = first, .size = before.size(), .dialect = *dialect},
                       {.source = second, .size = after.size(), .dialect = *dialect}, options);
  EXPECT_TRUE(result) << result.error().what;
  return result ? *result : nlohmann::json();
}

class EditOfACut : public testing::TestWithParam<Edit> {};
TEST_P(EditOfACut, HasItsClass) {
  const auto result = compared(GetParam());
  EXPECT_EQ(result.at("class"), GetParam().expected) << result.at("motion").dump(1);
}

constexpr std::string_view kMilled =
    "G21 G90 G94\nS500 M3\nG0 X0 Y0 Z5.\nG1 Z-1. F100.\nX10.\nG0 Z5.\nM5\nM30\n";
constexpr std::string_view kTurned =
    "G21 G18 G90\nG96 S150 M3\nG0 X20. Z2.\nG1 Z-5. F0.2\nG0 X50.\nM5\nM30\n";
constexpr std::string_view kFloating =
    "G21 G90 G94\nS500 M3\nG0 Z5.\nF625.\nG1 Z-10.\nM4\nG1 Z5.\nG0 Z20.\nM5\nM30\n";
constexpr std::string_view kTap =
    "G21 G90 G94\nS500 M3\nG0 X0 Y0 Z5.\nG84 Z-10. R2. F500.\nG80\nM5\nM30\n";
constexpr std::string_view kRigidTap =
    "G21 G90 G94\nG0 X0 Y0 Z5.\nM29 S500\nG84 Z-10. R2. F500.\nG80\nM30\n";

INSTANTIATE_TEST_SUITE_P(
    Fanuc, EditOfACut,
    testing::Values(Edit{"feed", "fanuc", kMilled, "F100.", "F120.", "feed_and_speed"},
                    Edit{"speed", "fanuc", kMilled, "S500", "S600", "feed_and_speed"},
                    Edit{"other_sense", "fanuc", kMilled, "M3", "M4", "other"},
                    Edit{"other_sense_for_one_cut", "fanuc", kMilled, "G1 Z-1. F100.\nX10.\n",
                         "M4\nG1 Z-1. F100.\nX10.\nM3\n", "other"},
                    Edit{"stopped_before_the_cut", "fanuc", kMilled, "G1 Z", "M5\nG1 Z", "other"},
                    Edit{"never_started", "fanuc", kMilled, " M3", "", "other"},
                    Edit{"no_speed", "fanuc", kMilled, "S500", "S0", "other"},
                    Edit{"no_speed_for_the_cut", "fanuc", kMilled, "G1 Z", "S0\nG1 Z", "other"},
                    Edit{"feed_per_revolution", "fanuc", kMilled, "G94", "G95", "other"},
                    Edit{"surface_speed", "fanuc", kMilled, "S500 M3", "G96 S500 M3", "other"}),
    [](const auto& tested) { return std::string(tested.param.name); });

INSTANTIATE_TEST_SUITE_P(
    FanucLathe, EditOfACut,
    testing::Values(Edit{"surface_speed", "fanuc-t", kTurned, "S150", "S180", "feed_and_speed"},
                    Edit{"feed", "fanuc-t", kTurned, "F0.2", "F0.3", "feed_and_speed"},
                    Edit{"revolutions", "fanuc-t", kTurned, "G96", "G97", "other"},
                    Edit{"limit", "fanuc-t", kTurned, "G96", "G50 S2000\nG96", "other"}),
    [](const auto& tested) { return std::string(tested.param.name); });

INSTANTIATE_TEST_SUITE_P(
    Threads, EditOfACut,
    testing::Values(
        Edit{"tap_feed", "fanuc", kTap, "F500.", "F450.", "geometry"},
        Edit{"tap_speed", "fanuc", kTap, "S500", "S600", "geometry"},
        Edit{"tap_speed_before_it", "fanuc", kTap, "G84", "S600\nG84", "geometry"},
        Edit{"rigid_tap_feed", "fanuc", kRigidTap, "F500.", "F450.", "geometry"},
        Edit{"rigid_tap_speed", "fanuc", kRigidTap, "S500", "S600", "geometry"},
        Edit{"left_hand_tap", "fanuc",
             "G21 G90 G94\nS500 M4\nG0 Z5.\nG74 Z-10. R2. F500.\nG80\nM5\nM30\n", "F500.", "F450.",
             "geometry"},
        Edit{"floating_feed", "fanuc", kFloating, "F625.", "F500.", "geometry"},
        Edit{"floating_speed", "fanuc", kFloating, "S500", "S400", "geometry"},
        Edit{"ngc_tap_feed", "rs274ngc",
             "G21 G90 G94\nS500 M3\nG0 Z5\nG84 X1 Y1 Z-10 R2 F500\nG80\nM2\n", "F500", "F450",
             "geometry"},
        Edit{"ngc_tap_speed", "rs274ngc",
             "G21 G90 G94\nS500 M3\nG0 Z5\nG84 X1 Y1 Z-10 R2 F500\nG80\nM2\n", "S500", "S600",
             "geometry"},
        Edit{"centurion_tap_speed", "centurion",
             "G97 G99 S300 M3\nG0 X0 Z.5\nG39 G84 F.05 R.2 Z-.7\nM5\n", "S300", "S400", "geometry"},
        Edit{"centurion_tap_feed", "centurion",
             "G97 G99 S300 M3\nG0 X0 Z.5\nG39 G84 F.05 R.2 Z-.7\nM5\n", "F.05", "F.06", "geometry"},
        Edit{"tektronix_tap_feed", "tektronix-1704", "%\nF80M03\nG84X10000R1000Z-4000\nM02\n",
             "F80", "F90", "geometry"},
        Edit{"tnc_tap_feed", "tnc155",
             "0 BEGIN PGM 7 MM\n1 TOOL DEF 1 L+0,000 R+4,000\n2 TOOL CALL 1 Z S800\n"
             "3 L Z+2,000 R0 F9999 M03\n4 CYCL DEF 2.0 TAPPING\n5 CYCL DEF 2.1 SET-UP -3,000\n"
             "6 CYCL DEF 2.2 DEPTH -12,000\n7 CYCL DEF 2.3 DWELL 0,250\n"
             "8 CYCL DEF 2.4 F1000\n9 L X+10,000 Y+10,000 R0 F9999 M99\n10 END PGM 7 MM\n",
             "F1000", "F900", "geometry"},
        Edit{"itnc_tap_speed", "itnc",
             "BEGIN PGM TAP MM\nTOOL DEF 1 L+0 R+3\nTOOL CALL 1 Z S1000 F250\n"
             "L X+0 Y+0 Z+50 R0 FMAX M3\nCYCL DEF 206 TAPPING NEW ~\n    Q200=5 ; ~\n"
             "    Q201=-12 ; ~\n    Q206=1250 ; ~\n    Q211=0 ; ~\n    Q203=0 ; ~\n"
             "    Q204=20 ;\nL X+10 Y+10 FMAX M99\nEND PGM TAP MM\n",
             "S1000", "S900", "geometry"}),
    [](const auto& tested) { return std::string(tested.param.name); });

/// A block that another run executes may be a tap, or set the speed to nothing.
INSTANTIATE_TEST_SUITE_P(
    WithConditions, EditOfACut,
    testing::Values(Edit{"feed", "fanuc",
                         "G21 G90 G94\nS500 M3\nG0 Z5.\n/G0 X1.\nG1 Z-1. F9.\nM5\nM30\n", "F9.",
                         "F8.", "other"},
                    Edit{"no_speed_and_offset", "fanuc",
                         "G21 G90 G94\nS500 M3\nG0 Z5.\n/S400 G54\nG1 Z-1. F9.\nM5\nM30\n",
                         "S400 G54", "S0 G55", "other"}),
    [](const auto& tested) { return std::string(tested.param.name); });

}  // namespace
}  // namespace dripline::comparison
