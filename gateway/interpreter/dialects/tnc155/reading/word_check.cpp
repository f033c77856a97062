#include "gateway/interpreter/dialects/tnc155/reading/word_check.hpp"

#include <fmt/format.h>

#include "gateway/interpreter/dialects/tnc155/reading/cycle_names.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/ranges.hpp"

namespace dripline::interpreter::tnc155 {
namespace {

constexpr int kMirror = 8;

bool check_value(Run& run, std::string_view name, const Value& value, const Range& range) {
  if (!value.is_q()) return true;
  constexpr double kSteps = static_cast<double>(kUnit);
  const double held = run.number(value);
  const double low = static_cast<double>(range.low) / kSteps;
  const double high = static_cast<double>(range.high) / kSteps;
  if (held >= low && held <= high) return true;
  return run.fail(ErrorCode::EntryOutOfRange,
                  fmt::format("{} {}Q{} = {} is not within {} to {}", name,
                              value.is_negated ? "-" : "+", value.number, held, low, high));
}

/// The axes come first, in whatever order the words were programmed.
bool check_coordinates(Run& run, const Block& block) {
  for (const Coordinate& word : block.words()) {
    if (!check_axis(run, word.axis)) return false;
  }
  for (const Coordinate& word : block.words()) {
    const char name = letter(word.axis);
    const Range& range = coordinate_range(run.state.reading.program, word.axis);
    if (!check_value(run, {&name, 1}, word.value, range)) return false;
  }
  return true;
}

bool check_cycle(Run& run, const Block& block) {
  const Range& lengths = coordinate_range(run.state.reading.program);
  const CyclePart& part = cycle_parts(block.cycle)[block.part];
  const bool is_dwell = part.field == CycleField::Dwell;
  return check_value(run, part.word, block.first, is_dwell ? kSeconds : lengths) &&
         check_value(run, part.word, block.radius, lengths) &&
         check_value(run, "ROT", block.angle, kAbsoluteAngle);
}

}  // namespace

bool check_axis(Run& run, Axis axis) {
  if (axis <= Axis::Z || axis == run.options.fourth_axis) return true;
  return run.fail(ErrorCode::WrongAxis,
                  fmt::format("{}: axis IV of this machine is {} (fourth_axis)", letter(axis),
                              letter(run.options.fourth_axis)));
}

bool check_words(Run& run, const Block& block) {
  const Range& lengths = coordinate_range(run.state.reading.program);
  switch (block.kind) {
    case BlockKind::Function:   // its operands are numbers of any size
    case BlockKind::BlankForm:  // it reports its own faults
      return true;
    case BlockKind::CycleDefinition:
      if (block.cycle == kMirror) return true;  // likewise
      if (!check_cycle(run, block)) return false;
      break;
    case BlockKind::Rounding:
    case BlockKind::Chamfer:
      return check_value(run, "R", block.radius, radius_range(run.state.reading.program));
    case BlockKind::ToolDefinition:
      return check_value(run, "L", block.length, lengths) &&
             check_value(run, "R", block.radius, lengths);
    default:
      if (!check_value(run, "PR", block.radius, lengths) ||
          !check_value(run, "PA", block.angle, angle_range(block.is_angle_incremental))) {
        return false;
      }
      break;
  }
  return check_coordinates(run, block);
}

}  // namespace dripline::interpreter::tnc155
