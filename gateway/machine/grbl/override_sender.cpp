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

void append(const OverrideBytes& bytes, int percent, std::string& to) {
  to += bytes.full;
  const int change = percent - 100;
  const auto tens = static_cast<std::size_t>(std::abs(change) / 10);
  const auto ones = static_cast<std::size_t>(std::abs(change) % 10);
  to.append(tens, change > 0 ? bytes.more_10 : bytes.less_10);
  to.append(ones, change > 0 ? bytes.more_1 : bytes.less_1);
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

std::string OverrideSender::take_bytes() {
  std::string bytes;
  if (sent_ == wanted_) return bytes;
  if (sent_.feed != wanted_.feed) append(kFeed, wanted_.feed, bytes);
  if (sent_.rapid != wanted_.rapid) bytes += rapid_byte(wanted_.rapid);
  if (sent_.spindle != wanted_.spindle) append(kSpindle, wanted_.spindle, bytes);
  sent_ = wanted_;
  waits_ = 0;
  return bytes;
}

void OverrideSender::reported(const OverridePercent& now) {
  constexpr int kPatience = 3;
  // A report that was made before our bytes arrived is no difference.
  if (now != sent_ && ++waits_ < kPatience) return;
  waits_ = 0;
  sent_ = now;
}

}  // namespace dripline::machine::grbl
