#include "gateway/interpreter/core/dialects.hpp"
#include "gateway/interpreter/dialects/tektronix1704/options.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "gateway/interpreter/dialects/tektronix1704/interpreter.hpp"
#include "gateway/interpreter/dialects/tektronix1704/planning_sheet.hpp"

namespace dripline::interpreter {
namespace {

using namespace tektronix1704;

Result<std::unique_ptr<Interpreter>> make(const Setup& setup, ProgramSource& source,
                                          EventSink& sink) {
  auto options = read_options(setup);
  if (!options) return fail(options.error());
  return std::unique_ptr<Interpreter>(
      std::make_unique<TektronixInterpreter>(std::move(*options), source, sink));
}

/// A tape of this control begins with the rewind stop code and has blocks of whole counts: no
/// decimal point, no letter of another control, six digits in a coordinate.
int likelihood(std::string_view head, std::string_view file_name) {
  if (file_name.ends_with(".tap1704")) return 100;
  const std::size_t first = head.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos || head[first] != '%') return 0;
  bool has_coordinate = false;
  std::size_t digits = 0;
  for (const char c : head.substr(first + 1)) {
    const bool is_digit = c >= '0' && c <= '9';
    digits = is_digit ? digits + 1 : 0;
    has_coordinate |= digits >= 5;
    const bool is_ours = is_digit || kLetters.find(c) != std::string_view::npos || c == '+' ||
                         c == '-' || c == ' ' || c == '\t' || c == '\r' || c == '\n';
    if (!is_ours) return 0;
  }
  return has_coordinate ? 70 : 20;
}

ScreenSettings screen(const Setup& setup) {
  const auto options = read_options(setup);
  ScreenSettings shown;
  if (!options) return shown;
  shown.units = options->is_metric() ? Units::Millimeter : Units::Inch;
  shown.axes.emplace();
  for (std::size_t axis = 0; axis < options->axes; ++axis) shown.axes->set(axis);
  return shown;
}

constexpr std::array kStatusFields{status_field::kIncremental};

}  // namespace

/// G20 and G30 are arcs, G50 is rapid traverse.
constexpr int kMotionCodes[] = {200, 300, 500};

const Dialect kTektronix1704Dialect{.name = "tektronix-1704",
                                    .title = "Tektronix 1704 contouring control (punched tape)",
                                    .likelihood = likelihood,
                                    .make = make,
                                    .units = Units::Inch,
                                    .machine = MachineKind::Mill,
                                    .feed_override_switch = {0.125, 1.25, Length::inch(200)},
                                    .switches = {.block_skip = false},
                                    .mdi_blocks = 1,
                                    // Without a changer M06 is an M00 with a lamp.
                                    .waits_at_tool_change = true,
                                    .list = planning_sheet,
                                    .options = list_options,
                                    .text = {.motion_codes = kMotionCodes},
                                    .status_fields = kStatusFields,
                                    .screen = screen};

}  // namespace dripline::interpreter
