#include "gateway/interpreter/dialects/tnc155/execution/coordinate_frame.hpp"

#include "gateway/interpreter/dialects/tnc155/execution/path.hpp"

namespace dripline::interpreter::tnc155 {

CoordinateFrame frame_of(const State& state) {
  const Transformation& transformation = state.transformation;
  CoordinateFrame frame;
  frame.datum = transformation.datum;
  frame.shift = transformation.shift;
  frame.rotation = transformation.rotation;
  frame.basic_rotation = transformation.basic_rotation;
  frame.mirrored = transformation.mirrored;
  for (std::size_t i = 0; i < frame.scale.size(); ++i)
    if (transformation.scaled[i]) frame.scale[i] = transformation.scale;
  if (state.has_pole) {
    const PlaneAxes axes = axes_of(state.plane);
    frame.pole = state.pole;
    frame.pole_axes = static_cast<std::uint8_t>(bit(axes.first) | bit(axes.second));
  }
  if (transformation.is_special) {
    frame.learn([&](const CoordinateFrame::Values& at) { return transformation.to_program(at); });
  } else {
    frame.learn_offset(transformation.offset);
  }
  return frame;
}

bool is_tool_tilted(const ControlOptions& options, const Position& at) {
  constexpr double kStraight = 1e-9;
  const tilting::Kinematics& machine = options.kinematics;
  return machine.exists() &&
         tilting::tool_direction(machine, tilting::pose_of(machine, at))[2] < 1 - kStraight;
}

}  // namespace dripline::interpreter::tnc155
