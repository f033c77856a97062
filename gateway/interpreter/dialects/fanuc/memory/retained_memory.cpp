#include "gateway/interpreter/dialects/fanuc/memory/retained_memory.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <cstring>

#include "gateway/interpreter/dialects/fanuc/interpreter.hpp"
#include "gateway/interpreter/dialects/fanuc/memory/variables.hpp"
#include "gateway/interpreter/dialects/fanuc/options.hpp"
#include "protocol/base/decimal.hpp"

namespace dripline::interpreter::fanuc {

namespace {

/// Bit by bit: a vacant variable is not equal to itself.
template <class Values>
bool note(Values& known, const Values& now) {
  // NOLINTNEXTLINE(bugprone-suspicious-memory-comparison): arrays of doubles have no padding
  const bool is_same = std::memcmp(&known, &now, sizeof now) == 0;
  if (!is_same) known = now;
  return !is_same;
}

}  // namespace

std::vector<MemoryCell> FanucInterpreter::memory_cells() const {
  return cells_of([this](auto visit) {
    for_each_variable(run_.state, run_.options, visit);
    for_each_offset(run_.memory, run_.options.is_lathe, visit);
  });
}

bool FanucInterpreter::read_memory(std::vector<double>& values) {
  bool has_changed = values.empty();
  if (!run_.options.reset_clears_commons)
    has_changed |= note(known_memory_.commons, run_.state.commons);
  has_changed |= note(known_memory_.kept, run_.state.kept);
  if (!run_.state.extra.empty()) {
    has_changed |= known_memory_.extra.size() != run_.state.extra.size() ||
                   std::memcmp(known_memory_.extra.data(), run_.state.extra.data(),
                               run_.state.extra.size() * sizeof(double)) != 0;
    known_memory_.extra = run_.state.extra;
  }
  has_changed |= note(known_memory_.counters, run_.state.counters);
  has_changed |= note(known_memory_.work, run_.memory.coordinates.work);
  has_changed |= note(known_memory_.tools, run_.memory.tools);
  if (!has_changed) return false;
  read_cells(values, [this](auto visit) {
    for_each_variable(run_.state, run_.options, visit);
    for_each_offset(run_.memory, run_.options.is_lathe, visit);
  });
  return true;
}

std::vector<std::string> FanucInterpreter::live_names() const {
  std::vector<std::string> names;
  for (int number = 1; number <= kLocalCount; ++number) names.push_back(fmt::format("#{}", number));
  if (!run_.options.reset_clears_commons) return names;
  for (int number = 100; number <= run_.options.last_common; ++number)
    names.push_back(fmt::format("#{}", number));
  return names;
}

bool FanucInterpreter::read_live(std::vector<double>& values) {
  const Locals& locals = run_.state.locals.back();
  const auto& commons = run_.state.commons;
  const bool shows_commons = run_.options.reset_clears_commons;
  bool has_changed = !known_live_;
  if (!known_live_) known_live_ = KnownLive{locals, commons};
  has_changed |= note(known_live_->locals, locals);
  if (shows_commons) has_changed |= note(known_live_->commons, commons);
  if (!has_changed) return false;
  values.assign(locals.begin(), locals.end());
  if (shows_commons) {
    const auto count = static_cast<std::ptrdiff_t>(run_.options.last_common) - 99;
    values.insert(values.end(), commons.begin(), commons.begin() + count);
  }
  return true;
}

namespace {

/// G54 to G59, EXT, G54.1P1 to G54.1P48, G52 and G92.
Result<void> load_offset(const OffsetRecord& offset, Coordinates& coordinates) {
  AxisValues values{};
  for (const Axis axis : kAllAxes) {
    values[static_cast<std::size_t>(axis)] = offset.value.raw(axis);
  }
  const std::string_view name = offset.name;
  if (name == "EXT") {
    coordinates.work[0] = values;
  } else if (name == "G52") {
    coordinates.local = values;
  } else if (name == "G92") {
    coordinates.shift = values;
  } else if (name.size() == 3 && name.starts_with("G5") && name[2] >= '4' && name[2] <= '9') {
    coordinates.work[static_cast<std::size_t>(name[2] - '3')] = values;
  } else if (name.starts_with("G54.1P")) {
    const auto number = parse_decimal(name.substr(6));
    if (!number || number->scale != 0 || number->digits < 1 || number->digits > kMoreWorkCount) {
      return fail(Errc::Unsupported, "offset {}: this control has G54.1P1 to G54.1P{}", name,
                  kMoreWorkCount);
    }
    coordinates.work[static_cast<std::size_t>(6 + number->digits)] = values;
  } else {
    return fail(Errc::Unsupported,
                "offset {}: this control has EXT, G54 to G59, G54.1P1 to G54.1P{}, G52 and G92",
                name, kMoreWorkCount);
  }
  return {};
}

Result<void> load_tool(const ToolRecord& tool, ToolOffsets& tools) {
  if (tool.number < 1 || tool.number > kMaxOffsets) {
    return fail(Errc::Unsupported, "tool {}: this control has offsets 1 to {}", tool.number,
                kMaxOffsets);
  }
  const auto n = static_cast<std::size_t>(tool.number);
  tools.length_geometry[n] = tool.length.raw(Axis::Z);
  tools.length_wear[n] = tool.wear.raw(Axis::Z);
  tools.radius_geometry[n] = tool.radius.mm();
  tools.radius_wear[n] = tool.radius_wear.mm();
  tools.x_geometry[n] = tool.length.raw(Axis::X);
  tools.x_wear[n] = tool.wear.raw(Axis::X);
  tools.tip[n] = std::clamp(tool.tip, 0, 9);
  return {};
}

/// G54.X, tool.12.length_wear, #3901: not among the variables that a program counts as its own.
bool is_offset_or_counter(std::string_view name) {
  return !name.starts_with('#') || (name.size() == 5 && name[1] == '3');
}

tl::unexpected<Error> refuse_variable(std::string_view name, const ControlOptions& options) {
  return fail(Errc::Unsupported,
              "variable {}: this control has #1 to #33, #100 to #{} and #500 to #{}", name,
              options.last_common, options.last_kept);
}

/// Cells of the control's memory by their names (retained_memory.hpp).
Result<void> load_cells(const Setup& setup, const ControlOptions& options, ModalState& state,
                        Memory& memory) {
  std::map<std::string, double> cells;
  for (const VariableRecord& variable : setup.variables) {
    if (is_offset_or_counter(variable.name)) cells[variable.name] = variable.value;
  }
  const auto unknown = write_cells(std::move(cells), [&](auto visit) {
    for_each_variable(state, options, visit);
    for_each_offset(memory, options.is_lathe, visit);
  });
  if (unknown.empty()) return {};
  return refuse_variable(unknown.begin()->first, options);
}

Result<void> load_variable(const VariableRecord& variable, const ControlOptions& options,
                           ModalState& state) {
  const std::string_view name = variable.name;
  if (is_offset_or_counter(name)) return {};
  const auto number = parse_decimal(name.substr(name.starts_with('#') ? 1 : 0));
  const bool is_number = name.starts_with('#') && number && number->scale == 0 &&
                         number->digits >= 0 && number->digits < kFirstExtra + kExtraCount;
  double* cell =
      is_number ? common_variable(state, options, static_cast<int>(number->digits)) : nullptr;
  if (cell == nullptr) return refuse_variable(name, options);
  *cell = variable.value;
  return {};
}

}  // namespace

void apply_start_codes(const ControlOptions& options, ModalState& state) {
  for (const std::uint8_t code : options.start_g) {
    const std::uint8_t group = group_of(code);
    if (group != kUnitsGroup && group != kWorkGroup) state.g[group] = code;
  }
}

Result<void> load_memory(const Setup& setup, const ControlOptions& options, ModalState& state,
                         Memory& memory) {
  state.units = options.start_units;
  state.g[kUnitsGroup] = options.start_units == Units::Inch ? 20 : 21;
  for (const std::uint8_t code : options.start_g) {
    state.g[group_of(code)] = code;
  }
  state.g[kMirrorGroup] = kMirrorOff;
  state.g[kInterpolationGroup] = kPolarPlaneOff;
  state.parameters = {.arc_error = options.arc_error,
                      .peck_return = options.peck_return,
                      .peck_clearance = options.peck_clearance,
                      .rotate_default = options.rotate_default,
                      .scale_default = options.scale_default};
  state.turning.thread_chamfer = options.thread_chamfer;
  state.position = setup.start;
  state.position.unmark_all();
  state.locals.assign(1, null_locals());
  state.commons.fill(kNull);
  state.kept.fill(kNull);
  if (options.has_extra_commons) state.extra.assign(kExtraCount, kNull);
  state.zone = options.zone;
  state.zone.is_on = state.g[kStrokeGroup] == 22 && state.zone.has_volume();
  for (const OffsetRecord& offset : setup.offsets) {
    if (auto done = load_offset(offset, memory.coordinates); !done) return done;
  }
  for (const ToolRecord& tool : setup.tools) {
    if (auto done = load_tool(tool, memory.tools); !done) return done;
    if (options.is_lathe && (tool.tip < 0 || tool.tip > 9)) {
      return fail(Errc::LimitExceeded, "tool {}: tip {} is not 0 to 9", tool.number, tool.tip);
    }
  }
  for (const VariableRecord& variable : setup.variables) {
    if (auto done = load_variable(variable, options, state); !done) return done;
  }
  return load_cells(setup, options, state, memory);
}

}  // namespace dripline::interpreter::fanuc
