#include "gateway/interpreter/dialects/tnc155/reading/iso_cycles.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>

#include "gateway/interpreter/dialects/tnc155/reading/cycle_names.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/iso_block.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/ranges.hpp"

namespace dripline::interpreter::tnc155 {
namespace {

/// Fills sub-block after sub-block from P01 on.
class CycleParts {
 public:
  CycleParts(const IsoBlock& block, Units units, BlockParts& parts, Fault& fault)
      : block_(block), units_(units), parts_(parts), fault_(fault) {}

  bool add(const CycleCode& code) {
    const auto rows = cycle_parts(code.cycle);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      Block& part = parts_.add(BlockKind::CycleDefinition);
      part.cycle = code.cycle;
      part.part = static_cast<std::uint8_t>(i);
      if (!fill(part, rows[i].field)) return false;
      if (rows[i].field == CycleField::FeedTurn) part.turn = code.turn;
    }
    if (block_.parameters >> next_ == 0) return true;
    return wrong(fmt::format("G{:02} has no P{:02}", block_.code(IsoGroup::Cycle), next_));
  }

 private:
  bool fill(Block& part, CycleField field) {
    const bool is_inch = units_ == Units::Inch;
    switch (field) {
      case CycleField::Name:
        return true;
      case CycleField::Length:
        return take(part.first, coordinates());
      case CycleField::Dwell:
        return take(part.first, kSeconds);
      case CycleField::Feed:
      case CycleField::FeedTurn:
        return take(part.feed, is_inch ? kInchFeed : kMetricFeed);
      case CycleField::Peck:
        return take(part.first, coordinates()) &&
               take(part.feed, is_inch ? kInchFeed : kMetricFeed);
      case CycleField::Radius:
        return take(part.radius, coordinates());
      case CycleField::Side:
        return take_side(part);
      case CycleField::Program:
        return take_program(part);
      default:
        return false;
    }
  }

  const Range& coordinates() const {
    return units_ == Units::Inch ? kInchCoordinate : kMetricCoordinate;
  }

  const IsoParameter* parameter() {
    if (block_.has_parameter(next_)) return &block_.cycle[next_++];
    wrong(fmt::format("P{:02} of G{:02} is missing", next_, block_.code(IsoGroup::Cycle)));
    return nullptr;
  }

  bool take(Value& value, const Range& range) {
    const std::size_t number = next_;
    const IsoParameter* from = parameter();
    if (!from) return false;
    if (from->axis || !from->value.is_programmed()) {
      return wrong(
          fmt::format("P{:02} of G{:02} is a plain number", number, block_.code(IsoGroup::Cycle)));
    }
    value = from->value;
    if (value.is_q()) return true;
    if (value.number >= range.low && value.number <= range.high &&
        !(range.is_whole && value.number % Value::kStepsPerUnit != 0)) {
      return true;
    }
    fault_ = {ErrorCode::EntryOutOfRange, 0,
              fmt::format("P{:02} {} is not {} {} to {}", number, value.amount(),
                          range.is_whole ? "a whole number within" : "within",
                          static_cast<double>(range.low) / kUnit,
                          static_cast<double>(range.high) / kUnit)};
    return false;
  }

  bool take_side(Block& part) {
    const std::size_t number = next_;
    const IsoParameter* from = parameter();
    if (!from) return false;
    if (!from->axis || !from->value.is_programmed()) {
      return wrong(fmt::format("P{:02} of G{:02} is an axis and a length", number,
                               block_.code(IsoGroup::Cycle)));
    }
    part.add({from->value, *from->axis, false});
    return true;
  }

  bool take_program(Block& part) {
    if (!parameter()) return false;
    part.target = block_.called_program;
    return true;
  }

  bool wrong(std::string detail) {
    fault_ = {ErrorCode::BlockFormatIncorrect, 0, std::move(detail)};
    return false;
  }

  const IsoBlock& block_;
  Units units_;
  BlockParts& parts_;
  Fault& fault_;
  std::size_t next_ = 1;
};

Block& add_part(BlockParts& parts, int cycle, int part) {
  Block& block = parts.add(BlockKind::CycleDefinition);
  block.cycle = static_cast<std::uint8_t>(cycle);
  block.part = static_cast<std::uint8_t>(part);
  return block;
}

bool is_missing(Fault& fault, std::string detail) {
  fault = {ErrorCode::BlockFormatIncorrect, 0, std::move(detail)};
  return false;
}

bool add_shift(const IsoBlock& block, unsigned incremental, BlockParts& parts, Fault& fault) {
  int part = 0;
  add_part(parts, 7, part);
  for (const IsoSlot slot : kAxisSlotList) {
    if (!block.has(slot)) continue;
    add_part(parts, 7, ++part)
        .add({block.value(slot), axis_of_slot(slot),
              (incremental >> static_cast<unsigned>(slot) & 1u) != 0});
  }
  return part > 0 ? true : is_missing(fault, "G54 has no axis");
}

bool add_mirror(const IsoBlock& block, BlockParts& parts, Fault& fault) {
  add_part(parts, 8, 0);
  Block& axes = add_part(parts, 8, 1);
  for (const IsoSlot slot : kAxisSlotList) {
    if (!block.has(slot)) continue;
    if (block.value(slot).is_programmed()) {
      fault = {ErrorCode::WrongAxis, 0, "mirrored axes have no values"};
      return false;
    }
    axes.add({{}, axis_of_slot(slot), false});
  }
  return true;
}

bool add_rotation(const IsoBlock& block, unsigned incremental, BlockParts& parts, Fault& fault) {
  if (!block.has(IsoSlot::H)) return is_missing(fault, "G73 has no H");
  add_part(parts, 10, 0);
  Block& part = add_part(parts, 10, 1);
  part.angle = block.value(IsoSlot::H);
  part.is_angle_incremental = (incremental >> static_cast<unsigned>(IsoSlot::H) & 1u) != 0;
  if (!part.angle.is_q() &&
      (part.angle.number < kAbsoluteAngle.low || part.angle.number > kAbsoluteAngle.high)) {
    fault = {ErrorCode::EntryOutOfRange, 0,
             fmt::format("H {} is not within -360 to 360", part.angle.amount())};
    return false;
  }
  if (block.has(IsoGroup::Plane)) part.axis = axis_of_plane(block.code(IsoGroup::Plane));
  return true;
}

struct CodeRow {
  int code;
  CycleCode cycle;
};
/// Of two codes for one cycle that for the clockwise direction is first.
constexpr std::array kCodes{CodeRow{83, {1, {}}},
                            CodeRow{84, {2, {}}},
                            CodeRow{74, {3, {}}},
                            CodeRow{75, {4, Turn::Clockwise}},
                            CodeRow{76, {4, Turn::Counterclockwise}},
                            CodeRow{77, {5, Turn::Clockwise}},
                            CodeRow{78, {5, Turn::Counterclockwise}},
                            CodeRow{54, {7, {}}},
                            CodeRow{28, {8, {}}},
                            CodeRow{4, {9, {}}},
                            CodeRow{73, {10, {}}},
                            CodeRow{72, {11, {}}},
                            CodeRow{39, {12, {}}}};

}  // namespace

unsigned slots_of_cycle(int code) {
  if (code == 54 || code == 28) return kAxisSlots;
  return code == 73 ? 1u << static_cast<unsigned>(IsoSlot::H) : 0u;
}

CycleCode cycle_of_code(int code) {
  const auto* at = std::find_if(kCodes.begin(), kCodes.end(),
                                [code](const CodeRow& row) { return row.code == code; });
  return at->cycle;
}

int code_of_cycle(int cycle, std::optional<Turn> turn) {
  const auto* at = std::find_if(kCodes.begin(), kCodes.end(), [&](const CodeRow& row) {
    const bool is_first = turn != Turn::Counterclockwise || row.cycle.turn != Turn::Clockwise;
    return row.cycle.cycle == cycle && is_first;
  });
  return at->code;
}

bool add_cycle(const IsoBlock& block, unsigned incremental, Units units, BlockParts& parts,
               Fault& fault) {
  const int code = block.code(IsoGroup::Cycle);
  const bool takes_parameters =
      code == 39 || code == 83 || code == 84 || (code >= 74 && code <= 78);
  if (takes_parameters) return CycleParts(block, units, parts, fault).add(cycle_of_code(code));
  if (block.parameters != 0) return is_missing(fault, fmt::format("G{:02} has no P", code));
  switch (code) {
    case 54:
      return add_shift(block, incremental, parts, fault);
    case 28:
      return add_mirror(block, parts, fault);
    case 73:
      return add_rotation(block, incremental, parts, fault);
    case 72:
      if (block.factor == IsoBlock::kNone) return is_missing(fault, "G72 has no F");
      add_part(parts, 11, 0);
      add_part(parts, 11, 1).factor = block.factor;
      return true;
    default:  // 04
      if (!block.feed.is_programmed()) return is_missing(fault, "G04 has no F");
      add_part(parts, 9, 0);
      add_part(parts, 9, 1).first = block.feed;
      return true;
  }
}

}  // namespace dripline::interpreter::tnc155
