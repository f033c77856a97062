#include "gateway/interpreter/dialects/rs274ngc/execution/coordinates.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>
#include <utility>

#include "gateway/interpreter/dialects/rs274ngc/memory/tool_table.hpp"

namespace dripline::interpreter::rs274ngc {
namespace {

/// Origins have changed; the machine has not moved.
void keep_machine(Run& run) {
  run.state.position = to_program(run, values_of(run.state.machine));
}

}  // namespace

Turned turned(double x, double y, double degrees) {
  const double radians = degrees * (Angle::kPi / 180);
  const double c = std::cos(radians);
  const double s = std::sin(radians);
  return {x * c - y * s, x * s + y * c};
}

Position to_machine(const Run& run, const Axes& program) {
  const State& state = run.state;
  Axes machine;
  for (std::size_t i = 0; i < kAxisCount; ++i) machine[i] = program[i] + state.g92[i];
  if (state.rotation != 0) {
    const Turned at = turned(machine[kX], machine[kY], state.rotation);
    machine[kX] = at.x;
    machine[kY] = at.y;
  }
  Position position;
  for (const Axis axis : kAllAxes) {
    position.set_raw(axis, machine[index_of(axis)] + state.system_offset[index_of(axis)]);
    if (!state.machine.has(axis)) position.unmark(axis);
  }
  return position;
}

Axes to_program(const Run& run, const Axes& machine) {
  const State& state = run.state;
  Axes program;
  for (std::size_t i = 0; i < kAxisCount; ++i) program[i] = machine[i] - state.system_offset[i];
  if (state.rotation != 0) {
    const Turned at = turned(program[kX], program[kY], -state.rotation);
    program[kX] = at.x;
    program[kY] = at.y;
  }
  for (std::size_t i = 0; i < kAxisCount; ++i) program[i] -= state.g92[i];
  return program;
}

CoordinateFrame frame_of(const Run& run) {
  CoordinateFrame frame;
  frame.datum = run.state.system_offset;
  frame.shift = run.state.g92;
  frame.rotation = run.state.rotation;
  frame.learn([&run](const CoordinateFrame::Values& machine) { return to_program(run, machine); });
  return frame;
}

Axes machine_with_length(const Run& run) {
  Axes machine = values_of(run.state.machine);
  for (std::size_t i = 0; i < kAxisCount; ++i) machine[i] += run.state.tool_length[i];
  return machine;
}

Axes program_of_machine_with_length(const Run& run, const Axes& machine) {
  Axes tip = machine;
  for (std::size_t i = 0; i < kAxisCount; ++i) tip[i] -= run.state.tool_length[i];
  return to_program(run, tip);
}

double from_memory(const Run& run, Axis axis, double value) {
  return is_rotary(axis) ? value : value * run.options.mm_per_machine_unit;
}
double to_memory(const Run& run, Axis axis, double mm) {
  return is_rotary(axis) ? mm : mm / run.options.mm_per_machine_unit;
}

void load_system(Run& run, int system) {
  const auto first = static_cast<std::size_t>(first_of_system(system));
  const Axes old = run.state.system_offset;
  for (const Axis axis : kAllAxes) {
    const std::size_t i = index_of(axis);
    run.state.system_offset[i] = from_memory(run, axis, run.parameters[first + i]);
  }
  run.state.rotation = run.is_linuxcnc() ? run.parameters[first + kSystemRotation] : 0;
  run.state.system = static_cast<std::uint8_t>(system);
  run.parameters[kSystemNumber] = system;
  ++run.frame_changes;
  keep_machine(run);
  // of the NIST program's compensation, in the XY plane: the path as programmed stays where it is
  run.state.compensation.x += old[kX] - run.state.system_offset[kX];
  run.state.compensation.y += old[kY] - run.state.system_offset[kY];
}

void set_tool_length(Run& run, const Axes& length) {
  State& state = run.state;
  Axes change;
  for (std::size_t i = 0; i < kAxisCount; ++i) change[i] = state.tool_length[i] - length[i];
  if (state.rotation != 0) {  // lengths lie along the machine's axes
    const Turned in_system = turned(change[kX], change[kY], -state.rotation);
    change[kX] = in_system.x;
    change[kY] = in_system.y;
  }
  for (std::size_t i = 0; i < kAxisCount; ++i) state.position[i] += change[i];
  state.tool_length = length;
  state.machine = to_machine(run, state.position);
}

bool select_system(Run& run, int g_code) {
  const int system = g_code < 590 ? (g_code - 530) / 10 : 6 + (g_code - 590);
  if (run.is_linuxcnc() && run.state.compensation.side != Side::Off) {  // one in force already, too
    return run.fail(ErrorCode::CompNotAllowed, 0, "a change of the coordinate system");
  }
  if (system == run.state.system) return true;
  load_system(run, system);
  return true;
}

void take_axis_words(Run& run, Axes& axes) {
  run.ledger.take(kAxisWords);
  for (const Axis axis : kAllAxes) {
    const char word = letter(axis);
    if (!run.block.words.has(word)) continue;
    const double value = run.block.words[word];
    axes[index_of(axis)] = is_rotary(axis) ? value : run.mm(value);
  }
}

namespace {

/// The tool of an H word: a slot of the changer, or a row of the table.
bool tool_of_h(Run& run, double h, const Tool*& tool) {
  const double number = std::round(h);
  if (!(std::fabs(h - number) <= 0.0001)) return run.fail_word(ErrorCode::NotInteger, 'H');
  if (!run.is_linuxcnc() && number > run.options.slots) {
    return run.fail_word(ErrorCode::OffsetIndexRange, 'H',
                         fmt::format("H{} is above {}", number, run.options.slots));
  }
  tool = find_tool_of_word(run, number);
  if (tool == nullptr && run.is_linuxcnc() && number != 0) {
    return run.fail_word(ErrorCode::ToolNotFound, 'H', fmt::format("H{}", number));
  }
  return true;
}

}  // namespace

bool set_length_offset(Run& run, int g_code) {
  if (run.is_linuxcnc() && run.state.compensation.side != Side::Off) {
    return run.fail(ErrorCode::CompNotAllowed, 0, "a change of the tool length");
  }
  if (g_code == 490) {
    set_tool_length(run, Axes{});
    return true;
  }
  if (g_code == 431) {
    Axes length = run.state.tool_length;
    take_axis_words(run, length);
    set_tool_length(run, length);
    return true;
  }
  const Words& words = run.block.words;
  if (!words.has('H') && (!run.is_linuxcnc() || g_code == 432)) {
    return run.fail(ErrorCode::OffsetIndexMissing, 0);
  }
  if (g_code == 432 && words.has_any(kAxisWords)) {
    return run.fail(ErrorCode::AxisTwice, 0, "G43.2 takes H alone");
  }
  const Tool* tool = nullptr;
  if (words.has('H')) {
    if (!tool_of_h(run, words['H'], tool)) return false;
  } else {
    tool = find_tool(run, run.state.tool.loaded);
  }
  Axes length = tool ? tool->length : Axes{};
  if (g_code == 432) {
    for (std::size_t i = 0; i < kAxisCount; ++i) length[i] += run.state.tool_length[i];
  }
  set_tool_length(run, length);
  return true;
}

namespace {

/// The origin that makes the words the coordinates of the present point (G10 L20).
Axes origin_for_current_point(Run& run, std::size_t first) {
  State& state = run.state;
  const double rotation = std::exchange(state.rotation, run.parameters[first + kSystemRotation]);
  const Axes offset = state.system_offset;
  Axes machine = values_of(state.machine);
  for (const Axis axis : kAllAxes) {
    const std::size_t i = index_of(axis);
    state.system_offset[i] = from_memory(run, axis, run.parameters[first + i]);
  }
  Axes program = to_program(run, machine);
  take_axis_words(run, program);
  state.system_offset = Axes{};
  const Position from_zero = to_machine(run, program);
  for (const Axis axis : kAllAxes) machine[index_of(axis)] -= from_zero.raw(axis);
  state.rotation = rotation;
  state.system_offset = offset;
  return machine;
}

/// G10 L2 and L20: origin and rotation of a system.
bool set_system(Run& run, bool at_current_point) {
  const Words& words = run.block.words;
  if (words.has('I')) return run.fail_word(ErrorCode::UnusedI, 'I');
  if (words.has('J')) return run.fail_word(ErrorCode::UnusedJ, 'J');
  const double written = words['P'];  // checked with the line
  const double p = run.is_linuxcnc() ? std::trunc(written + 0.0001) : std::round(written);
  const int system = p == 0 ? run.state.system : static_cast<int>(p);
  const bool is_active = system == run.state.system;
  if (run.state.compensation.side != Side::Off && is_active && run.is_linuxcnc()) {
    return run.fail(ErrorCode::CompNotAllowed, 0, "a change of the active coordinate system");
  }
  const auto first = static_cast<std::size_t>(first_of_system(system));
  if (words.has('R') && run.is_linuxcnc()) {
    if (at_current_point) return run.fail_word(ErrorCode::UnusedR, 'R');
    run.parameters[first + kSystemRotation] = words['R'];
  }
  Axes origin{};
  if (at_current_point) {
    origin = origin_for_current_point(run, first);
  } else {
    take_axis_words(run, origin);
  }
  for (const Axis axis : kAllAxes) {
    const bool is_turned = at_current_point && run.parameters[first + kSystemRotation] != 0 &&
                           (axis == Axis::X || axis == Axis::Y);  // one word moves both
    if (!words.has(letter(axis)) && !is_turned) continue;
    run.parameters[first + index_of(axis)] = to_memory(run, axis, origin[index_of(axis)]);
  }
  if (is_active) load_system(run, system);
  return true;
}

bool set_data(Run& run) {
  const double l = run.block.words.value_or('L', -1);
  if (l == 2) return set_system(run, false);
  if (l == 20) return set_system(run, true);
  if (l == 0) return reload_tools(run);
  if (l == 1 || l == 10 || l == 11) return write_tool(run, static_cast<int>(l));
  return run.fail_word(ErrorCode::G10L, 'L', fmt::format("L{}", l));
}

void store_g92(Run& run) {
  run.parameters[kG92Active] = 1;
  for (const Axis axis : kAllAxes) {
    run.parameters[kG92Offsets + index_of(axis)] =
        to_memory(run, axis, run.state.g92[index_of(axis)]);
  }
}

/// G92: the present point gets the coordinates of the words. G52: the offset is what the words say.
void set_axis_offsets(Run& run, bool is_offset_itself) {
  State& state = run.state;
  const Words& words = run.block.words;
  run.ledger.take(kAxisWords);
  for (const Axis axis : kAllAxes) {
    const char word = letter(axis);
    if (!words.has(word)) continue;
    const std::size_t i = index_of(axis);
    const double mm = is_rotary(axis) ? words[word] : run.mm(words[word]);
    const double offset = is_offset_itself ? mm : state.g92[i] + state.position[i] - mm;
    state.position[i] += state.g92[i] - offset;
    if (!is_offset_itself) state.position[i] = mm;
    state.g92[i] = offset;
  }
  ++run.frame_changes;
  store_g92(run);
}

void load_axis_offsets(Run& run, bool from_parameters) {
  State& state = run.state;
  for (const Axis axis : kAllAxes) {
    const std::size_t i = index_of(axis);
    const double offset =
        from_parameters ? from_memory(run, axis, run.parameters[kG92Offsets + i]) : 0;
    state.position[i] += state.g92[i] - offset;
    state.g92[i] = offset;
  }
  ++run.frame_changes;
}

bool change_axis_offsets(Run& run, int g_code) {
  if (run.state.compensation.side != Side::Off) return run.fail(ErrorCode::CompAxisOffsets, 0);
  if (g_code == 920 || g_code == 520) {
    set_axis_offsets(run, g_code == 520);
    return true;
  }
  load_axis_offsets(run, g_code == 923);
  run.parameters[kG92Active] = g_code == 923 ? 1 : 0;
  if (g_code == 921) {
    for (std::size_t i = 0; i < kAxisCount; ++i) run.parameters[kG92Offsets + i] = 0;
  }
  return true;
}

/// The point before the line's move.
bool store_home(Run& run, int first) {
  if (run.state.compensation.side != Side::Off) return run.fail(ErrorCode::CompHome, 0);
  const Axes machine = machine_with_length(run);
  for (const Axis axis : kAllAxes) {
    run.parameters[static_cast<std::size_t>(first) + index_of(axis)] =
        to_memory(run, axis, machine[index_of(axis)]);
  }
  return true;
}

}  // namespace

bool execute_one_shot(Run& run, int g_code) {
  switch (g_code) {
    case 100:
      return set_data(run);
    case 281:
      return store_home(run, kHome);
    case 301:
      return store_home(run, kSecondHome);
    default:
      return change_axis_offsets(run, g_code);
  }
}

void reset_coordinates(Run& run) {
  if (!run.is_linuxcnc()) {
    load_axis_offsets(run, false);
    run.parameters[kG92Active] = 0;
  }
  if (run.state.system != 1) load_system(run, 1);
}

}  // namespace dripline::interpreter::rs274ngc
