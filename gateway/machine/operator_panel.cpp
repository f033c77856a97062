#include "gateway/machine/operator_panel.hpp"

#include <algorithm>
#include <cmath>

namespace dripline::machine {

namespace {

double within(double low, double high, double value) {
  return std::isnan(value) ? 1.0 : std::clamp(value, low, high);
}

}  // namespace

OperatorPanel OperatorPanel::clamped() const {
  OperatorPanel panel = *this;
  panel.feed_override = within(0, kMaxFeedOverride, feed_override);
  panel.rapid_override = within(0, kMaxRapidOverride, rapid_override);
  panel.spindle_override = within(0, kMaxSpindleOverride, spindle_override);
  if (!(dry_run_speed > 0)) panel.dry_run = false;
  return panel;
}

}  // namespace dripline::machine
