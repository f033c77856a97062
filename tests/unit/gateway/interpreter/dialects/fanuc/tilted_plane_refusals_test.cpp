#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/gateway/interpreter/dialects/fanuc/tilting_machine.hpp"

/// FAN-102, FAN-103: blocks that G68.2 and G53.1 do not take, and blocks that a tilted plane does
/// not.
namespace dripline::interpreter::fanuc {
namespace {

struct PlaneRefusal {
  const char* name;
  std::string blocks;  ///< the last one is refused
  const char* id;
  const char* word;
};
class TiltedPlaneRefuses : public testing::TestWithParam<PlaneRefusal> {};

TEST_P(TiltedPlaneRefuses, WithTheLineAndTheReason) {
  const std::string blocks = GetParam().blocks;
  const MachineLog log = run_on(kTrunnion, "G90 G00 X1. Y1. Z50. F100.\n" + blocks + "\nM30\n",
                                "offset_memory = \"C\"\n", "[[tool]]\nnumber = 1\nradius = 2\n");
  EXPECT_TRUE(log.alarm.starts_with(GetParam().id)) << log.alarm;
  EXPECT_NE(log.alarm.find(GetParam().word), std::string::npos) << log.alarm;
  EXPECT_EQ(log.alarm_line,
            2U + static_cast<std::uint64_t>(std::count(blocks.begin(), blocks.end(), '\n')));
}

const std::string kInPlane = "G68.2 X0 Y0 Z0 I0 J30. K0\n";
INSTANTIATE_TEST_SUITE_P(
    , TiltedPlaneRefuses,
    testing::Values(
        PlaneRefusal{"no_zero", "G68.2 I0 J30. K0", "PS5457", "zero of the plane"},
        PlaneRefusal{"half_a_zero", "G68.2 X0 Z0 I0 J30. K0", "PS5457", "zero of the plane"},
        PlaneRefusal{"no_angles", "G68.2 X0 Y0 Z0", "PS5457", "angles"},
        PlaneRefusal{"angle", "G68.2 X0 Y0 Z0 I0 J361. K0", "PS5457", "J361"},
        PlaneRefusal{"three_points", "G68.2 P2 Q1 X0 Y0 Z0", "PS5457", "P2"},
        PlaneRefusal{"projections", "G68.2 P4 X0 Y0 Z0 I1. J1. K1.", "PS5457", "P4"},
        PlaneRefusal{"order", "G68.2 P1 Q112 X0 Y0 Z0 I1. J1. K1.", "PS5457", "Q112"},
        PlaneRefusal{"no_order", "G68.2 P1 X0 Y0 Z0 I1. J1. K1.", "PS5457", "Q"},
        PlaneRefusal{"radius", "G68.2 X0 Y0 Z0 I1. J1. K1. R5.", "PS5457", "not take"},
        PlaneRefusal{"p_of_two", "G54 G68.2 P1 Q123 X0 Y0 Z0 I1. J1. K1.", "PS113", "G54"},
        PlaneRefusal{"rotary_word", "G68.2 X0 Y0 Z0 I1. J1. K1. A5.", "PS5457", "not take"},
        PlaneRefusal{"in_rotation", "G68 X0 Y0 R30.\nG68.2 X0 Y0 Z0 I1. J1. K1.", "PS5457", "G68"},
        PlaneRefusal{"in_scaling", "G51 P2.\nG68.2 X0 Y0 Z0 I1. J1. K1.", "PS5457", "G51"},
        PlaneRefusal{"in_compensation", "G41 D1 G01 X5.\nG68.2 X0 Y0 Z0 I1. J1. K1.", "PS5457",
                     "compensation"},
        PlaneRefusal{"in_itself", kInPlane + "G68.2 X0 Y0 Z0 I0 J31. K0", "PS113", "G68.2"},
        PlaneRefusal{"in_tip_control", "G43.4 H1\nG68.2 X0 Y0 Z0 I0 J31. K0", "PS5421", "G43.4"},
        PlaneRefusal{"rotation", kInPlane + "G68 X0 Y0 R10.", "PS113", "G68"},
        PlaneRefusal{"scaling", kInPlane + "G51 P2.", "PS113", "G51"},
        PlaneRefusal{"mirror", kInPlane + "G51.1 X0", "PS113", "G51.1"},
        PlaneRefusal{"work_system", kInPlane + "G55", "PS113", "work system"},
        PlaneRefusal{"local_zero", kInPlane + "G52 X1.", "PS113", "G68.2 is in force"},
        PlaneRefusal{"preset", kInPlane + "G92 X1.", "PS113", "G68.2 is in force"},
        PlaneRefusal{"reference", kInPlane + "G28 Z0", "PS113", "G68.2 is in force"},
        PlaneRefusal{"machine_coordinates", kInPlane + "G53 Z0", "PS113", "G68.2 is in force"},
        PlaneRefusal{"skip", kInPlane + "G31 Z0", "PS113", "G68.2 is in force"},
        PlaneRefusal{"coordinates_by_g10", kInPlane + "G10 L2 P1 X5.", "PS113", "G10"},
        PlaneRefusal{"coordinates_by_variable", kInPlane + "#5221=5.", "PS116", "#5221"},
        PlaneRefusal{"units", kInPlane + "G20", "PS113", "units"},
        PlaneRefusal{"tip_control", kInPlane + "G43.4 H1", "PS113", "G43.4"},
        PlaneRefusal{"quill_move", kInPlane + "G01 X1. W-3. F100.", "PS113", "in no kinematics"},
        PlaneRefusal{"quill_before", "G00 V2.\nG68.2 X0 Y0 Z0 I10. J20. K0", "PS5457", "not at 0"},
        PlaneRefusal{"rotary_move", kInPlane + "G00 X1. A5.", "PS113", "rotary axis"},
        PlaneRefusal{"polar_plane", kInPlane + "G12.1", "PS113", "G12.1"},
        PlaneRefusal{"end_in_compensation", kInPlane + "G41 D1 G01 X5. Y5.\nG69", "PS113", "G40"},
        PlaneRefusal{"direction_without_a_plane", "G53.1", "PS5458", "G68.2"},
        PlaneRefusal{"direction_with_words", kInPlane + "G53.1 X0", "PS5458", "takes none"},
        PlaneRefusal{"direction_with_p", kInPlane + "G53.1 P1", "PS5458", "takes none"},
        PlaneRefusal{"direction_in_compensation", kInPlane + "G41 D1 G01 X5. Y5.\nG53.1", "PS5458",
                     "G40"},
        PlaneRefusal{"other_five_axis_code", "G68.3 X0 Y0 Z0", "PS010", "G43.5, G53.1"},
        PlaneRefusal{"retaining_direction", kInPlane + "G53.6 H1", "PS010", "G53.6"}),
    [](const auto& each) { return std::string(each.param.name); });

}  // namespace
}  // namespace dripline::interpreter::fanuc
