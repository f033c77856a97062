#include "clients/cli/offline/touch_setup.hpp"

#include <fmt/format.h>
#include <cmath>
#include <cstdlib>

#include "clients/cli/port/port_file.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/control_version.hpp"

namespace dripline::cli {
namespace {

namespace tnc = interpreter::tnc155;
using interpreter::Axis;
using interpreter::is_rotary;
using interpreter::Units;

constexpr std::size_t kMaxTouchSetup = 1024 * 1024;
constexpr const char* kTouchesKey = "basic_rotation_touches";

double millimeters(Units units) {
  return units == Units::Inch ? Length::kMillimetersPerInch : 1;
}

/// Without the noise of the last digits.
std::string number(double value) {
  constexpr double kSteps = 1e6;
  const double rounded = std::round(value * kSteps) / kSteps;
  return fmt::format("{}", rounded == 0 ? 0.0 : rounded);
}

/// The first line of what goes into a setup: what its numbers mean.
std::string units_line(const TouchSetup& setup) {
  return fmt::format("units = \"{}\"\n\n", setup.units == Units::Inch ? "in" : "mm");
}

Result<Axis> read_fourth_axis(const interpreter::Options& options) {
  constexpr std::string_view kFourth = "ABCUVW";
  const auto fourth = options.choice("fourth_axis", {"A", "B", "C", "U", "V", "W"}, 2);
  if (!fourth) return fail(fourth.error());
  return *interpreter::axis_of(kFourth[*fourth]);
}

Result<void> read_rotation_touches(const interpreter::Options& options, TouchSetup& setup) {
  const auto* found = options.find(kTouchesKey);
  if (found == nullptr) return {};
  const auto wrong = [&] {
    return fail(Errc::Syntax, "option {}, line {}: expected a list of two touches, as \"{}\"",
                kTouchesKey, found->line, "Y+:10,20,-5");
  };
  const auto* list = std::get_if<interpreter::OptionList>(&found->value);
  if (list != nullptr && list->empty()) return {};
  if (list == nullptr || list->size() != 2) return wrong();
  for (const auto& entry : *list) {
    const auto* text = std::get_if<std::string>(&entry.value);
    if (text == nullptr) return wrong();
    const auto touch = parse_touch(*text, {setup.fourth_axis, millimeters(setup.units)});
    if (!touch) {
      return fail(Errc::Syntax, "option {}, line {}: {}", kTouchesKey, entry.line,
                  touch.error().what);
    }
    setup.rotation_touches.push_back(*touch);
  }
  return {};
}

Result<TouchSetup> read_setup_text(std::string_view text) {
  const auto read = interpreter::parse_setup(text);
  if (!read) return fail(read.error());
  const auto version = tnc::version_of(read->control);
  if (!version) return fail(version.error());
  if (!version->has(tnc::Feature::TouchProbe)) {
    return fail(Errc::Unsupported, "{}", version->lacks(tnc::Feature::TouchProbe));
  }
  TouchSetup setup;
  setup.workpiece = read->workpiece;
  setup.units = read->units.value_or(Units::Millimeter);
  for (const auto& offset : read->offsets) {
    if (offset.name != "datum") continue;
    setup.datum = offset.value;
    for (const Axis axis : interpreter::kAllAxes) {
      setup.frame.datum[static_cast<std::size_t>(axis)] = offset.value.raw(axis);
    }
  }
  const auto rotation = read->control.number("basic_rotation", 0);
  if (!rotation) return fail(rotation.error());
  setup.frame.basic_rotation = *rotation;
  const auto fourth = read_fourth_axis(read->control);
  if (!fourth) return fail(fourth.error());
  setup.fourth_axis = *fourth;
  if (auto done = read_rotation_touches(read->control, setup); !done) return fail(done.error());
  return setup;
}

std::string touch_text(const tnc_probing::Touch& touch, const TouchSetup& setup) {
  const double unit = millimeters(setup.units);
  return fmt::format("{}{}:{},{},{}", letter(touch.axis),
                     touch.direction == tnc::ProbeDirection::Positive ? '+' : '-',
                     number(touch.from.raw(Axis::X) / unit), number(touch.from.raw(Axis::Y) / unit),
                     number(touch.from.raw(Axis::Z) / unit));
}

}  // namespace

Result<TouchSetup> read_touch_setup(const std::string& path) {
  const auto text = read_small_file(path, kMaxTouchSetup);
  if (!text) return fail(text.error());
  auto setup = read_setup_text(*text);
  if (!setup) return fail(setup.error().code, "{}: {}", path, setup.error().what);
  return setup;
}

Result<tnc_probing::Touch> parse_touch(const std::string& text, const TouchForm& form) {
  const auto wrong = [&](std::string_view why) {
    return fail(Errc::Syntax, "touch \"{}\": {}expected axis, direction and start, as X+:10,20,-5",
                text, why);
  };
  if (text.size() < 4 || text[2] != ':') return wrong("");
  const auto axis = interpreter::axis_of(text[0]);
  if (!axis || (text[1] != '+' && text[1] != '-')) return wrong("");
  if (*axis > Axis::Z && *axis != form.fourth_axis) {
    return wrong(fmt::format("the fourth axis is {}; ", letter(form.fourth_axis)));
  }
  tnc_probing::Touch touch;
  touch.axis = *axis;
  touch.direction = text[1] == '+' ? tnc::ProbeDirection::Positive : tnc::ProbeDirection::Negative;
  const char* at = text.c_str() + 3;
  for (const Axis each : {Axis::X, Axis::Y, Axis::Z, form.fourth_axis}) {
    char* end = nullptr;
    const double value = std::strtod(at, &end);
    if (end == at || !std::isfinite(value)) return wrong("");
    touch.from.set_raw(each, value * (is_rotary(each) ? 1 : form.millimeters));
    const bool is_end = *end == '\0' && each >= Axis::Z;
    if (is_end) return touch;
    if (*end != ',') return wrong("");
    at = end + 1;
  }
  return wrong("");
}

std::string datum_toml(const TouchSetup& setup, const tnc::Transformation::Values& datum,
                       std::span<const tnc_probing::NamedCoordinate> named) {
  std::string text = units_line(setup) + "[[offset]]\nname = \"datum\"\n";
  for (const Axis axis : interpreter::kAllAxes) {
    const std::size_t i = static_cast<std::size_t>(axis);
    bool is_there = setup.datum.has(axis) || number(datum[i]) != number(setup.frame.datum[i]);
    for (const auto& one : named) is_there |= one.axis == axis;
    if (!is_there) continue;
    const double unit = is_rotary(axis) ? 1 : millimeters(setup.units);
    text += fmt::format("{} = {}\n", letter(axis), number(datum[i] / unit));
  }
  return text;
}

std::string rotation_toml(const TouchSetup& setup, double degrees,
                          std::span<const tnc_probing::Touch> touched) {
  std::string text =
      units_line(setup) + fmt::format("[control]\nbasic_rotation = {}\n", number(degrees));
  std::string touches;
  for (const tnc_probing::Touch& touch : touched) {
    touches += fmt::format("{}\"{}\"", touches.empty() ? "" : ", ", touch_text(touch, setup));
  }
  return text + fmt::format("{} = [{}]\n", kTouchesKey, touches);
}

}  // namespace dripline::cli
