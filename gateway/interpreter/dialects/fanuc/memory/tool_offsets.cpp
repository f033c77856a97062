#include "gateway/interpreter/dialects/fanuc/memory/tool_offsets.hpp"

#include <fmt/core.h>
#include <array>
#include <bit>

#include "gateway/interpreter/dialects/fanuc/tilting/tilting.hpp"

namespace dripline::interpreter::fanuc {
namespace {

enum class RegisterKind : std::uint8_t { LengthWear, LengthGeometry, RadiusWear, RadiusGeometry };

double* cell_of(ToolOffsets& tools, RegisterKind kind, std::size_t n) {
  const std::array registers{&tools.length_wear, &tools.length_geometry, &tools.radius_wear,
                             &tools.radius_geometry};
  return &(*registers[static_cast<std::size_t>(kind)])[n];
}

OffsetRegister register_of(Run& run, RegisterKind kind, int number) {
  if (number < 1 || number > kMaxOffsets) return {};
  ToolOffsets& tools = run.memory.tools;
  const auto n = static_cast<std::size_t>(number);
  switch (run.options.offset_memory) {
    case OffsetMemory::A:
      return {&tools.length_geometry[n], &tools.radius_geometry[n]};
    case OffsetMemory::B: {
      const bool is_wear = kind == RegisterKind::LengthWear || kind == RegisterKind::RadiusWear;
      return {cell_of(tools, is_wear ? RegisterKind::LengthWear : RegisterKind::LengthGeometry, n),
              cell_of(tools, is_wear ? RegisterKind::RadiusWear : RegisterKind::RadiusGeometry, n)};
    }
    case OffsetMemory::C:
      break;
  }
  return {cell_of(tools, kind, n), nullptr};
}

}  // namespace

namespace {

/// The variables of a lathe's offsets, by number from 1.
OffsetRegister lathe_variable(Run& run, int number, bool& is_x) {
  struct Row {
    int base, count;
    std::array<double, kMaxOffsets + 1> ToolOffsets::*values;
  };
  using Tools = ToolOffsets;
  constexpr std::array kRows{Row{2000, 64, &Tools::x_wear},
                             Row{2100, 64, &Tools::length_wear},
                             Row{2200, 64, &Tools::radius_wear},
                             Row{2300, 64, &Tools::tip},
                             Row{2700, 49, &Tools::x_geometry},
                             Row{2800, 49, &Tools::length_geometry},
                             Row{2900, 64, &Tools::radius_geometry},
                             Row{10000, 400, &Tools::x_wear},
                             Row{11000, 400, &Tools::length_wear},
                             Row{12000, 400, &Tools::radius_wear},
                             Row{13000, 400, &Tools::tip},
                             Row{15000, 400, &Tools::x_geometry},
                             Row{16000, 400, &Tools::length_geometry},
                             Row{17000, 400, &Tools::radius_geometry}};
  for (const Row& row : kRows) {
    if (number <= row.base || number > row.base + row.count) continue;
    is_x = row.values == &Tools::x_wear || row.values == &Tools::x_geometry;
    return {&(run.memory.tools.*row.values)[static_cast<std::size_t>(number - row.base)], nullptr};
  }
  return {};
}

}  // namespace

OffsetRegister offset_variable(Run& run, int number) {
  if (run.options.is_lathe) {
    bool is_x = false;
    OffsetRegister cell = lathe_variable(run, number, is_x);
    cell.is_x = is_x;
    cell.is_number = (number > 2300 && number <= 2364) || (number > 13000 && number <= 13400);
    return cell;
  }
  struct Row {
    int base, last;
    RegisterKind kind;
    OffsetMemory least;  ///< memory that has these variables
  };
  constexpr std::array kRows{Row{2000, 2200, RegisterKind::LengthWear, OffsetMemory::A},
                             Row{2200, 2400, RegisterKind::LengthGeometry, OffsetMemory::B},
                             Row{10000, 10400, RegisterKind::LengthWear, OffsetMemory::A},
                             Row{11000, 11400, RegisterKind::LengthGeometry, OffsetMemory::B},
                             Row{12000, 12400, RegisterKind::RadiusWear, OffsetMemory::C},
                             Row{13000, 13400, RegisterKind::RadiusGeometry, OffsetMemory::C}};
  for (const Row& row : kRows) {
    if (number > row.base && number <= row.last && run.options.offset_memory >= row.least)
      return register_of(run, row.kind, number - row.base);
  }
  return {};
}

OffsetRegister offset_of_g10(Run& run, int list, int number) {
  const RegisterKind kind = list == 10   ? RegisterKind::LengthGeometry
                            : list == 12 ? RegisterKind::RadiusGeometry
                            : list == 13 ? RegisterKind::RadiusWear
                                         : RegisterKind::LengthWear;
  return register_of(run, kind, number);
}

double read_register(const OffsetRegister& cell) {
  return *cell.value != 0 || cell.also == nullptr ? *cell.value : *cell.also;
}

void write_register(Run& run, const OffsetRegister& cell, double value, std::uint32_t column) {
  if (cell.also != nullptr) {
    if (*cell.value != 0 && *cell.also != 0 && *cell.value != *cell.also) {
      run.warn(WarningCode::SharedOffset, column);
    }
    *cell.also = value;
  }
  *cell.value = value;
}

double length_of_offset(const Run& run, int number) {
  const auto n = static_cast<std::size_t>(number);
  return run.memory.tools.length_geometry[n] + run.memory.tools.length_wear[n];
}

double radius_of_offset(const Run& run, int number) {
  const auto n = static_cast<std::size_t>(number);
  const double value = run.memory.tools.radius_geometry[n] + run.memory.tools.radius_wear[n];
  return run.options.diameter_offset ? value / 2 : value;
}

bool read_offset_number(Run& run, Address address, int& number) {
  const Word& word = run.block.words[address];
  const double value = run.whole(word);
  if (!(value >= 0 && value <= kMaxOffsets)) {
    return run.fail(ErrorCode::IllegalOffsetNumber, word.column,
                    fmt::format("{}{} is not 0 to {}", letter(address), value, kMaxOffsets));
  }
  number = static_cast<int>(value);
  return true;
}

namespace {

/// A program for another memory would put two values into one place.
bool check_list(Run& run, int list) {
  const OffsetMemory memory = run.options.offset_memory;
  const auto refuse = [&](std::string_view why) {
    return run.fail(ErrorCode::ImproperCommand, run.block.parts.g_column,
                    fmt::format("L{} in offset memory {}: {} (offset_memory)", list,
                                memory == OffsetMemory::A ? 'A' : 'B', why));
  };
  if (memory == OffsetMemory::C || list < 10) return true;
  if (list > 11) return refuse("radii of their own are in memory C");
  if (memory == OffsetMemory::B) return true;
  int& first = run.state.offset_list;
  if (first == 0) first = list;
  return first == list || refuse("geometry and wear are apart in memories B and C");
}

}  // namespace

bool set_offset_data(Run& run, int list) {
  const Words& words = run.block.words;
  if (!check_list(run, list)) return false;
  if (!words.has(P))
    return run.fail(ErrorCode::IllegalOffsetNumber, run.block.parts.g_column, "no P");
  const double number = run.whole(words[P]);
  const OffsetRegister cell = number >= 1 && number <= kMaxOffsets
                                  ? offset_of_g10(run, list, static_cast<int>(number))
                                  : OffsetRegister{};
  if (cell.value == nullptr) {
    return run.fail(ErrorCode::IllegalOffsetNumber, words.column(P),
                    fmt::format("P{} is not 1 to {}", number, kMaxOffsets));
  }
  if (!words.has(R))
    return run.fail(ErrorCode::IllegalValueInG10, run.block.parts.g_column, "no R");
  double value = run.length(words[R]);
  if (run.state.is_incremental()) value += read_register(cell);
  if (!(std::fabs(value) <= kMaxOffsetValue)) {
    return run.fail(ErrorCode::IllegalValueInG10, words.column(R),
                    fmt::format("{} mm is beyond {}", value, kMaxOffsetValue));
  }
  write_register(run, cell, value, words.column(R));
  return true;
}

namespace {

/// After the length that is in force from this block on.
bool apply_tip_control(Run& run) {
  const Block& block = run.block;
  const bool begins = block.names(kLengthGroup) && is_tip_control(block.g[kLengthGroup]);
  if (begins) return begin_tip_control(run);
  if (run.tilted.kind() == Tilt::Kind::Plane) return follow_length_offset(run);
  const bool ends = run.tilted.is_on() && block.names(kLengthGroup);
  return !ends || end_tip_control(run);
}

}  // namespace

bool apply_length_offset(Run& run) {
  ModalState& state = run.state;
  const Block& block = run.block;
  if (run.options.is_lathe) return true;  // with T
  if (block.words.has(H)) {
    if (!read_offset_number(run, H, state.h_number)) return false;
    state.last.h = state.h_number;
  }
  if (block.names(kLengthGroup)) state.g[kLengthGroup] = block.g[kLengthGroup];
  const std::uint8_t code = state.g[kLengthGroup];
  if (block.names(kLengthGroup) && is_tip_control(code)) {
    state.length_axis = Axis::Z;
  } else if (block.names(kLengthGroup) && code != 49) {
    const AddressSet axes = block.words.present() & set_of(X, Y, Z);
    state.length_axis = Axis::Z;
    if (run.options.length_axis_type == 'B') {
      constexpr std::array<Axis, 3> kNormals{Axis::Z, Axis::Y, Axis::X};
      state.length_axis = kNormals[static_cast<std::size_t>(state.plane())];
    } else if (run.options.length_axis_type == 'C') {
      if (std::popcount(axes) != 1) {
        return run.fail(ErrorCode::NoLengthAxis, block.parts.g_column, "one axis is expected");
      }
      state.length_axis = axes == set_of(X) ? Axis::X : axes == set_of(Y) ? Axis::Y : Axis::Z;
    }
  }
  if (code == 49) {
    state.length_offset = 0;
  } else if (block.names(kLengthGroup) || block.words.has(H)) {
    const double value = length_of_offset(run, state.h_number);
    state.length_offset = code == 44 ? -value : value;
  }
  return apply_tip_control(run);
}

}  // namespace dripline::interpreter::fanuc
