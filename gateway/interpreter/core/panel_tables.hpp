#pragma once

#include <vector>

namespace dripline::interpreter {

/// The override of each position of a panel's switches, where a control's setup has tables of them.
/// Factors: 1 is 100 %.
struct PanelTables {
  std::vector<double> feed;     ///< overrides
  std::vector<double> spindle;  ///< overrides
  /// The program time that a click of the handwheel passes, for each position of the feed switch;
  /// positions beyond the last one have its time. Empty: a handwheel drives no program.
  std::vector<double> click_seconds;
};

}  // namespace dripline::interpreter
