#include "gateway/interpreter/stages/tilting/kinematics.hpp"

#include <limits>
#include <utility>

#include "gateway/interpreter/core/language/expression.hpp"

namespace dripline::interpreter::tilting {
namespace {

Point3 unit(std::size_t axis) {
  Point3 direction{};
  direction[axis] = 1;
  return direction;
}

Matrix3 turn_of(const RotaryAxis& rotary, double degrees) {
  return rotation_about(rotary.direction(), rotary.is_reversed ? -degrees : degrees);
}

/// About the axis through `rotary.center`.
Rigid motion_of(const RotaryAxis& rotary, double degrees) {
  const Matrix3 turn = turn_of(rotary, degrees);
  return {turn, rotary.center - turn * rotary.center};
}

/// From a to b about `axis`; nullopt: a is along the axis, so that every angle leads there.
std::optional<double> angle_about(const Point3& axis, const Point3& a, const Point3& b) {
  constexpr double kAlong = 1e-7;
  const Point3 across = a - dot(a, axis) * axis;
  if (length(across) < kAlong) return std::nullopt;
  return std::atan2(dot(axis, cross(across, b)), dot(across, b)) * (180 / Angle::kPi);
}

/// The angle, or one that is whole revolutions away, nearest to the present one within the limits.
std::optional<double> reachable(const RotaryAxis& rotary, std::optional<double> geometric,
                                double present) {
  constexpr double kAtLimit = 1e-9;
  double angle = present;
  if (geometric) {
    const double wanted = rotary.is_reversed ? -*geometric : *geometric;
    angle = present + std::remainder(wanted - present, 360);
  }
  if (angle < rotary.low - kAtLimit) angle += 360 * std::ceil((rotary.low - angle) / 360 - 1e-12);
  if (angle > rotary.high + kAtLimit) angle -= 360 * std::ceil((angle - rotary.high) / 360 - 1e-12);
  if (angle < rotary.low - kAtLimit || angle > rotary.high + kAtLimit) return std::nullopt;
  return std::clamp(angle, rotary.low, rotary.high);
}

/// The conditions in their order; a smaller value decides.
using Preference = std::array<double, 4>;

Preference preference_of(const Kinematics& machine, Pose pose, Pose present) {
  const double master = std::fabs(pose.master - present.master);
  const double slave = std::fabs(pose.slave - present.slave);
  const double master_from_zero = std::fabs(std::remainder(pose.master, 360));
  const double slave_from_zero = std::fabs(std::remainder(pose.slave, 360));
  if (machine.type == KinematicType::HeadTable)
    return {slave, master, slave_from_zero, master_from_zero};
  return {master, slave, master_from_zero, slave_from_zero};
}

bool is_preferred(const Preference& a, const Preference& b) {
  constexpr double kSame = 1e-6;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::fabs(a[i] - b[i]) > kSame) return a[i] < b[i];
  }
  return false;
}

double distance_from_axis(const RotaryAxis& rotary, const Point3& point) {
  Point3 out = point - rotary.center;
  out[rotary.direction()] = 0;
  return length(out);
}

}  // namespace

Matrix3 rotation_about(std::size_t axis, double degrees) {
  const double sine = language::sine(degrees).value;
  const double cosine = language::cosine(degrees).value;
  const std::size_t first = (axis + 1) % 3;
  const std::size_t second = (axis + 2) % 3;
  Matrix3 turn;
  turn.at[3 * first + first] = turn.at[3 * second + second] = cosine;
  turn.at[3 * first + second] = -sine;
  turn.at[3 * second + first] = sine;
  return turn;
}

Pose pose_of(const Kinematics& machine, const Position& at) {
  return {at.raw(machine.master.axis), at.raw(machine.slave.axis)};
}

Rigid table_motion(const Kinematics& machine, Pose pose) {
  if (machine.type == KinematicType::TableTable)
    return motion_of(machine.master, pose.master) * motion_of(machine.slave, pose.slave);
  if (machine.type == KinematicType::HeadTable) return motion_of(machine.slave, pose.slave);
  return {};
}

Point3 tip_shift(const Kinematics& machine, Pose pose, double length) {
  const Point3 tip{0, 0, -length};
  Point3 at = tip;  // as seen from the gauge point
  if (machine.type == KinematicType::HeadHead) at = motion_of(machine.slave, pose.slave)(at);
  if (!machine.master.is_table) at = motion_of(machine.master, pose.master)(at);
  return at - tip;
}

Point3 tool_direction(const Kinematics& machine, Pose pose) {
  Point3 direction{0, 0, 1};
  if (machine.type == KinematicType::HeadHead)
    direction = turn_of(machine.slave, pose.slave) * direction;
  if (!machine.master.is_table) direction = turn_of(machine.master, pose.master) * direction;
  return direction;
}

/// Both chains of rotations are one about p of `a` and one about q of `b`, and where these meet is
/// a direction v: its parts along p and along q are those of a and of b, and its length is 1.
std::vector<AlignedPose> aligned_poses(const Kinematics& machine, Pose zero, const Point3& normal,
                                       Pose present) {
  const bool is_head_head = machine.type == KinematicType::HeadHead;
  const Point3 wanted = transposed(table_motion(machine, zero).turn) * normal;
  const Point3 spindle{0, 0, 1};
  const Point3& a = is_head_head ? spindle : wanted;
  const Point3& b = is_head_head ? wanted : spindle;
  const Point3 p = unit(machine.slave.direction());
  const Point3 q = unit(machine.master.direction());
  const double along_p = dot(a, p);
  const double along_q = dot(b, q);
  double square = 1 - along_p * along_p - along_q * along_q;
  if (!(square >= -1e-9)) return {};
  if (square < 1e-14) square = 0;
  std::vector<AlignedPose> poses;
  for (const double side : {1.0, -1.0}) {
    const Point3 v = along_p * p + along_q * q + side * std::sqrt(square) * cross(p, q);
    std::optional<double> master = angle_about(q, b, v);
    // of two tables or heads the master rotates v in the opposite direction
    if (master && machine.type != KinematicType::HeadTable) master = -*master;
    const auto at_master = reachable(machine.master, master, present.master);
    const auto slave = angle_about(p, a, v);
    const auto at_slave = reachable(machine.slave, slave, present.slave);
    if (!at_master || !at_slave) continue;
    poses.push_back({{*at_master, *at_slave}, !master || !slave});
  }
  if (poses.size() == 2 && is_preferred(preference_of(machine, poses[1].pose, present),
                                        preference_of(machine, poses[0].pose, present)))
    std::swap(poses[0], poses[1]);
  return poses;
}

std::optional<Pose> aligned_pose(const Kinematics& machine, Pose zero, const Point3& normal,
                                 Pose present) {
  const auto poses = aligned_poses(machine, zero, normal, present);
  if (poses.empty()) return std::nullopt;
  return poses.front().pose;
}

/// Within a piece the axes move straight, so that the tip departs from its chord by no more than an
/// eighth of its acceleration, over the piece as one unit of time. The bounds are those of the
/// whole move: with n pieces the acceleration is one n-th of a n-th.
double pieces_within(const Kinematics& machine, Pose pose, Pose end, const Point3& from,
                     const Point3& to, double length) {
  const double master = std::fabs(end.master - pose.master) / (180 / Angle::kPi);
  const double slave = std::fabs(end.slave - pose.slave) / (180 / Angle::kPi);
  if (master == 0 && slave == 0) return 1;
  double table_turn = 0;
  double head_turn = 0;
  (machine.master.is_table ? table_turn : head_turn) += master;
  (machine.slave.is_table ? table_turn : head_turn) += slave;
  double table_radius = 0;
  if (machine.slave.is_table) {
    table_radius =
        std::max(distance_from_axis(machine.slave, from), distance_from_axis(machine.slave, to));
  }
  if (machine.master.is_table) {
    const Point3& center = machine.slave.center;
    const double reach = std::max(tilting::length(from - center), tilting::length(to - center));
    table_radius = std::max(table_radius, reach + distance_from_axis(machine.master, center));
  }
  double head_radius = 0;
  if (!machine.master.is_table)
    head_radius = tilting::length(machine.master.center) + std::fabs(length);
  if (!machine.slave.is_table) head_radius += 2 * tilting::length(machine.slave.center);
  const double axis_speed =
      tilting::length(to - from) + table_turn * table_radius + 2 * head_turn * head_radius;
  const double acceleration = table_turn * table_turn * table_radius + 2 * table_turn * axis_speed +
                              head_turn * head_turn * head_radius;
  return std::max(1.0, std::ceil(std::sqrt(acceleration / (8 * machine.tip_tolerance))));
}

}  // namespace dripline::interpreter::tilting
