#include "gateway/interpreter/dialects/rs274ngc/memory/tool_table.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>

#include "gateway/interpreter/dialects/rs274ngc/execution/coordinates.hpp"

namespace dripline::interpreter::rs274ngc {
namespace {

constexpr int kOrientations = 9;
constexpr int kToolFixture = 9;  ///< G59.3

bool check_tool_words(Run& run, int l) {
  const Words& words = run.block.words;
  const double number = std::round(words.value_or('P', 0));
  if (!(number >= 1 && number <= 1e9)) {
    return run.fail_word(ErrorCode::G10PRange, 'P', fmt::format("G10 L{} needs the tool's P", l));
  }
  if (!words.has_any(kAxisWords | set_of("RIJQ"))) {
    return run.fail_word(ErrorCode::G10Tool, 'L', fmt::format("L{} without values", l));
  }
  const double q = words.value_or('Q', 0);
  if (q >= 0 && q <= kOrientations && q == std::round(q)) return true;
  return run.fail_word(ErrorCode::G10Tool, 'Q',
                       fmt::format("orientation {} is not in 0 to {}", q, kOrientations));
}

/// A coordinate system, and where the tool's end without its length is in it.
struct ToolPlace {
  Axes at;
  double rotation;  ///< degrees
};

ToolPlace place_in(const Run& run, bool is_fixture) {
  const State& state = run.state;
  ToolPlace place{machine_with_length(run), state.rotation};
  const auto first = static_cast<std::size_t>(first_of_system(kToolFixture));
  if (is_fixture) place.rotation = run.parameters[first + kSystemRotation];
  for (const Axis axis : kAllAxes) {
    const std::size_t i = index_of(axis);
    place.at[i] -=
        is_fixture ? from_memory(run, axis, run.parameters[first + i]) : state.system_offset[i];
  }
  const Turned back = turned(place.at[kX], place.at[kY], -place.rotation);
  place.at[kX] = back.x;
  place.at[kY] = back.y;
  for (std::size_t i = 0; i < kAxisCount && !is_fixture; ++i) place.at[i] -= state.g92[i];
  return place;
}

/// X and Y of a rotated system depend on each other: the one without a word keeps its part.
void measure(Run& run, const ToolPlace& place, Axes& length) {
  const Words& words = run.block.words;
  Axes wanted = place.at;
  take_axis_words(run, wanted);
  const Turned old = turned(length[kX], length[kY], -place.rotation);
  const double x = words.has('X') ? place.at[kX] - wanted[kX] : old.x;
  const double y = words.has('Y') ? place.at[kY] - wanted[kY] : old.y;
  for (const Axis axis : kAllAxes) {
    if (words.has(letter(axis)))
      length[index_of(axis)] = place.at[index_of(axis)] - wanted[index_of(axis)];
  }
  if (place.rotation == 0 || (!words.has('X') && !words.has('Y'))) return;
  const Turned tool = turned(x, y, place.rotation);
  length[kX] = tool.x;
  length[kY] = tool.y;
}

}  // namespace

const Tool* find_tool(const Run& run, int number) {
  const auto tool = std::find_if(run.tools.begin(), run.tools.end(),
                                 [number](const Tool& each) { return each.number == number; });
  return tool == run.tools.end() ? nullptr : &*tool;
}

const Tool* find_tool_of_word(const Run& run, double number) {
  const bool is_in_spindle = run.is_linuxcnc() && number == 0;
  return find_tool(
      run, is_in_spindle ? run.state.tool.loaded : static_cast<int>(std::fmin(number, 1e9)));
}

bool write_tool(Run& run, int l) {
  if (!check_tool_words(run, l)) return false;
  const Words& words = run.block.words;
  const auto number = static_cast<int>(std::round(words['P']));
  const Tool* found = find_tool(run, number);
  if (found == nullptr) {
    return run.fail_word(ErrorCode::ToolNotFound, 'P', fmt::format("P{}", number));
  }
  Tool& tool = run.tools[static_cast<std::size_t>(found - run.tools.data())];
  if (l == 1) {
    take_axis_words(run, tool.length);
  } else {
    measure(run, place_in(run, l == 11), tool.length);
  }
  if (words.has('R')) tool.diameter = 2 * run.mm(words['R']);
  tool.front_angle = words.value_or('I', tool.front_angle);
  tool.back_angle = words.value_or('J', tool.back_angle);
  if (words.has('Q')) tool.orientation = static_cast<int>(words['Q']);
  return true;
}

bool reload_tools(Run& run) {
  const int loaded = run.state.tool.loaded;
  if (loaded == 0) return true;
  return run.fail_word(ErrorCode::G10Reload, 'L', fmt::format("T{}", loaded));
}

}  // namespace dripline::interpreter::rs274ngc
