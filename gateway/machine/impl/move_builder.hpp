#pragma once

#include <optional>

#include "gateway/interpreter/core/shown_length.hpp"
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
  /// How refusals show lengths: as the program's control does.
  void show_as(const interpreter::LengthDisplay& display) { display_ = display; }
  const interpreter::LengthDisplay& display() const { return display_; }
  /// The next move starts from standstill.
  void drop_direction() { has_direction_ = false; }

 private:
  std::optional<Refusal> check_travel(const Path& path) const;
  std::optional<Refusal> set_speed(const MoveTask& task, const SpindleModel& spindle,
                                   Move& move) const;
  void set_axis_limits(Move& move) const;
  void set_corner(Move& move);

  Refusal beyond(std::size_t axis, double value, double limit) const;

  const MachineLimits& limits_;
  interpreter::LengthDisplay display_;
  bool has_direction_ = false;  ///< of the move before:
  Coordinates direction_{};     ///< at its end, of length 1
  double acceleration_ = 0, length_ = 0;
};

}  // namespace dripline::machine::impl
