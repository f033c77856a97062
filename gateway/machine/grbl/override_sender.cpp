#include "gateway/machine/grbl/override_sender.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace dripline::machine::grbl {
namespace {

struct OverrideBytes {
  char full, more_10, less_10, more_1, less_1;
};
constexpr OverrideBytes kFeed{'\x90', '\x91', '\x92', '\x93', '\x94'};
constexpr OverrideBytes kSpindle{'\x99', '\x9A', '\x9B', '\x9C', '\x9D'};

/// One byte of each kind at most. The board adds them up.
void append_step(const OverrideBytes& bytes, int& is_at, int wanted, std::string& to) {
  const int change = wanted - is_at;
  if (change == 0) return;
  if (wanted == 100) {
    to += bytes.full;
    is_at = wanted;
    return;
  }
  const int sign = change > 0 ? 1 : -1;
  if (std::abs(change) >= 10) {
    to += sign > 0 ? bytes.more_10 : bytes.less_10;
    is_at += 10 * sign;
  }
  if (change % 10 != 0) {
    to += sign > 0 ? bytes.more_1 : bytes.less_1;
    is_at += sign;
  }
}

/// The board has 100, 50 and 25 %.
double known_rapid(double factor) {
  if (factor >= 1) return 1;
  if (factor >= 0.5) return 0.5;
  return factor >= 0.25 ? 0.25 : 0;
}

int percent_of(double factor) {
  return static_cast<int>(std::clamp(std::floor(factor * 100 + 1e-6), 10.0, 200.0));
}

char rapid_byte(int percent) {
  if (percent >= 100) return '\x95';
  return percent >= 50 ? '\x96' : '\x97';
}

}  // namespace

OperatorPanel OverrideSender::known(OperatorPanel panel) {
  constexpr double kLeastFeed = 0.1;
  if (panel.feed_override < kLeastFeed) panel.feed_override = 0;
  panel.rapid_override = known_rapid(panel.rapid_override);
  return panel;
}

void OverrideSender::want(const OperatorPanel& panel) {
  wanted_ = {.feed = percent_of(panel.feed_override),
             .rapid = static_cast<int>(std::max(panel.rapid_override, 0.25) * 100),
             .spindle = percent_of(panel.spindle_override)};
}

std::string OverrideSender::take_step() {
  std::string bytes;
  append_step(kFeed, is_at_.feed, wanted_.feed, bytes);
  if (is_at_.rapid != wanted_.rapid) bytes += rapid_byte(wanted_.rapid);
  is_at_.rapid = wanted_.rapid;
  append_step(kSpindle, is_at_.spindle, wanted_.spindle, bytes);
  if (!bytes.empty()) reports_ = 0, is_confirmed_ = false;
  return bytes;
}

/// The board reports before it acts on what came with the request: its first report after a step is
/// old.
void OverrideSender::reported(const std::optional<OverridePercent>& now) {
  if (++reports_ < 2 || !now) return;
  is_confirmed_ = move_alike(*now, is_at_);
  refusals_ = is_confirmed_ ? 0 : refusals_ + 1;
  is_at_ = *now;
}

}  // namespace dripline::machine::grbl
