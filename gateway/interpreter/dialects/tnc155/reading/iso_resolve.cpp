#include <fmt/format.h>
#include <bit>
#include <utility>

#include "gateway/interpreter/dialects/tnc155/reading/iso_block.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/iso_cycles.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/ranges.hpp"

namespace dripline::interpreter::tnc155 {
namespace {

constexpr unsigned bit(IsoGroup group) {
  return 1u << static_cast<unsigned>(group);
}

/// Auxiliary functions that take effect before the tool call of their block. Those that are about
/// the move of their block (M90 to M98) stay with it.
constexpr bool is_at_begin(int m) {
  return m == 3 || m == 4 || m == 7 || m == 8 || m == 11 || (m >= 13 && m <= 29) || m == 31 ||
         (m >= 36 && m <= 51) || (m >= 55 && m <= 59) || m == 61 || m == 62 || (m >= 71 && m <= 88);
}

class Resolver {
 public:
  Resolver(const IsoBlock& block, ReadingState& state, BlockParts& parts, Fault& fault)
      : block_(block), state_(state), modes_(state.iso), parts_(parts), fault_(fault) {}

  bool run(bool is_first) {
    parts_.clear();
    if (!resolve_all(is_first)) return false;
    for (std::size_t i = 0; i < parts_.count; ++i) parts_.blocks[i].number = block_.number;
    state_.iso = modes_;
    return true;
  }

 private:
  bool resolve_all(bool is_first) {
    if (block_.program != IsoBlock::kNone || block_.function != IsoBlock::kNone ||
        (block_.label != IsoBlock::kNone && !block_.has(IsoGroup::Label))) {
      return resolve_alone(block_, is_first, state_.program, parts_, fault_);
    }
    if (!resolve_distances()) return false;
    const unsigned other = block_.groups & ~(bit(IsoGroup::Motion) | bit(IsoGroup::Compensation));
    const bool is_move = other == 0 && (block_.slots & kCenterSlots) == 0 &&
                         block_.tool == IsoBlock::kNone && !block_.spindle.is_programmed() &&
                         block_.parameters == 0;
    if (!is_move) return resolve_functions();
    return block_.slots != 0 ? add_move(block_.slots) : add_tail();
  }

  bool wrong(ErrorCode code, std::string detail) {
    fault_ = {code, 0, std::move(detail)};
    return false;
  }
  bool wrong(std::string detail) {
    return wrong(ErrorCode::BlockFormatIncorrect, std::move(detail));
  }

  /// Which slots are incremental, and what is in force after the block: the distance of the last
  /// word as the control sorts them.
  bool resolve_distances() {
    if (block_.slots == 0 && block_.last_distance == Distance::AsBefore) return true;
    Distance last = block_.last_distance;
    const unsigned coordinates = distance_slots(block_);
    bool needs_mode = false;
    for (unsigned left = block_.slots; left != 0; left &= left - 1) {
      const auto slot = static_cast<IsoSlot>(std::countr_zero(left));
      const unsigned mask = left & (~left + 1);
      const Distance distance = block_.distance(slot);
      if (distance == Distance::AsBefore) {
        needs_mode |= (coordinates & mask) != 0;
        if (modes_.is_incremental) incremental_ |= coordinates & mask;
      } else {
        if (distance == Distance::Incremental) incremental_ |= mask;
        if (block_.last_distance == Distance::AsBefore) last = distance;
      }
    }
    if (needs_mode && !modes_.has_distance) {
      return wrong(ErrorCode::ProgramStartUndefined, "no G90 or G91 before the first coordinate");
    }
    if (last == Distance::AsBefore) return true;
    modes_.has_distance = true;
    modes_.is_incremental = last == Distance::Incremental;
    parts_.sorts_distances = last != block_.written_distance;
    return true;
  }
  bool is_incremental(IsoSlot slot) const {
    return (incremental_ >> static_cast<unsigned>(slot) & 1u) != 0;
  }

  bool resolve_functions() {
    const unsigned definitions =
        block_.groups & (bit(IsoGroup::Cycle) | bit(IsoGroup::Blank) | bit(IsoGroup::Probe));
    if (std::popcount(definitions) > 1) return wrong("two definitions in one block");
    if (definitions != 0 && block_.has(IsoGroup::Corner)) {
      return wrong("a definition is between the corner and its move");
    }
    if ((block_.m == 91 || block_.m == 92) &&
        (block_.has(IsoGroup::Blank) || block_.has(IsoGroup::Probe) ||
         (block_.slots & kCenterSlots) != 0)) {
      return wrong(fmt::format("M{} is for the coordinates of a move", block_.m));
    }
    unsigned slots = block_.slots;
    const bool has_call = has_tool_call();
    const bool has_early_m = has_call && block_.m != IsoBlock::kNone && is_at_begin(block_.m);
    if (block_.has(IsoGroup::Label) && !add_label()) return false;
    if (has_early_m) parts_.add(BlockKind::Line).m = block_.m;
    is_m_done_ = has_early_m;
    if (has_call) add_tool_call();
    return (!block_.has(IsoGroup::Tool) || add_tool_definition(slots)) && add_center(slots) &&
           add_definition(slots) && add_rest(slots);
  }

  bool add_label() {
    if (block_.label == IsoBlock::kNone) return wrong("G98 has no L");
    parts_.add(BlockKind::Label).target = block_.label;
    return true;
  }

  /// The plane of a blank or a rotation belongs to them.
  bool has_own_plane() const {
    return block_.has(IsoGroup::Blank) || block_.has_code(IsoGroup::Cycle, 73);
  }
  bool has_tool_call() const {
    return (block_.tool != IsoBlock::kNone && !block_.has(IsoGroup::Tool)) ||
           block_.spindle.is_programmed() || (block_.has(IsoGroup::Plane) && !has_own_plane());
  }
  void add_tool_call() {
    Block& part = parts_.add(BlockKind::ToolCall);
    if (!block_.has(IsoGroup::Tool)) part.target = block_.tool;
    part.spindle = block_.spindle;
    if (!block_.has(IsoGroup::Plane) || has_own_plane()) return;
    modes_.has_plane = true;
    part.axis = axis_of_plane(block_.code(IsoGroup::Plane));
    part.is_fourth_axis = block_.code(IsoGroup::Plane) == 20;
  }

  bool add_tool_definition(unsigned& slots) {
    const int code = block_.code(IsoGroup::Tool);
    if (block_.tool == IsoBlock::kNone) return wrong(fmt::format("G{} has no T", code));
    if (block_.tool == 0) {
      return wrong(ErrorCode::EntryOutOfRange, fmt::format("T 0 is not within 1 to {}", kMaxTool));
    }
    Block& part = parts_.add(BlockKind::ToolDefinition);
    part.target = block_.tool;
    if (code == 51) return true;
    part.length = block_.length;
    if (block_.has(IsoSlot::R)) part.radius = block_.value(IsoSlot::R);
    slots &= ~kRadiusSlot;
    return true;
  }

  bool add_center(unsigned& slots) {
    const bool takes_over = block_.has(IsoGroup::Pole);
    if (!takes_over && (slots & kCenterSlots) == 0) return true;
    if (takes_over && (slots & kCenterSlots) != 0) return wrong("G29 and I, J or K in one block");
    if (std::popcount(slots & kCenterSlots) > 2) return wrong("more than two of I, J and K");
    Block& part = parts_.add(BlockKind::Center);
    for (unsigned left = slots & kCenterSlots; left != 0; left &= left - 1) {
      const auto slot = static_cast<IsoSlot>(std::countr_zero(left));
      part.add({block_.value(slot), static_cast<Axis>(slot), is_incremental(slot)});
    }
    slots &= ~kCenterSlots;
    return true;
  }

  bool add_definition(unsigned& slots) {
    if (block_.has(IsoGroup::Blank)) return add_blank(slots);
    if (block_.has(IsoGroup::Probe)) return add_probe(slots);
    if (!block_.has(IsoGroup::Cycle))
      return block_.parameters == 0 || wrong("P is programmed without a cycle");
    is_feed_done_ = block_.has_code(IsoGroup::Cycle, 4) || block_.has_code(IsoGroup::Cycle, 72);
    slots &= ~slots_of_cycle(block_.code(IsoGroup::Cycle));
    return add_cycle(block_, incremental_, state_.program.units, parts_, fault_);
  }

  void add_axes(Block& part, unsigned slots) {
    for (unsigned left = slots & kAxisSlots; left != 0; left &= left - 1) {
      const auto slot = static_cast<IsoSlot>(std::countr_zero(left));
      part.add({block_.value(slot), axis_of_slot(slot), is_incremental(slot)});
    }
  }

  bool add_blank(unsigned& slots) {
    const bool is_maximum = block_.code(IsoGroup::Blank) == 31;
    if (block_.parameters != 0 || std::popcount(slots & kAxisSlots) != 3) {
      return wrong(ErrorCode::BlankFormIncorrect, "three coordinates are needed");
    }
    if (!is_maximum && !block_.has(IsoGroup::Plane)) {
      return wrong(ErrorCode::BlankFormIncorrect, "G30 has no plane");
    }
    if (!is_maximum && (incremental_ & kAxisSlots) != 0) {
      return wrong(ErrorCode::BlankFormIncorrect, "the MIN corner is not incremental");
    }
    Block& part = parts_.add(BlockKind::BlankForm);
    part.is_maximum = is_maximum;
    if (block_.has(IsoGroup::Plane)) part.axis = axis_of_plane(block_.code(IsoGroup::Plane));
    add_axes(part, slots);
    slots &= ~kAxisSlots;
    return true;
  }

  bool add_probe(unsigned& slots) {
    const IsoParameter& result = block_.cycle[1];
    const IsoParameter& direction = block_.cycle[2];
    if (block_.parameters != 0b1110 || block_.cycle[3].axis ||
        block_.cycle[3].value.is_programmed() || !direction.axis || !direction.direction ||
        (slots & kAxisSlots) == 0 || result.value.kind != Value::Kind::Number ||
        result.value.number < 0 || result.value.number > 99 * Value::kStepsPerUnit ||
        result.value.number % Value::kStepsPerUnit != 0) {
      return wrong("G55 has P01 and a Q number, P02 and a direction, P03 and a point");
    }
    Block& plane = parts_.add(BlockKind::Probe);
    plane.target = result.value.number / Value::kStepsPerUnit;
    plane.axis = direction.axis;
    plane.direction = *direction.direction;
    Block& point = parts_.add(BlockKind::Probe);
    point.part = 1;
    add_axes(point, slots);
    slots &= ~kAxisSlots;
    return true;
  }

  /// The move with its corner, M, the call, the stop. M of a stop that moves nothing is the stop's.
  bool add_rest(unsigned slots) {
    const unsigned move = block_.has(IsoGroup::Corner) ? slots & ~kRadiusSlot : slots;
    const bool has_call = block_.has(IsoGroup::Call);
    const bool stops_after = (move != 0 || has_call) && block_.m != 0;  // M00 stops itself
    if (block_.has(IsoGroup::Stop) && move == 0 && !has_call) {
      Block& part = parts_.add(BlockKind::Stop);
      if (!std::exchange(is_m_done_, true)) part.m = block_.m;
    }
    is_m_for_call_ = has_call && move == 0;
    if (block_.has(IsoGroup::Corner) && (move & kAngleSlot) != 0) {
      return wrong("a corner and a polar move need R both");
    }
    if (!(move != 0 ? add_move(move) : add_tail())) return false;
    if (block_.has(IsoGroup::Corner)) add_corner();
    if (has_call) {
      Block& part = parts_.add(BlockKind::CycleCall);
      if (is_m_for_call_ && !is_m_done_) part.m = block_.m;
    }
    if (block_.has(IsoGroup::Stop) && stops_after) parts_.add(BlockKind::Stop);
    return true;
  }

  void add_corner() {
    const int code = block_.code(IsoGroup::Corner);
    Block& part = parts_.add(code == 24 ? BlockKind::Chamfer : BlockKind::Rounding);
    part.radius = block_.value(IsoSlot::R);
    if (code == 25) part.rounding = RoundingUse::Corner;
    if (code == 26) part.rounding = RoundingUse::TangentialApproach;
    if (code == 27) part.rounding = RoundingUse::TangentialDeparture;
  }

  Compensation compensation() const {
    if (!block_.has(IsoGroup::Compensation)) return Compensation::NotProgrammed;
    return static_cast<Compensation>(block_.code(IsoGroup::Compensation) - 40 +
                                     static_cast<int>(Compensation::Off));
  }

  /// A block without a move leaves what it switches: feed, compensation, M, the path function.
  bool add_tail() {
    if (block_.has(IsoGroup::Compensation)) modes_.has_compensation = true;
    if (block_.has(IsoGroup::Motion) && block_.code(IsoGroup::Motion) != 7) {
      modes_.motion = block_.code(IsoGroup::Motion);
      note_turn(modes_.motion);
    }
    const bool has_m = block_.m != IsoBlock::kNone && !is_m_done_ && !is_m_for_call_;
    const bool has_feed = block_.feed.is_programmed() && !is_feed_done_;
    if (!has_m && !has_feed && !block_.has(IsoGroup::Compensation)) return true;
    Block& part = parts_.add(BlockKind::Line);
    part.compensation = compensation();
    if (has_feed) part.feed = block_.feed;
    if (has_m) part.m = block_.m;
    return true;
  }

  void note_turn(int motion) {
    if (motion == 2 || motion == 12) modes_.last_turn = Turn::Clockwise;
    if (motion == 3 || motion == 13) modes_.last_turn = Turn::Counterclockwise;
  }

  bool add_move(unsigned slots) {
    const bool has_motion = block_.has(IsoGroup::Motion);
    const std::uint8_t motion = has_motion ? block_.code(IsoGroup::Motion) : modes_.motion;
    const bool has_compensation = block_.has(IsoGroup::Compensation);
    modes_.has_compensation |= has_compensation;
    if (motion == IsoModes::kUnset || !modes_.has_plane || !modes_.has_compensation) {
      return is_incomplete(motion);
    }
    if (has_motion && motion != 7) modes_.motion = motion;
    note_turn(motion);
    Block& part = parts_.add(BlockKind::Line);
    part.compensation = compensation();
    part.is_rapid = motion == 0 || motion == 10;
    if (!is_feed_done_) part.feed = block_.feed;
    // The manual does not state whether the blocks after it would have this feed.
    if (part.is_rapid && part.feed.is_programmed()) {
      return wrong(
          fmt::format("F with G{:02}: it belongs in the block that has this feed", motion));
    }
    if (!is_m_done_) part.m = block_.m;
    if (has_compensation && (part.compensation > Compensation::Right
                                 ? motion != 7
                                 : part.compensation != Compensation::Off && motion == 7)) {
      return wrong(motion == 7 ? "G07 goes with G40, G43 or G44" : "G43 and G44 are for G07");
    }
    add_axes(part, slots);
    return set_path(part, motion, slots);
  }

  bool is_incomplete(int motion) {
    const char* missing = motion == IsoModes::kUnset ? "path function"
                          : !modes_.has_plane        ? "plane"
                                                     : "compensation";
    return wrong(ErrorCode::ProgramStartUndefined,
                 fmt::format("the first move has no {} (G code)", missing));
  }

  bool set_path(Block& part, int motion, unsigned slots) {
    const bool is_polar = motion >= 10;
    if (!is_polar && (slots & (kRadiusSlot | kAngleSlot)) != 0) {
      return wrong(fmt::format("R and H do not go with G{:02}", motion));
    }
    switch (motion) {
      case 0:
      case 1:
        return true;
      case 2:
      case 3:
      case 5:
        part.kind = BlockKind::Arc;
        if (part.coordinate_count > 2) return wrong("a circle has two coordinates");
        return set_turn(part, motion);
      case 6:
        part.kind = BlockKind::TangentArc;
        return part.coordinate_count <= 2 ? true : wrong("a circle has two coordinates");
      case 7:
        part.kind = BlockKind::SingleAxis;
        return part.coordinate_count == 1 ? true : wrong("G07 moves one axis");
      case 10:
      case 11:
        part.kind = BlockKind::PolarLine;
        if (part.coordinate_count != 0) return wrong("a polar line has no axis words");
        return set_polar(part, slots);
      default:
        part.kind = BlockKind::PolarArc;
        if (part.coordinate_count > 1) return wrong("a polar circle has one axis word at most");
        if ((slots & kRadiusSlot) != 0) return wrong("a polar circle has no R");
        if ((slots & kAngleSlot) == 0) return wrong("a polar circle has an H");
        return set_polar(part, slots) && set_turn(part, motion);
    }
  }

  bool set_turn(Block& part, int motion) {
    if (!modes_.last_turn) {
      return wrong(ErrorCode::ProgramStartUndefined,
                   fmt::format("G{:02} repeats a direction, and there is none yet", motion));
    }
    part.turn = modes_.last_turn;
    return true;
  }

  bool set_polar(Block& part, unsigned slots) {
    if ((slots & kRadiusSlot) != 0) {
      part.radius = block_.value(IsoSlot::R);
      part.is_radius_incremental = is_incremental(IsoSlot::R);
    }
    if ((slots & kAngleSlot) == 0) return true;
    part.angle = block_.value(IsoSlot::H);
    part.is_angle_incremental = is_incremental(IsoSlot::H);
    const Range& range = angle_range(part.is_angle_incremental);
    if (part.angle.is_q() || (part.angle.number >= range.low && part.angle.number <= range.high))
      return true;
    return wrong(ErrorCode::EntryOutOfRange,
                 fmt::format("H {} is not within -360 to 360", part.angle.amount()));
  }

  const IsoBlock& block_;
  ReadingState& state_;
  IsoModes modes_;
  BlockParts& parts_;
  Fault& fault_;
  unsigned incremental_ = 0;  ///< slots
  bool is_m_done_ = false;
  bool is_m_for_call_ = false;
  bool is_feed_done_ = false;
};

}  // namespace

bool resolve(const IsoBlock& block, bool is_first, ReadingState& state, BlockParts& parts,
             Fault& fault) {
  return Resolver(block, state, parts, fault).run(is_first);
}

}  // namespace dripline::interpreter::tnc155
