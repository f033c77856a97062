#include "gateway/app/memory/position_setter.hpp"

#include <algorithm>
#include <cmath>

#include "gateway/app/memory/position_change.hpp"
#include "gateway/app/run/run_texts.hpp"
#include "gateway/interpreter/core/program_source.hpp"

namespace dripline::gateway {

using interpreter::Axis;
using interpreter::CoordinateFrame;
using interpreter::PositionRules;
using interpreter::PositionSetting;

namespace {

constexpr double kSmallest = 1e-6;  ///< mm or degrees

bool is_off(double value) {
  return std::fabs(value) <= kSmallest;
}

/// What lies between the machine and the datum besides it; empty: nothing.
std::string obstacle(const std::optional<CoordinateFrame>& frame) {
  if (!frame) return {};
  const auto& shift = frame->shift;
  if (!std::all_of(shift.begin(), shift.end(), is_off)) return "a shift (G52, G92, cycle 7, G50)";
  if (!is_off(frame->rotation)) return "a rotation";
  if (!is_off(frame->basic_rotation)) return "a basic rotation";
  const auto is_one = [](double scale) { return is_off(scale - 1); };
  if (!std::all_of(frame->scale.begin(), frame->scale.end(), is_one)) return "a scaling";
  const auto& mirrored = frame->mirrored;
  if (std::any_of(mirrored.begin(), mirrored.end(), [](bool on) { return on; }))
    return "a mirror image";
  return {};
}

/// Of a setup: what a program begins with besides its datum, where the control reports no frame.
std::string obstacle(const interpreter::Setup& setup) {
  for (const auto& offset : setup.offsets) {
    if (offset.name != "G50" && offset.name != "G52" && offset.name != "G92") continue;
    for (const Axis axis : interpreter::kAllAxes)
      if (!is_off(offset.value.raw(axis))) return "a shift (" + offset.name + ")";
  }
  return {};
}

bool is_equal(double a, double b) {
  return std::fabs(a - b) <= 1e-9 * std::max({1.0, std::fabs(a), std::fabs(b)});
}

}  // namespace

/// A control with this setup, before its first block.
struct PositionSetter::Control {
  std::unique_ptr<interpreter::MemorySource> text = std::make_unique<interpreter::MemorySource>("");
  std::unique_ptr<interpreter::EventSink> events = std::make_unique<interpreter::EventSink>();
  std::unique_ptr<interpreter::Interpreter> interpreter;
  interpreter::RetainedMemory* memory = nullptr;  ///< null: its control keeps nothing
  std::vector<double> numbers;
};

Result<interpreter::Setup> PositionSetter::setup_of(const std::string& text) const {
  interpreter::Setup setup = parts_.setup;
  if (!text.empty()) {
    auto data = interpreter::parse_control_data(text, parts_.dialect.units);
    if (!data) return fail(data.error().code, "the server's setup: {}", data.error().what);
    interpreter::use_control_data(*std::move(data), setup);
  }
  setup.start = parts_.machine.status().position;
  setup.start.unmark_all();
  return setup;
}

Result<PositionSetter::Control> PositionSetter::make_control(
    const interpreter::Setup& setup) const {
  Control control;
  auto made = parts_.dialect.make(setup, *control.text, *control.events);
  if (!made) return fail(made.error().code, "setup: {}", made.error().what);
  control.interpreter = *std::move(made);
  control.memory = dynamic_cast<interpreter::RetainedMemory*>(control.interpreter.get());
  if (control.memory != nullptr) (void)control.memory->read_memory(control.numbers);
  return control;
}

Result<PositionSetter::Control> PositionSetter::control_with(
    const interpreter::Setup& setup) const {
  auto control = make_control(setup);
  if (control && control->memory == nullptr)
    return fail(Errc::Unsupported, "control {} keeps no datum and no tools", parts_.dialect.name);
  return control;
}

/// As at the start of a program: what is kept wins, except over what was changed in the setup.
Result<std::vector<interpreter::VariableRecord>> PositionSetter::begin_memory(
    ControlMemory& memory, const interpreter::Setup& setup) const {
  const auto control = control_with(setup);
  if (!control) return fail(control.error());
  return memory.begin(control->memory->memory_cells(), control->numbers, setup);
}

Result<void> PositionSetter::check_rest() const {
  const machine::MotionBackend& machine = parts_.machine;
  if (machine.is_moving()) return fail(Errc::Busy, "the axes move");
  if (auto ready = machine.check_begin(machine.status().axes()); !ready)
    return fail(ready.error().code, "the position is not known for certain: {}",
                ready.error().what);
  return {};
}

/// The machine may have axes that its control has not.
Result<void> PositionSetter::check_axis(Axis axis, const interpreter::Setup& setup) const {
  auto axes = parts_.machine.capabilities().axes;
  const auto of_control =
      parts_.dialect.screen ? parts_.dialect.screen(setup).axes : std::optional(axes);
  if (of_control) axes &= *of_control;
  if (axes[static_cast<std::size_t>(axis)]) return {};
  return fail(Errc::Unsupported, "this machine has no axis {}", interpreter::letter(axis));
}

Result<void> PositionSetter::check_frames(const Control& control, const interpreter::Setup& setup,
                                          std::size_t kept) const {
  std::string what = obstacle(control.interpreter->frame());
  if (what.empty()) what = obstacle(setup);
  if (!what.empty()) {
    interpreter::Setup alone = setup;
    alone.variables.resize(alone.variables.size() - kept);
    const auto control_alone = control_with(alone);
    const bool is_of_setup = !obstacle(setup).empty() || !control_alone ||
                             !obstacle(control_alone->interpreter->frame()).empty();
    return fail(Errc::Conflict, "{} is in force at power on: {} first", what,
                is_of_setup
                    ? "take it out of the setup"
                    : "the control's memory has kept it, cancel it (by MDI, or by a program)");
  }
  what = obstacle(parts_.run.frame_left);
  if (what.empty() && parts_.run.was_shifted)
    what = "a shift (G50, G52), a mirror image, a scaling or a rotation";
  if (!what.empty()) {
    return fail(Errc::Conflict,
                "{} is in force since the last program: cancel it first (by MDI, or by a program)",
                what);
  }
  return {};
}

/// A device that is moved by a program's coordinates does not move by lengths: a control that has
/// them in its memory would be right, and the machine's next motion would not.
Result<void> PositionSetter::check_tool(Axis axis, Sets what) const {
  const bool is_lathe = parts_.dialect.machine == interpreter::MachineKind::Lathe;
  if (!moves_with_lengths()) {
    if (what == Sets::Datum) return {};
    return fail(Errc::Unsupported,
                "this machine moves by coordinates in which no tool of this control has a length: "
                "one that is set would not be in its motion. Set the datum with each tool instead");
  }
  const ToolInPosition& tool = parts_.run.tool;
  const std::string why =
      what == Sets::Length ? tool.length_fault(axis) : tool.datum_fault(axis, is_lathe);
  if (!why.empty()) return fail(Errc::Conflict, "{}", why);
  return {};
}

bool PositionSetter::moves_with_lengths() const {
  const machine::MotionCapabilities& machine = parts_.machine.capabilities();
  return machine.tool_lengths && (!machine.adds_lengths || parts_.dialect.moves_with_length);
}

interpreter::RestingPlace PositionSetter::place(const interpreter::Setup& setup) const {
  interpreter::RestingPlace place;
  const interpreter::Position at = parts_.machine.status().position;
  for (const Axis axis : interpreter::kAllAxes)
    place.at[static_cast<std::size_t>(axis)] = at.raw(axis);
  place.has_lengths = moves_with_lengths();
  if (place.has_lengths) place.length = parts_.run.tool.left_out;
  place.memory = setup.units.value_or(parts_.dialect.units);
  return place;
}

namespace {

/// Whether the control's screen has this function.
Result<void> check_function(const PositionRules& rules, const PositionSetting& setting,
                            std::string_view control) {
  const bool is_tool = setting.tool > 0;
  const std::string_view axes = is_tool ? rules.tool_axes : rules.datum_axes;
  const char letter = interpreter::letter(setting.axis);
  if (axes.empty()) {
    return fail(Errc::Unsupported, "control {} sets no {} from the position", control,
                is_tool ? "length of a tool" : "datum");
  }
  if (axes.find(letter) == std::string_view::npos) {
    return fail(Errc::Unsupported, "control {} sets {} from the position along {} alone, not {}",
                control, is_tool ? "lengths of tools" : "datums", axes, letter);
  }
  if (!is_tool && rules.is_zero_only && setting.value != 0) {
    return fail(Errc::Unsupported, "control {} sets the zero of an offset here: the value is 0",
                control);
  }
  return {};
}

}  // namespace

Result<PositionChange> PositionSetter::set(const std::string& argument, const std::string& who,
                                           const std::string& server_setup) {
  const auto setting = interpreter::parse_position_setting(argument);
  if (!setting) return fail(setting.error());
  const PositionRules& rules = interpreter::position_rules(parts_.dialect.name);
  if (auto has = check_function(rules, *setting, parts_.dialect.name); !has)
    return fail(has.error());
  auto setup = setup_of(server_setup);
  if (!setup) return fail(setup.error());
  if (auto has = check_axis(setting->axis, *setup); !has) return fail(has.error());
  if (auto rests = check_rest(); !rests) return fail(rests.error());
  const bool is_diameter =
      setting->axis == Axis::X && parts_.dialect.machine == interpreter::MachineKind::Lathe;
  // The value is a diameter to all who ask; a control where it is not would take half of it.
  if (is_diameter && !setup->control.flag("x_is_diameter", true).value_or(true)) {
    return fail(Errc::Unsupported,
                "X of this control is a radius ([control] x_is_diameter): set it by MDI (G10)");
  }
  const Sets what = setting->tool > 0 ? Sets::Length : Sets::Datum;
  if (auto known = check_tool(setting->axis, what); !known) return fail(known.error());
  const interpreter::RestingPlace place = this->place(*setup);

  const auto kept = begin_memory(parts_.memory, *setup);
  if (!kept) return fail(kept.error());
  setup->variables.insert(setup->variables.end(), kept->begin(), kept->end());
  const auto present = control_with(*setup);
  if (!present) return fail(present.error());
  if (auto is_plain = check_frames(*present, *setup, kept->size()); !is_plain)
    return fail(is_plain.error());
  const interpreter::ReadCell read = [&](const std::string& name) -> std::optional<double> {
    const auto at = parts_.memory.place_of(name);
    return at ? std::optional(present->numbers.at(*at)) : std::nullopt;
  };
  const auto changes = rules.changes(*setting, place, read);
  if (!changes) return fail(changes.error());

  // The control itself is asked whether it takes the numbers, and what the position is then.
  for (const auto& change : *changes) setup->variables.push_back({change.name, change.value});
  const auto then = control_with(*setup);
  if (!then) return fail(then.error());
  for (const auto& change : *changes) {
    const auto at = parts_.memory.place_of(change.name);
    if (!at || !is_equal(then->numbers.at(*at), change.value))
      return fail(Errc::Unsupported, "the control does not take {} for {}", change.value,
                  change.name);
  }
  const std::size_t axis = static_cast<std::size_t>(setting->axis);
  const auto frame = then->interpreter->frame();
  const bool is_in_force =
      setting->offset.empty() || work_system_text(then->interpreter->modes()) == setting->offset;
  if (setting->tool == 0 && frame && is_in_force) {
    const double shown = frame->to_program(place.at)[axis] * (is_diameter ? 2 : 1);
    if (!is_off(shown - setting->canonical())) {
      return fail(Errc::Conflict,
                  "{} would be {:.4f} then, not {:.4f}: something in the setup prevents it",
                  interpreter::letter(setting->axis), shown, setting->canonical());
    }
  }
  for (const auto& change : *changes)
    parts_.memory.note(*parts_.memory.place_of(change.name), change.value);
  return shown_change({.setting = *setting,
                       .place = place,
                       .changes = *changes,
                       .before = read,
                       .is_diameter = is_diameter,
                       .who = who});
}

/// Limits are looked up as a program finds them: by the setup, and by what the memory keeps.
Result<void> PositionSetter::check_jog(Axis axis, double distance,
                                       const std::string& server_setup) const {
  auto setup = setup_of(server_setup);
  if (!setup) return fail(setup.error());
  if (auto has = check_axis(axis, *setup); !has) return has;
  if (auto rests = check_rest(); !rests) return rests;
  const auto control = control_at_start(*setup);
  if (!control) return fail(control.error());
  const interpreter::Position from = setup->start;
  interpreter::Position to = from;
  to.set_raw(axis, from.raw(axis) + distance);
  const std::string fault = control->interpreter->travel_fault(from, to);
  if (!fault.empty()) return fail(Errc::LimitExceeded, "{}", fault);
  return {};
}

Result<PositionSetter::Control> PositionSetter::control_at_start(interpreter::Setup& setup) const {
  auto control = make_control(setup);
  if (!control || control->memory == nullptr) return control;
  ControlMemory memory = parts_.memory;  // which this does not change
  const auto kept = memory.begin(control->memory->memory_cells(), control->numbers, setup);
  if (!kept) return fail(kept.error());
  setup.variables.insert(setup.variables.end(), kept->begin(), kept->end());
  return make_control(setup);
}

std::optional<CoordinateFrame> PositionSetter::frame_at_start(
    const std::string& server_setup) const {
  auto setup = setup_of(server_setup);
  if (!setup) return std::nullopt;
  const auto control = control_at_start(*setup);
  return control ? control->interpreter->frame() : std::nullopt;
}

Result<ControlMemory> PositionSetter::memory_at_start(const std::string& server_setup) const {
  const auto setup = setup_of(server_setup);
  if (!setup) return fail(setup.error());
  ControlMemory memory = parts_.memory;
  if (const auto kept = begin_memory(memory, *setup); !kept) return fail(kept.error());
  return memory;
}

Result<std::string> PositionSetter::playback(const std::string& axes,
                                             const std::string& server_setup) const {
  const PositionRules& rules = interpreter::position_rules(parts_.dialect.name);
  if (rules.playback == nullptr) {
    return fail(Errc::Unsupported, "control {} takes no position into a program",
                parts_.dialect.name);
  }
  auto setup = setup_of(server_setup);
  if (!setup) return fail(setup.error());
  std::vector<Axis> wanted;
  for (const char letter : axes) {
    const auto axis = interpreter::axis_of(letter);
    if (!axis || std::ranges::find(wanted, *axis) != wanted.end())
      return fail(Errc::Syntax, "'{}': expected letters of axes, each once", axes);
    if (auto has = check_axis(*axis, *setup); !has) return fail(has.error());
    if (auto known = check_tool(*axis, Sets::Datum); !known) return fail(known.error());
    wanted.push_back(*axis);
  }
  if (wanted.empty()) return fail(Errc::Syntax, "expected letters of axes");
  if (auto rests = check_rest(); !rests) return fail(rests.error());
  ControlMemory memory = parts_.memory;  // which a question does not change
  const auto kept = begin_memory(memory, *setup);
  if (!kept) return fail(kept.error());
  setup->variables.insert(setup->variables.end(), kept->begin(), kept->end());
  const auto control = control_with(*setup);
  if (!control) return fail(control.error());
  if (auto is_plain = check_frames(*control, *setup, kept->size()); !is_plain)
    return fail(is_plain.error());
  const auto frame = control->interpreter->frame();
  if (!frame) return fail(Errc::Unsupported, "the control reports no coordinates");
  return rules.playback(frame->to_program(place(*setup).at), wanted);
}

}  // namespace dripline::gateway
