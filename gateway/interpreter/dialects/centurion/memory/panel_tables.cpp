#include "gateway/interpreter/dialects/centurion/memory/panel_tables.hpp"

#include "gateway/interpreter/core/option.hpp"

namespace dripline::interpreter::centurion {
namespace {

constexpr std::size_t kPositions = 16;
constexpr double kPulsesOfTurn = 400;
constexpr double kUsualCranking = 0.001;  // minutes

/// One entry for each position of a switch, from 0 to `last_position`.
Result<std::vector<std::int64_t>> read_table(const Options& options, std::string_view name,
                                             std::int64_t last_position,
                                             std::vector<std::int64_t> usual) {
  auto values = options.integers(name);
  if (!values) return fail(values.error());
  if (values->empty()) return usual;
  if (values->size() > kPositions) {
    return fail(Errc::LimitExceeded, "[control] {}: {} entries, the switch has {} positions", name,
                values->size(), kPositions);
  }
  for (const std::int64_t value : *values) {
    if (value >= 0 && value <= last_position) continue;
    return fail(Errc::LimitExceeded, "[control] {}: {} is not 0 to {}", name, value, last_position);
  }
  return *std::move(values);
}

/// 0, `step`, twice `step` ... up to `last`.
std::vector<std::int64_t> steps(std::int64_t step, std::int64_t last) {
  std::vector<std::int64_t> values;
  for (std::int64_t value = 0; value <= last; value += step) values.push_back(value);
  return values;
}

std::vector<double> scaled(const std::vector<std::int64_t>& values, double factor) {
  std::vector<double> made;
  made.reserve(values.size());
  for (const std::int64_t value : values) made.push_back(static_cast<double>(value) * factor);
  return made;
}

}  // namespace

Result<PanelTables> read_panel_tables(const Setup& setup) {
  constexpr double kPercent = 0.01;
  const Options& options = setup.control;
  auto spindle_steps = steps(10, 130);
  spindle_steps.push_back(175);
  const auto feed = read_table(options, "feed_overrides", 199, steps(10, 150));
  const auto spindle = read_table(options, "spindle_overrides", 255, std::move(spindle_steps));
  const auto pulses = read_table(options, "handwheel_pulses", 255, steps(1, 15));
  for (const auto* table : {&feed, &spindle, &pulses}) {
    if (!*table) return fail(table->error());
  }
  const auto minutes = options.number("cranking_minutes", kUsualCranking);
  if (!minutes) return fail(minutes.error());
  if (!(*minutes > 0 && *minutes <= 1)) {
    return fail(Errc::LimitExceeded, "[control] cranking_minutes: {} is not above 0 and up to 1",
                *minutes);
  }
  return PanelTables{.feed = scaled(*feed, kPercent),
                     .spindle = scaled(*spindle, kPercent),
                     .click_seconds = scaled(*pulses, *minutes * 60 / kPulsesOfTurn)};
}

}  // namespace dripline::interpreter::centurion
