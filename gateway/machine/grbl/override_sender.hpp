#pragma once

#include <string>

#include "gateway/machine/grbl/reply.hpp"
#include "gateway/machine/operator_panel.hpp"

namespace dripline::machine::grbl {

/// Percent, as the board's override commands reach them.
using OverridePercent = StatusReport::Overrides;

/// Brings the board's overrides to those that are wanted, and again if its reports show that bytes
/// were lost. The board knows steps of 10 and 1 around 100 %. Pure.
class OverrideSender {
 public:
  /// The nearest that the board has, never faster than asked. A feed under 10 % and a rapid under
  /// 25 % are 0, a hold: the board has none that is lower.
  static OperatorPanel known(OperatorPanel panel);
  /// Of `known` factors; 0 is the lowest that the board has.
  void want(const OperatorPanel& panel);
  /// The bytes that are still to be sent; empty: none.
  std::string take_bytes();
  void reported(const OverridePercent& now);
  /// The board was reset: its overrides are 100 %.
  void reset() { sent_ = {}, waits_ = 0; }
  const OverridePercent& sent() const { return sent_; }

 private:
  OverridePercent wanted_, sent_;
  int waits_ = 0;  ///< reports in a row that differ from what was sent
};

}  // namespace dripline::machine::grbl
