#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "clients/tools/tnc_conversion/conversion.hpp"
#include "clients/tools/tnc_conversion/mode_flow.hpp"
#include "clients/tools/tnc_conversion/rounding_use.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/blend_ahead.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/iso_block.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/word_check.hpp"

namespace dripline::tnc_conversion {

using namespace interpreter;
using namespace interpreter::tnc155;

namespace {

Result<void> refuse(std::uint64_t line, std::string_view what) {
  return fail(Errc::Unsupported, "line {}: {}", line, what);
}

/// A word takes G90 or G91 from before.
bool takes_distance(const IsoBlock& block) {
  const unsigned coordinates = distance_slots(block);
  for (std::size_t i = 0; i < kIsoSlots; ++i) {
    const auto slot = static_cast<IsoSlot>(i);
    if ((coordinates >> i & 1u) != 0 && block.distance(slot) == Distance::AsBefore) return true;
  }
  return false;
}

bool has_move(const IsoBlock& block) {
  unsigned slots = block.slots & ~kCenterSlots;
  if (block.has(IsoGroup::Corner) || block.has(IsoGroup::Tool)) slots &= ~kRadiusSlot;
  if (block.has(IsoGroup::Blank) || block.has(IsoGroup::Probe)) slots &= ~kAxisSlots;
  if (block.has_code(IsoGroup::Cycle, 28) || block.has_code(IsoGroup::Cycle, 54)) {
    slots &= ~kAxisSlots;
  }
  if (block.has_code(IsoGroup::Cycle, 73)) slots &= ~kAngleSlot;
  return slots != 0;
}

/// The modal functions that the block uses are the same on all paths to it.
Result<void> check_ways(const NumberedIsoBlock& numbered, const ModesBefore& before) {
  const IsoBlock& block = numbered.block;
  if (before.is_distance_open && takes_distance(block)) {
    return refuse(numbered.line,
                  "whether G90 or G91 is in force depends on where the run comes from");
  }
  if (!has_move(block)) return {};
  const bool has_motion = block.has(IsoGroup::Motion);
  if (before.is_motion_open && !has_motion) {
    return refuse(numbered.line, "the path function in force depends on where the run comes from");
  }
  const bool has_plane = block.has(IsoGroup::Plane) && !block.has_code(IsoGroup::Cycle, 73);
  if ((before.is_plane_open && !has_plane) ||
      (before.is_compensation_open && !block.has(IsoGroup::Compensation))) {
    return refuse(
        numbered.line,
        "whether a plane and a compensation were programmed depends on where the run comes from");
  }
  const int motion = has_motion ? block.code(IsoGroup::Motion) : before.modes.motion;
  if (before.is_turn_open && (motion == 5 || motion == 15)) {
    return refuse(numbered.line, "the direction repeated depends on where the run comes from");
  }
  return {};
}

class IsoToPlain {
 public:
  IsoToPlain(const IsoProgram& program, const ConversionOptions& options)
      : program_(program), options_(options) {}

  Result<std::string> run() {
    if (auto gathered = gather(); !gathered) return fail(gathered.error());
    CompensationTrack track(blocks_);
    for (std::size_t i = 0; i < blocks_.size(); ++i) {
      if (auto checked = check(track, i); !checked) return fail(checked.error());
      track.pass(blocks_[i]);
    }
    return write();
  }

 private:
  Result<void> gather() {
    const auto before = modes_before(program_);
    ReadingState state;
    BlockParts parts;
    Fault fault;
    bool is_gap = false;
    const bool calls_programs = std::any_of(
        program_.blocks.begin(), program_.blocks.end(),
        [](const NumberedIsoBlock& one) { return one.block.has_code(IsoGroup::Cycle, 39); });
    for (std::size_t i = 0; i < program_.blocks.size(); ++i) {
      const auto& [block, line] = program_.blocks[i];
      if (auto checked = check_ways(program_.blocks[i], before[i]); !checked) return checked;
      state.iso = before[i].modes;
      if (!resolve(block, i == 0, state, parts, fault)) {
        return fail(Errc::Syntax, "line {}, column 1: {}", line, fault.text());
      }
      for (const Block& part : parts) {
        if (is_taken(part, fault)) continue;
        return fail(Errc::Syntax, "line {}, column 1: {}", line, fault.text());
      }
      if (parts.count != 0 && is_gap && is_blend(*parts.begin())) {
        return refuse(line, "a corner after a block that plain language has none for");
      }
      if (calls_programs && parts.count > 1 &&
          std::any_of(parts.begin(), parts.end() - 1, is_positioning)) {
        return refuse(line, "a cycle that is a program may be called within the block");
      }
      is_gap = parts.count == 0;
      for (const Block& part : parts) {
        blocks_.push_back(part);
        lines_.push_back(line);
      }
    }
    complete_frame();
    return {};
  }

  bool is_taken(const Block& part, Fault& fault) const {
    const ControlVersion& version = options_.reading.version;
    return version.takes_all_blocks() || check_version(version, part, fault);
  }

  /// END PGM repeats the words of BEGIN PGM; in ISO the end of the text may replace it.
  void complete_frame() {
    if (blocks_.empty() || blocks_.front().kind != BlockKind::Begin) return;
    const Block& begin = blocks_.front();
    bool has_end = false;
    for (Block& block : blocks_) {
      if (block.kind != BlockKind::End) continue;
      has_end = true;
      block.is_protected = begin.is_protected;
    }
    if (has_end) return;
    Block end = begin;
    end.kind = BlockKind::End;
    blocks_.push_back(end);
    lines_.push_back(lines_.back());
  }

  Result<void> check(const CompensationTrack& track, std::size_t i) {
    const Block& block = blocks_[i];
    if (block.kind == BlockKind::ToolCall && (block.axis || block.is_fourth_axis))
      axis_ = block.axis;
    if (block.kind == BlockKind::Line && block.compensation > Compensation::Right) {
      return refuse(lines_[i], "G43 or G44 without an axis has no counterpart in plain language");
    }
    if (block.kind == BlockKind::Arc && block.coordinates[0].axis == Axis::C) {
      return refuse(lines_[i], "an arc that names C alone cannot be distinguished from CC");
    }
    if (block.kind == BlockKind::CycleDefinition && block.cycle == 10 && block.axis &&
        block.axis != axis_) {
      return refuse(lines_[i],
                    "G73 names another plane than that of the tool, which CYCL DEF 10 cannot");
    }
    if (block.kind != BlockKind::Rounding || block.rounding == RoundingUse::Unstated) return {};
    const RoundingUse use = track.use_of(blocks_, i);
    if (use == block.rounding) return {};
    return refuse(lines_[i], use == RoundingUse::Unstated
                                 ? "what RND would do depends on where the run comes from"
                                 : "RND in this place would not be the rounding, approach or "
                                   "departure that the G code says");
  }

  Result<std::string> write() const {
    std::string text;
    const bool has_begin = !blocks_.empty() && blocks_.front().kind == BlockKind::Begin;
    std::int32_t number = has_begin ? 0 : 1;
    for (Block block : blocks_) {
      if (number > kMaxNumber) {
        return fail(Errc::Unsupported, "more than {} blocks of plain language", kMaxNumber);
      }
      block.number = number++;
      block.rounding = RoundingUse::Unstated;
      write_plain_block(block, program_.units, options_.layout, text);
    }
    return text;
  }

  static constexpr std::int32_t kMaxNumber = 65'534;
  const IsoProgram& program_;
  const ConversionOptions& options_;
  std::vector<Block> blocks_;
  std::vector<std::uint64_t> lines_;
  std::optional<Axis> axis_ = Axis::Z;
};

}  // namespace

Result<std::string> to_plain(const IsoProgram& program, const ConversionOptions& options) {
  return IsoToPlain(program, options).run();
}

}  // namespace dripline::tnc_conversion
