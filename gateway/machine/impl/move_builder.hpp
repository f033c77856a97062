#pragma once

#include <optional>

#include "gateway/machine/impl/action.hpp"
#include "gateway/machine/impl/spindle_model.hpp"
#include "gateway/machine/machine_limits.hpp"
#include "protocol/base/result.hpp"

namespace dripline::machine::impl {

/// The program's demands on one move.
struct MoveTask {
  Path path;
  Pace pace = Pace::Rapid;
  Feed feed;    ///< Feed, FeedPerRevolution
  Length lead;  ///< Thread: along the axis that goes furthest
};

/// Why the machine refuses a move; `id` is static.
struct Refusal {
  std::string_view id;
  std::string text;
};

/// Makes moves of this machine from paths: travel limits, speeds, acceleration, and the speed of
/// the corner between one move and the next. Pure.
class MoveBuilder {
 public:
  explicit MoveBuilder(const MachineLimits& limits) : limits_(limits) {}

  /// Fills `move`, or returns why it is impossible. `path.length` must be above 0.
  std::optional<Refusal> build(const MoveTask& task, const SpindleModel& spindle, Move& move);
  /// The next move starts from standstill.
  void drop_direction() { has_direction_ = false; }

 private:
  std::optional<Refusal> check_travel(const Path& path) const;
  std::optional<Refusal> set_speed(const MoveTask& task, const SpindleModel& spindle,
                                   Move& move) const;
  void set_axis_limits(Move& move) const;
  void set_corner(Move& move);

  const MachineLimits& limits_;
  bool has_direction_ = false;  ///< of the move before:
  Coordinates direction_{};     ///< at its end, of length 1
  double acceleration_ = 0, length_ = 0;
};

}  // namespace dripline::machine::impl
