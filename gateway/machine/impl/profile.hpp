#pragma once

namespace dripline::machine::impl {

/// The task of a velocity profile. Units: mm (or degrees) and seconds.
struct ProfileTask {
  double length = 0;
  double entry = 0;   ///< speed now
  double cruise = 0;  ///< the speed wanted; 0: come to rest as soon as possible
  double exit = 0;    ///< the highest speed allowed at the end
  double acceleration = 1;
};

/// Speed over time along one path with a constant acceleration: a ramp to the cruising speed, the
/// cruise, a ramp to the exit speed. Never faster than the task allows, except that a speed too
/// high at entry is reduced by the acceleration and not at once; then `exit` may be exceeded.
class Profile {
 public:
  Profile() = default;
  explicit Profile(const ProfileTask& task);

  double duration() const { return ramp_ + cruise_ + brake_; }
  double distance_at(double time) const;
  double speed_at(double time) const;
  double exit_speed() const { return exit_; }
  /// False: it comes to rest before the end of the path.
  bool reaches_end() const { return reaches_end_; }

 private:
  void rest(const ProfileTask& task);
  void brake_all_the_way(const ProfileTask& task);
  void plan(const ProfileTask& task, double cruise);

  double entry_ = 0, top_ = 0, exit_ = 0, acceleration_ = 1;
  double ramp_ = 0, cruise_ = 0, brake_ = 0;  ///< seconds
  bool reaches_end_ = true;
};

}  // namespace dripline::machine::impl
