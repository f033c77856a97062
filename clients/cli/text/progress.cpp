#include "clients/cli/text/progress.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <chrono>
#include <cmath>

#include "clients/cli/text/terminal.hpp"
#include "clients/cli/text/value_text.hpp"

namespace dripline::cli {
namespace {

constexpr std::size_t kBarCells = 24;
constexpr auto kRedraw = std::chrono::milliseconds(100);
constexpr double kRateIsKnownAfter = 0.5;  ///< seconds; earlier rates mislead

double seconds_of(SteadyTime::duration duration) {
  return std::chrono::duration<double>(duration).count();
}

/// Rate and the time that is left, once they are known.
std::string rate_text(const ProgressView& view) {
  if (view.seconds < kRateIsKnownAfter || view.done == 0) return {};
  const double rate = static_cast<double>(view.done) / view.seconds;
  const double left = static_cast<double>(view.total - view.done) / rate;
  return fmt::format("  {}/s  {} left", bytes_text(static_cast<std::uint64_t>(rate)),
                     duration_text(std::ceil(left)));
}

}  // namespace

std::string render_bar(double fraction, std::size_t cells) {
  const double clamped = std::clamp(fraction, 0.0, 1.0);
  const auto full = static_cast<std::size_t>(clamped * static_cast<double>(cells));
  return "[" + std::string(full, '#') + std::string(cells - full, '.') + "]";
}

std::string render_progress(const ProgressView& view, std::size_t width) {
  const std::uint64_t done = std::min(view.done, view.total);
  const double fraction =
      view.total == 0 ? 1.0 : static_cast<double>(done) / static_cast<double>(view.total);
  const std::string line =
      fmt::format("{} {} {:3} %  {} of {}{}", view.label, render_bar(fraction, kBarCells),
                  static_cast<int>(fraction * 100), bytes_text(done), bytes_text(view.total),
                  rate_text({view.label, done, view.total, view.seconds}));
  return cut(line, width);
}

Progress::Progress(LiveArea& area, const Clock& clock, std::string label)
    : area_(area), clock_(clock), label_(std::move(label)), begun_(clock.steady_now()) {}

void Progress::update(std::uint64_t done, std::uint64_t total) {
  if (!area_.is_live()) return;
  const SteadyTime now = clock_.steady_now();
  if (drawn_ && now - *drawn_ < kRedraw) return;
  drawn_ = now;
  area_.show({render_progress({label_, done, total, seconds_of(now - begun_)}, area_.width())});
}

}  // namespace dripline::cli
