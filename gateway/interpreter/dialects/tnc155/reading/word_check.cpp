#include "gateway/interpreter/dialects/tnc155/reading/word_check.hpp"

#include <fmt/format.h>

#include "gateway/interpreter/dialects/tnc155/reading/cycle_names.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/ranges.hpp"

namespace dripline::interpreter::tnc155 {

namespace {

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

namespace {

constexpr std::int32_t kSlowSpindle = 9'000 * Value::kStepsPerUnit;

/// What a block asks for, and how it says so.
struct Demand {
  Feature feature = Feature::Count;  ///< none
  ErrorCode code = ErrorCode::NotSupported;
  std::string words;
};

std::string axes_text(const Block& block) {
  std::string text;
  for (const Coordinate& word : block.words()) text += letter(word.axis);
  return text;
}

Demand demand_of(const Block& block) {
  switch (block.kind) {
    case BlockKind::Line:
      if (block.coordinate_count < 3) return {};
      return {Feature::ThreeAxisLines, ErrorCode::NotSupported, axes_text(block) + " in one block"};
    case BlockKind::PolarArc:
      if (block.coordinate_count == 0) return {};
      return {Feature::Helix, ErrorCode::NotSupported, "an arc with " + axes_text(block)};
    case BlockKind::ToolDefinition:
      if (block.length.is_programmed() || block.radius.is_programmed()) return {};
      return {Feature::NextTool, ErrorCode::NotSupported,
              fmt::format("TOOL DEF {} without L and R", block.target)};
    case BlockKind::ToolCall:
      if (!block.spindle.is_programmed() || block.spindle.number <= kSlowSpindle) return {};
      return {Feature::FastSpindle, ErrorCode::WrongRpm,
              fmt::format("S {}", block.spindle.amount())};
    case BlockKind::Probe:
      return {Feature::TouchProbe, ErrorCode::NotSupported, "TCH PROBE"};
    default:
      return {};
  }
}

bool meets(const ControlVersion& version, const Demand& demand, Fault& fault) {
  if (demand.feature == Feature::Count || version.has(demand.feature)) return true;
  fault = {demand.code, 0, demand.words + ": " + version.lacks(demand.feature)};
  return false;
}

}  // namespace

bool check_version(const ControlVersion& version, const Block& block, Fault& fault) {
  return meets(version, demand_of(block), fault);
}

bool check_version(const ControlVersion& version, const IsoBlock& block, Fault& fault) {
  struct Code {
    IsoGroup group;
    int number;
    Feature feature;
  };
  for (const Code& code :
       {Code{IsoGroup::Stop, 38, Feature::StopBlock}, Code{IsoGroup::Tool, 51, Feature::NextTool},
        Code{IsoGroup::Probe, 55, Feature::TouchProbe}}) {
    if (!block.has_code(code.group, code.number)) continue;
    const Demand demand{code.feature, ErrorCode::IllegalGCode, fmt::format("G{}", code.number)};
    if (!meets(version, demand, fault)) return false;
  }
  return true;
}

}  // namespace dripline::interpreter::tnc155
