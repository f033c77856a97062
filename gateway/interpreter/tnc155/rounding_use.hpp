#pragma once

#include <span>

#include "gateway/interpreter/tnc155/block.hpp"

namespace dripline::interpreter::tnc155 {

/// What is known of the radius compensation while a program is walked through in the order of its
/// text: enough to say what a plain-language RND is for.
class CompensationTrack {
 public:
  /// The next block of the program.
  void pass(const Block& block);

  /// What the RND at `blocks[at]` does, all before it having passed. Unstated: that depends on the
  /// order in which the program runs.
  RoundingUse use_of(std::span<const Block> blocks, std::size_t at) const;

 private:
  enum class State : std::uint8_t { Off, On, Unknown };
  State state_ = State::Off;
  State before_last_move_ = State::Off;
};

/// L, LP, C, CP, CT with coordinates.
bool is_path(const Block& block);
/// Where the run of a program can leave the order of its text or come from elsewhere.
bool is_flow(const Block& block);

}  // namespace dripline::interpreter::tnc155
