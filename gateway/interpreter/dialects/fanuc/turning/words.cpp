#include <fmt/core.h>
#include <array>
#include <cmath>

#include "gateway/interpreter/dialects/fanuc/execution/motion.hpp"
#include "gateway/interpreter/dialects/fanuc/memory/tool_offsets.hpp"
#include "gateway/interpreter/dialects/fanuc/turning/turning.hpp"

namespace dripline::interpreter::fanuc {
namespace {

/// A word in increments and the word of the same axis.
struct IncrementRow {
  Address increment, absolute;
  Axis axis;
};
constexpr std::array kIncrements{IncrementRow{U, X, Axis::X}, IncrementRow{V, Y, Axis::Y},
                                 IncrementRow{W, Z, Axis::Z}, IncrementRow{H, C, Axis::C}};

/// Where the axis is, as a word would say it.
double written_position(const Run& run, Axis axis) {
  if (is_rotary(axis)) return run.work_position(axis);
  return run.in_units(axis, program_position(run)[static_cast<std::size_t>(axis)]);
}

}  // namespace

bool resolve_increments(Run& run) {
  constexpr AddressSet kWords = set_of(U, V, W, H);
  Words& words = run.block.words;
  if (words.has(C) && !run.options.has_c_axis && !run.rotary.is_on()) {
    return run.fail(ErrorCode::ImproperCommand, words.column(C),
                    "C is no axis of this lathe (c_axis); a chamfer is written ,C");
  }
  if (constexpr AddressSet kOthers = set_of(A, B); words.has_any(kOthers)) {
    return run.fail(ErrorCode::ImproperCommand, words.first_column(kOthers),
                    "A and B are no axes of this lathe; a line at an angle is not supported");
  }
  if (words.has_any(set_of(Y, V)) && !run.options.has_y_axis) {
    return run.fail(ErrorCode::ImproperCommand, words.first_column(set_of(Y, V)),
                    "Y is no axis of this lathe (y_axis)");
  }
  if (words.has(H) && !run.options.has_c_axis && !run.rotary.is_on()) {
    return run.fail(ErrorCode::ImproperCommand, words.column(H),
                    "H moves C, which is no axis of this lathe (c_axis)");
  }
  if (!words.has_any(kWords)) return true;
  const std::uint8_t one_shot = run.block.parts.one_shot;
  if (run.options.code_system != CodeSystem::A || one_shot == 52 || one_shot == 53) {
    return run.fail(ErrorCode::ImproperCommand, words.first_column(kWords),
                    "U, V, W and H are increments of moves in G-code system A");
  }
  for (const IncrementRow& row : kIncrements) {
    if (!words.has(row.increment)) continue;
    const Word& word = words[row.increment];
    if (words.has(row.absolute)) {
      return run.fail(
          ErrorCode::ImproperCommand, word.column,
          fmt::format("{} and {} in one block", letter(row.absolute), letter(row.increment)));
    }
    Word absolute;
    absolute.column = word.column;
    absolute.form = WordForm::Point;
    absolute.is_negative = word.is_negative;
    const double by = run.coordinate(row.axis, word);
    const double in_words = is_rotary(row.axis) ? by : run.in_units(row.axis, by);
    absolute.value = written_position(run, row.axis) + in_words;
    words.replace(row.increment, row.absolute, absolute);
    run.ledger.take(set_of(row.increment));
  }
  return true;
}

bool select_turret(Run& run) {
  const Word& word = run.block.words[T];
  const double number = run.whole(word);
  const int step = run.options.turret_digits == 1 ? 10 : 100;
  const double most = run.options.turret_digits == 1 ? 99 : 9999;
  if (!(number >= 0 && number <= most)) {
    return run.fail(ErrorCode::TooManyDigits, word.column,
                    fmt::format("T{} is not 0 to {}", number, most));
  }
  ModalState& state = run.state;
  const int tool = static_cast<int>(number) / step;
  const int offset = static_cast<int>(number) % step;
  state.last.t = static_cast<int>(number);
  state.h_number = state.d_number = offset;
  if (tool != 0) state.tool.active = tool;
  state.tool.is_pending = false;
  run.events().on_tool({run.origin, state.tool.active, false, offset});
  return true;
}

bool set_turret_offset(Run& run) {
  const Words& words = run.block.words;
  run.ledger.take(kAxisWords | set_of(R, Q, L));
  if (!words.has(P))
    return run.fail(ErrorCode::IllegalOffsetNumber, run.block.parts.g_column, "no P");
  constexpr double kGeometry = 10'000;
  const double written = run.whole(words[P]);
  const bool is_geometry = written > kGeometry;
  const double number = is_geometry ? written - kGeometry : written;
  if (!(number >= 1 && number <= kMaxOffsets)) {
    return run.fail(ErrorCode::IllegalOffsetNumber, words.column(P),
                    fmt::format("P{} is not 1 to {}, or 10001 to {}", written, kMaxOffsets,
                                kGeometry + kMaxOffsets));
  }
  if (const AddressSet others = words.present() & kAxisWords & ~set_of(X, Z, U, W); others != 0) {
    return run.fail(ErrorCode::IllegalValueInG10, words.first_column(others));
  }
  const auto n = static_cast<std::size_t>(number);
  ToolOffsets& tools = run.memory.tools;
  double& x = is_geometry ? tools.x_geometry[n] : tools.x_wear[n];
  double& z = is_geometry ? tools.length_geometry[n] : tools.length_wear[n];
  double& radius = is_geometry ? tools.radius_geometry[n] : tools.radius_wear[n];
  const bool adds = run.options.code_system != CodeSystem::A && run.state.is_incremental();
  if (words.has(X)) x = run.coordinate(Axis::X, words[X]) + (adds ? x : 0);
  if (words.has(Z)) z = run.length(words[Z]) + (adds ? z : 0);
  if (words.has(U)) x += run.coordinate(Axis::X, words[U]);
  if (words.has(W)) z += run.length(words[W]);
  if (words.has(R)) radius = run.length(words[R]);
  if (!words.has(Q)) return true;
  const double tip = run.whole(words[Q]);
  if (!(tip >= 0 && tip <= 9)) {
    return run.fail(ErrorCode::IllegalValueInG10, words.column(Q),
                    fmt::format("Q{} is not 0 to 9", tip));
  }
  tools.tip[n] = tip;
  return true;
}

}  // namespace dripline::interpreter::fanuc
