#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "gateway/interpreter/stages/tilting/rigid.hpp"

/// How the rotary axes of a five-axis machine turn its table and its tool. Axis positions are those
/// of events: machine coordinates without the tool's length, so that with both rotary axes at 0 the
/// linear axes are at the tip. Pure; any thread.
namespace dripline::interpreter::tilting {

struct RotaryAxis {
  static constexpr double kFar = 1e9;

  Axis axis = Axis::A;
  bool is_reversed = false;  ///< positive angles turn clockwise, seen from the positive end
  bool is_table = true;
  /// A point of its axis with both axes at 0: of a table in machine coordinates, of a head as seen
  /// from the spindle's gauge point.
  Point3 center{};
  double low = -kFar;  ///< limits of its machine coordinate, degrees
  double high = kFar;

  std::size_t direction() const { return static_cast<std::size_t>(axis) - 3; }  ///< X, Y, Z
};

enum class KinematicType : std::uint8_t { None, TableTable, HeadTable, HeadHead };

/// The master rotates the slave, where both are of the table or both of the head. Of a head and a
/// table, the head is the master.
struct Kinematics {
  KinematicType type = KinematicType::None;
  RotaryAxis master;
  RotaryAxis slave;
  bool has_limits = false;
  double tip_tolerance = 0.005;    ///< of the tip's path while rotary axes move, millimeters
  bool begins_at_present = false;  ///< G43.4 takes the table as it is for the work offset's

  bool exists() const { return type != KinematicType::None; }
};

/// Machine coordinates of the rotary axes, degrees.
struct Pose {
  double master = 0;
  double slave = 0;
};
Pose pose_of(const Kinematics& machine, const Position& at);

/// Takes a point of the table at 0 to where the table has brought it.
Rigid table_motion(const Kinematics& machine, Pose pose);
/// From where the linear axes are to the tip of a tool of `length`.
Point3 tip_shift(const Kinematics& machine, Pose pose, double length);
/// From the tip to the spindle, of length 1.
Point3 tool_direction(const Kinematics& machine, Pose pose);

/// The pose in which the tool is normal to a plane of the workpiece. `normal` is that of the plane
/// with the table at `zero`. Of several poses within the limits, the one that moves the master
/// least, then the slave least, then with the master, then the slave nearest to 0; of a head and a
/// table, the table comes before the head. nullopt: there is none.
std::optional<Pose> aligned_pose(const Kinematics& machine, Pose zero, const Point3& normal,
                                 Pose present);

/// All of them within the limits, the preferred one first: two at most.
struct AlignedPose {
  Pose pose;
  bool is_free = false;  ///< every angle of one axis would do; it stays where it is
};
std::vector<AlignedPose> aligned_poses(const Kinematics& machine, Pose zero, const Point3& normal,
                                       Pose present);

/// How many straight pieces of the axes keep the tip within `tolerance` of its straight path on the
/// workpiece. `from` and `to` are tips in machine coordinates with the table at 0.
double pieces_within(const Kinematics& machine, Pose pose, Pose end, const Point3& from,
                     const Point3& to, double length);

}  // namespace dripline::interpreter::tilting
