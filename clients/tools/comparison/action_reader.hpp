#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "clients/tools/comparison/action_recorder.hpp"
#include "clients/tools/comparison/motion_comparison.hpp"
#include "gateway/interpreter/core/retained_memory.hpp"

namespace dripline::comparison {

/// The actions of one program in order, interpreted as far as they are asked for. Stays where it
/// is: the interpretation delivers into it.
class ActionReader {
 public:
  /// `shift`: of the start from the setup's, on these axes (bit 0 is X), in millimeters or degrees.
  ActionReader(const MotionSide& side, bool across_controls, double shift = 0,
               unsigned shifted_axes = ~0U);
  ActionReader(const ActionReader&) = delete;
  ActionReader& operator=(const ActionReader&) = delete;

  /// Errors: those of `Dialect::make`.
  Result<void> begin(const MotionOptions& options);

  /// How many actions can be looked at, `count` or more unless the program is over.
  std::size_t fill(std::size_t count);
  const Action& operator[](std::size_t i) const { return queue_[i]; }
  void drop(std::size_t count);

  std::uint64_t dropped() const { return dropped_; }
  std::uint64_t blocks() const { return recorder_.blocks(); }
  /// What the comparison depends on besides program and setup; when the program is over.
  void add_conditions(bool is_second, std::vector<Condition>& conditions) const;
  /// What the control keeps when the program is over; empty where it keeps nothing.
  struct Kept {
    std::vector<interpreter::MemoryCell> cells;
    std::vector<double> values;
  };
  Kept kept();
  /// Of the last action that was dropped.
  const Place& last_place() const { return last_place_; }

 private:
  std::size_t ready() const;
  void step();

  const MotionSide& side_;
  bool across_controls_;
  interpreter::Setup setup_;
  ActionQueue queue_;
  ActionRecorder recorder_;
  std::unique_ptr<interpreter::EventSink> stage_;  ///< of the side, in front of the recorder
  std::optional<interpreter::OfflineRun> run_;
  std::optional<Condition> fault_;
  bool is_over_ = false;
  std::uint64_t dropped_ = 0;
  Place last_place_;
};

}  // namespace dripline::comparison
