#pragma once

#include <optional>
#include <span>

#include "gateway/interpreter/dialects/tnc155/reading/block.hpp"

namespace dripline::tnc_conversion {

using interpreter::Axis;
using interpreter::tnc155::Block;
using interpreter::tnc155::RoundingUse;

/// Tracks the radius compensation in the order of the text, as far as it is known, to determine the
/// purpose of a plain-language RND.
class CompensationTrack {
 public:
  /// Of a program with these blocks.
  explicit CompensationTrack(std::span<const Block> blocks);

  /// The next block of the program.
  void pass(const Block& block);

  /// What the RND at `blocks[at]` does, all before it having passed. Unstated: that depends on the
  /// order in which the program runs.
  RoundingUse use_of(std::span<const Block> blocks, std::size_t at) const;

 private:
  enum class Answer : std::uint8_t { No, Yes, Unknown };

  void end();
  void open();
  bool may_run_program(const Block& block) const;
  void pass_move(const Block& block);
  Answer names_plane(const Block& block) const;

  Answer is_on_ = Answer::No;     ///< RL or RR is in force
  Answer is_begun_ = Answer::No;  ///< since then no block has named a coordinate of the plane
  Answer is_first_ = Answer::No;  ///< the last block was the first one to do so
  bool is_never_on_ = false;      ///< no block of the program or of one it calls switches it on
  bool calls_programs_ = false;   ///< a cycle was defined that is a program
  bool is_modal_call_ = false;    ///< M89
  std::optional<Axis> normal_ = Axis::Z;  ///< of the plane; none: axis IV, whichever that is
};

/// L, LP, C, CP, CT with coordinates.
bool is_path(const Block& block);
/// Where the run of a program can leave the order of its text or come from elsewhere.
bool is_flow(const Block& block);

}  // namespace dripline::tnc_conversion
