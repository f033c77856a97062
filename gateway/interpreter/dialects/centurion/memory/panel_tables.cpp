#include "gateway/interpreter/dialects/centurion/memory/panel_tables.hpp"

#include <cmath>
#include <cstring>
#include <type_traits>

#include "gateway/interpreter/core/option.hpp"
#include "gateway/interpreter/core/retained_memory.hpp"
#include "gateway/interpreter/dialects/centurion/interpreter.hpp"

namespace dripline::interpreter::centurion {

namespace {

constexpr std::size_t kPositions = 16;
constexpr double kPulsesOfTurn = 400;
constexpr double kUsualCranking = 0.001;  // minutes
constexpr double kUsualDryRun = 75;       // inches per minute

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
  const auto dry_feed = options.length("dry_run_feed", Length::inch(kUsualDryRun));
  const auto dry_spindle = options.flag("dry_run_spindle", false);
  if (!dry_feed) return fail(dry_feed.error());
  if (!dry_spindle) return fail(dry_spindle.error());
  return PanelTables{.feed = scaled(*feed, kPercent),
                     .spindle = scaled(*spindle, kPercent),
                     .click_seconds = scaled(*pulses, *minutes * 60 / kPulsesOfTurn),
                     .dry_run = PanelTables::DryRun{*dry_feed, *dry_spindle}};
}

// What the control keeps when a program has ended and when it is switched off: P0 to P99, what
// only data mode writes (work offsets, tools, axes), and PB0 to PB639 (manual: work offsets; SAVE
// and LOAD of parameters). The data of cycles and transformations between them begin as at
// power-on.

namespace {

static_assert(std::is_trivially_copyable_v<Parameters>);
static_assert(sizeof(Parameters) == kParameterCount * sizeof(double) + kByteCount);

template <class Visit>
void for_each_cell(const Parameters& parameters, Visit visit) {
  for (int number = 0; number < kParameterCount; ++number) {
    const bool is_kept = number < kUserParameters || number >= kFirstDataParameter;
    if (is_kept) visit(CellName{"P", number}, parameters[number]);
  }
  for (int number = 0; number < kByteCount; ++number) {
    visit(CellName{"PB", number}, parameters.byte(number));
  }
}

/// A number that was converted there and back has lost its last digits.
double without_noise(double value) {
  constexpr int kDigits = 14;
  if (value == 0 || !std::isfinite(value)) return value;
  const double scale =
      std::pow(10.0, kDigits - 1 - static_cast<int>(std::floor(std::log10(std::fabs(value)))));
  return std::isfinite(scale) ? std::round(value * scale) / scale : value;
}

}  // namespace

std::vector<MemoryCell> CenturionInterpreter::memory_cells() const {
  return cells_of([this](auto visit) { for_each_cell(run_.parameters, visit); });
}

/// Tables that G20 or G21 has converted are shown in the unit they began with.
bool CenturionInterpreter::read_memory(std::vector<double>& values) {
  const bool is_known =
      !values.empty() &&
      // NOLINTNEXTLINE(bugprone-suspicious-memory-comparison): it has no padding (parameters.hpp)
      std::memcmp(&known_memory_, &run_.parameters, sizeof known_memory_) == 0;
  if (is_known) return false;
  known_memory_ = run_.parameters;
  Parameters shown = known_memory_;
  if (run_.state.units != memory_units_) {
    const bool is_inch = memory_units_ == Units::Inch;
    shown.convert_tables(is_inch ? 1 / Length::kMillimetersPerInch : Length::kMillimetersPerInch);
    for (int number = kFirstDataParameter; number < kParameterCount; ++number)
      shown[number] = without_noise(shown[number]);
  }
  read_cells(values, [&](auto visit) { for_each_cell(shown, visit); });
  return true;
}

}  // namespace dripline::interpreter::centurion
