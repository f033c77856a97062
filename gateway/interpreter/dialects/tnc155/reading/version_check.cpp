#include "gateway/interpreter/dialects/tnc155/reading/version_check.hpp"

#include <fmt/format.h>

namespace dripline::interpreter::tnc155 {
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
