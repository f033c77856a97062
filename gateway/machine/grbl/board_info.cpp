#include "gateway/machine/grbl/board_info.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace dripline::machine::grbl {

using streamed::TextRules;

namespace {

constexpr std::size_t kLeastWindow = 80;  ///< a line of the longest form must fit
constexpr std::size_t kMaxWindow = 4096;

// Of the firmware, which states none of them.
constexpr double kMinFeed = 1;             ///< per minute; a lower one is raised to it
constexpr double kMaxArcRadius = 1'000;    ///< mm: of larger ones single precision moves the center
constexpr double kMaxArcTolerance = 0.01;  ///< mm ($12): coarser arcs are ours, as chords
constexpr double kArcMargin = 0.01;        ///< mm: what single precision adds to an arc
constexpr double kMaxDwell = 3'000;        ///< seconds: Grbl counts 50 ms in 16 bits

bool is_zero(const AxisValues& offset) {
  return std::all_of(offset.value.begin(), offset.value.begin() + offset.count,
                     [](double value) { return value == 0; });
}

}  // namespace

void BoardInfo::take(const Greeting& greeting) {
  version_ = greeting.version;
  is_grbl_hal_ = greeting.is_grbl_hal;
}

double BoardInfo::setting_or(int number, double otherwise) const {
  const auto found = settings_.find(number);
  return found == settings_.end() ? otherwise : found->second;
}

std::string BoardInfo::firmware() const {
  return fmt::format("{} {}", is_grbl_hal_ ? "GrblHAL" : "Grbl", version_);
}

std::size_t BoardInfo::axes() const {
  std::size_t count = 0;
  while (count < kMaxAxes && settings_.contains(100 + static_cast<int>(count))) ++count;
  return count;
}

char BoardInfo::letter(std::size_t axis) const {
  return axis < letters_.size() ? letters_[axis] : streamed::letter_of(axis);
}

std::optional<std::size_t> BoardInfo::number_of(std::size_t axis) const {
  const auto found = interpreter::axis_of(letter(axis));
  if (!found) return std::nullopt;
  return static_cast<std::size_t>(*found);
}

std::size_t BoardInfo::window() const {
  if (!build_ || build_->bytes <= 1) return 0;
  return std::min(static_cast<std::size_t>(build_->bytes) - 1, kMaxWindow);
}

std::uint32_t BoardInfo::line_numbers() const {
  constexpr std::size_t kShortestLine = 5;  // N1G0Y1 has no shorter form that moves
  constexpr std::size_t kMostBlocks = 10'000;
  const auto blocks =
      std::min(static_cast<std::size_t>(std::max(planner_blocks(), 0)), kMostBlocks);
  const std::size_t held = blocks + window() / kShortestLine + 2;
  for (const std::uint32_t numbers : {99U, 999U, 9'999U})
    if (numbers > 2 * held) return numbers;
  return 99'999;
}

std::string BoardInfo::work_system() const {
  for (const char* name : {"G54", "G55", "G56", "G57", "G58", "G59"}) {
    const auto found = offsets_.find(name);
    if (found != offsets_.end() && is_zero(found->second)) return name;
  }
  return {};
}

std::string BoardInfo::offset_beside(const std::string& work_system) const {
  for (const std::string& name : {work_system, std::string("G92"), std::string("TLO")}) {
    const auto found = offsets_.find(name);
    if (found != offsets_.end() && !is_zero(found->second)) return name;
  }
  return {};
}

std::optional<TextRules::Range> BoardInfo::travel(std::size_t axis) const {
  const double length = setting(130, axis);
  if (setting_or(20, 0) == 0 || !(length > 0)) return std::nullopt;
  // Homing makes the home position the zero where the build says so (Z), else the upper end.
  const auto homes_at_low_end = static_cast<unsigned>(setting_or(23, 0)) >> axis & 1U;
  if (has_letter('Z') && homes_at_low_end != 0) return TextRules::Range{0, length};
  return TextRules::Range{-length, 0};
}

TextRules::AxisRules BoardInfo::axis_rules(std::size_t axis) const {
  constexpr double kReported = 0.0015;  // three decimals, and the line's own rounding
  const double step = steps(axis) > 0 ? 1 / steps(axis) : 0;
  return {.steps = steps(axis),
          .max_rate = max_rate(axis),
          .tolerance = kReported * report_scale() + 0.75 * step,
          .travel = travel(axis),
          .travel_setting = fmt::format(" ($20, $23, ${})", 130 + axis),
          .rate_setting = fmt::format(" (${})", 110 + axis)};
}

/// What is reported late, a part for the planner, and the time in which the axes come from their
/// highest rate to rest: with less ahead the planner would slow them down.
double BoardInfo::seconds_ahead() const {
  constexpr double kReported = 0.75, kMax = 5;
  double braking = 0;
  for (std::size_t i = 0; i < axes(); ++i)
    if (acceleration(i) > 0) braking = std::max(braking, max_rate(i) / 60 / acceleration(i));
  return std::min(kReported + braking, kMax);
}

TextRules BoardInfo::rules() const {
  constexpr std::size_t kGrblLine = 72, kGrblHalLine = 244;  // without N word and end
  TextRules rules;
  double finest = 0;
  for (std::size_t i = 0; i < axes(); ++i) {
    if (const auto number = number_of(i)) rules.axes[*number] = axis_rules(i);
    finest = std::max(finest, steps(i));
  }
  rules.decimals = finest > 500 ? 4 : 3;  // a digit is at most half a step
  // What is rounded to the limit is at it; the board is exact.
  for (auto& axis : rules.axes)
    if (axis) axis->travel_slack = 0.49 * std::pow(10, -rules.decimals);
  rules.line_limit = is_grbl_hal_ ? kGrblHalLine : kGrblLine;
  rules.feeds_all_axes = rules.times_rotary_axes = true;
  rules.min_feed = kMinFeed;
  rules.max_arc_radius = setting_or(12, 0) > kMaxArcTolerance ? 0 : kMaxArcRadius;
  rules.arc_margin = kArcMargin;
  rules.max_dwell = kMaxDwell;
  rules.seconds_ahead = seconds_ahead();
  if (setting_or(30, 0) > 0) rules.max_rpm = setting_or(30, 0);
  if (setting_or(31, 0) > 0) rules.min_rpm = setting_or(31, 0);  // the board raises a lower speed
  rules.has_mist = has_letter('M');
  rules.has_reverse = !has_letter('D');
  rules.homes = homes();
  rules.max_rpm_setting = " ($30)";
  rules.min_rpm_setting = " ($31)";
  rules.homing_setting = " ($22)";
  return rules;
}

Coordinates BoardInfo::in_mm(const AxisValues& values) const {
  Coordinates point{};
  for (std::size_t i = 0; i < values.count; ++i) {
    const auto number = number_of(i);
    if (!number) continue;
    const bool is_rotary = interpreter::is_rotary(static_cast<interpreter::Axis>(*number));
    point[*number] = values.value[i] * (is_rotary ? 1 : report_scale());
  }
  return point;
}

/// A setting that got lost on the line must not be taken for 0: $13 is the unit of the reports.
Result<void> BoardInfo::check_settings() const {
  const auto require = [this](int number) -> Result<void> {
    if (settings_.contains(number)) return {};
    return fail(Errc::Unsupported, "the board does not state its setting ${}", number);
  };
  for (const int number : {10, 13, 20, 22, 30})
    if (auto known = require(number); !known) return known;
  for (std::size_t i = 0; i < axes(); ++i)
    for (const int first : {110, 120, 130})
      if (auto known = require(first + static_cast<int>(i)); !known) return known;
  return {};
}

Result<void> BoardInfo::check_axes() const {
  if (axes() < 2)
    return fail(Errc::Unsupported, "the board states {} axes ($100 ...), at least 2 are needed",
                axes());
  std::set<std::size_t> numbers;
  for (std::size_t i = 0; i < axes(); ++i) {
    const auto number = number_of(i);
    if (!number || !numbers.insert(*number).second)
      return fail(Errc::Unsupported, "the board's axes are {}: programs move X Y Z A B C U V W",
                  letters_);
    if (!(steps(i) > 0 && max_rate(i) > 0 && acceleration(i) > 0))
      return fail(Errc::Unsupported,
                  "axis {}: steps ${}={}, rate ${}={} and acceleration ${}={} must be above 0",
                  letter(i), 100 + i, steps(i), 110 + i, max_rate(i), 120 + i, acceleration(i));
  }
  return {};
}

Result<void> BoardInfo::check() const {
  if (!is_grbl_hal_ && !version_.starts_with("1.1"))
    return fail(Errc::Unsupported, "the firmware is Grbl {}, this back end needs 1.1 or grblHAL",
                version_);
  if (!build_) return fail(Errc::Unsupported, "the board does not state its buffers ($I, [OPT:])");
  if (window() < kLeastWindow)
    return fail(Errc::Unsupported,
                "the board's receive buffer has {} bytes, at least {} are needed", build_->bytes,
                kLeastWindow + 1);
  if (auto complete = check_settings(); !complete) return complete;
  if (auto usable = check_axes(); !usable) return usable;
  if (setting_or(32, 0) != 0)
    return fail(Errc::Unsupported, "the board is in {} mode ($32={}): a milling machine has $32=0",
                setting_or(32, 0) == 1 ? "laser" : "lathe", setting_or(32, 0));
  // Without either, no report shows what has been executed.
  if (!has_line_numbers() && (static_cast<unsigned>(setting_or(10, 0)) & 2U) == 0)
    return fail(Errc::Unsupported,
                "the board reports neither line numbers (a build option) nor its buffers: set $10 "
                "to {}",
                static_cast<unsigned>(setting_or(10, 0)) | 2U);
  if (work_system().empty())
    return fail(Errc::Conflict,
                "none of the board's work offsets G54 to G59 is zero: programs use machine "
                "coordinates, clear one (G10 L2 P6 with every axis 0)");
  return {};
}

}  // namespace dripline::machine::grbl
