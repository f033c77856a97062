#pragma once

#include <string>

#include "gateway/machine/grbl/reply.hpp"
#include "gateway/machine/operator_panel.hpp"

namespace dripline::machine::grbl {

/// Percent, as the board's override commands reach them.
using OverridePercent = StatusReport::Overrides;

/// Brings the board's overrides to those that are wanted, and again if its reports show that bytes
/// were lost. The board has steps of 10 and 1, and a byte is a flag for it: of the same byte twice
/// before it looks, it sees one. So each step is sent alone, after the board has taken the one
/// before it, and a change never passes beyond what is wanted. Pure.
class OverrideSender {
 public:
  /// The nearest that the board has, never faster than asked. A feed under 10 % and a rapid under
  /// 25 % are 0, a hold: the board has none that is lower.
  static OperatorPanel known(OperatorPanel panel);
  /// Of `known` factors; 0 is the lowest that the board has.
  void want(const OperatorPanel& panel);
  /// The next step; empty: there is none. To be called when the board has answered a status request
  /// that was sent after the step before.
  std::string take_step();
  /// Those of the axes that are wanted are reported; a board that reports none has had the time for
  /// them.
  bool is_in_force() const {
    return move_alike(is_at_, wanted_) && (is_confirmed_ || reports_ > kMaxUnreported);
  }
  /// The same overrides of the axes are reported again and again, whatever is sent.
  bool is_refused() const { return refusals_ > kMaxRefusals; }
  /// A report was made; `now`: what it states, if it has them.
  void reported(const std::optional<OverridePercent>& now);
  /// The board was reset: its overrides are 100 %.
  void reset() { is_at_ = {}, reports_ = refusals_ = 0, is_confirmed_ = true; }

 private:
  OverridePercent wanted_, is_at_;
  static bool move_alike(const OverridePercent& one, const OverridePercent& other) {
    return one.feed == other.feed && one.rapid == other.rapid;
  }
  static constexpr int kMaxRefusals = 5, kMaxUnreported = 30;
  int reports_ = 0;   ///< since the last step
  int refusals_ = 0;  ///< reports, one after another, without the last step
  bool is_confirmed_ = true;
};

}  // namespace dripline::machine::grbl
