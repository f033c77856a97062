#pragma once

#include <vector>

namespace dripline::interpreter {

/// What the positions of a panel's switches stand for, where a control's setup has tables of them.
/// Factors: 1 is 100 %.
struct PanelTables {
  std::vector<double> feed;     ///< overrides
  std::vector<double> spindle;  ///< overrides
  /// Program time that a click of the handwheel passes, for each position of the feed switch; of
  /// positions beyond the last, its. Empty: a handwheel drives no program.
  std::vector<double> click_seconds;
};

}  // namespace dripline::interpreter
