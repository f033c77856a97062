#include <fmt/format.h>

#include <algorithm>

#include "clients/tools/tnc_conversion/conversion.hpp"
#include "clients/tools/tnc_conversion/cycle_to_iso.hpp"
#include "clients/tools/tnc_conversion/rounding_use.hpp"
#include "clients/tools/tnc_conversion/start_plane.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/iso_block.hpp"

namespace dripline::tnc_conversion {

using namespace interpreter;
using namespace interpreter::tnc155;

namespace {

/// The modal functions known from the ISO text so far; none are where a jump may lead to the block.
struct KnownModes {
  int motion = IsoBlock::kNone;
  Distance distance = Distance::AsBefore;
};

class PlainToIso {
 public:
  PlainToIso(const PlainProgram& program, const ConversionOptions& options)
      : program_(program), blocks_(program.blocks), options_(options) {}

  Result<std::string> run() {
    increment_ = options_.increment;
    if (static_cast<std::int64_t>(blocks_.size()) * increment_ > kLastNumber - 1) increment_ = 1;
    if (blocks_.size() > kMaxNumber) increment_ = 0;
    CompensationTrack track(blocks_);
    while (at_ < blocks_.size()) {
      const std::size_t begin = at_;
      iso_ = IsoBlock{};
      if (auto converted = convert(blocks_[at_], track); !converted) return fail(converted.error());
      for (; begin_pass_ < at_; ++begin_pass_) track.pass(blocks_[begin_pass_]);
      if (at_ == begin) return fail(Errc::Unsupported, "line {}: no counterpart", line());
    }
    complete_frame();
    return std::move(text_);
  }

 private:
  std::uint64_t line() const { return program_.lines[std::min(at_, blocks_.size() - 1)]; }
  Result<void> refuse(std::string_view what) const {
    return fail(Errc::Unsupported, "line {}: {}", line(), what);
  }

  /// The last block, where the text ends without END PGM.
  void complete_frame() {
    const auto is_end = [](const Block& block) { return block.kind == BlockKind::End; };
    if (blocks_.empty() || blocks_.front().kind != BlockKind::Begin ||
        std::any_of(blocks_.begin(), blocks_.end(), is_end)) {
      return;
    }
    iso_ = IsoBlock{};
    iso_.number = kLastNumber;
    add_frame(blocks_.front());
    write_iso_block(iso_, options_.layout, text_);
  }
  void add_frame(const Block& block) {
    iso_.program = block.target;
    iso_.set(IsoGroup::Unit, block.units == Units::Inch ? 70 : 71);
  }

  /// The block is done with `iso_`.
  Result<void> put(std::size_t count = 1) {
    write();
    at_ += count;
    return {};
  }
  void write() {
    const bool is_end = blocks_[at_].kind == BlockKind::End;
    const bool is_begin = blocks_[at_].kind == BlockKind::Begin;
    if (is_end) {
      iso_.number = kLastNumber;
    } else if (!is_begin && increment_ > 0) {
      iso_.number = number_ += increment_;
    }
    write_iso_block(iso_, options_.layout, text_);
  }

  Result<void> convert(const Block& block, const CompensationTrack& track) {
    const bool is_about_path =
        block.kind == BlockKind::Line && block.compensation != Compensation::NotProgrammed;
    if (is_flow(block) || is_move(block) || is_about_path) make_start_complete(block);
    has_flow_ |= is_flow(block);
    if (auto checked = check_tool_call(block); !checked) return checked;
    switch (block.kind) {
      case BlockKind::Begin:
      case BlockKind::End:
        if (block.kind == BlockKind::Begin && at_ != 0) return refuse("BEGIN PGM within a program");
        add_frame(block);
        if (block.is_protected && block.kind == BlockKind::Begin) {
          iso_.set(IsoGroup::Protection, 50);
        }
        return put();
      case BlockKind::ToolDefinition:
        return convert_tool_definition(block);
      case BlockKind::ToolCall:
        return convert_tool_call(block);
      case BlockKind::Stop:
        if (const auto& version = options_.reading.version; !version.has(Feature::StopBlock)) {
          return refuse("STOP is G38 in ISO: " + version.lacks(Feature::StopBlock));
        }
        iso_.set(IsoGroup::Stop, 38);
        iso_.m = block.m;
        return put();
      case BlockKind::CycleCall:
        iso_.set(IsoGroup::Call, 79);
        iso_.m = block.m;
        return put();
      case BlockKind::Chamfer:
        return convert_corner(block, 24);
      case BlockKind::Rounding:
        return convert_rounding(block, track);
      case BlockKind::Center:
        return convert_center(block);
      case BlockKind::Label:
      case BlockKind::LabelCall:
      case BlockKind::ProgramCall:
        return convert_flow(block);
      case BlockKind::Function:
        return convert_function(block);
      case BlockKind::CycleDefinition:
        return convert_cycle();
      case BlockKind::BlankForm:
        return convert_blank(block);
      case BlockKind::Probe:
        return convert_probe(block);
      default:
        return convert_path(block);
    }
  }

  static bool is_move(const Block& block) {
    return is_path(block) || block.kind == BlockKind::SingleAxis;
  }

  /// ISO presets nothing: what runs first has a plane and a compensation.
  void make_start_complete(const Block& block) {
    if (has_start_) return;
    has_start_ = true;
    const bool needs_compensation =
        is_flow(block) || block.compensation == Compensation::NotProgrammed;
    if (has_plane_ && !needs_compensation) return;
    IsoBlock start;
    has_own_plane_ = has_plane_;
    if (!has_plane_) start.set(IsoGroup::Plane, start_plane(blocks_));
    if (needs_compensation) start.set(IsoGroup::Compensation, 40);
    if (increment_ > 0) start.number = number_ += increment_;
    write_iso_block(start, options_.layout, text_);
  }
  /// The plane function that the conversion adds acts as a tool call in ISO, and the program has
  /// none.
  Result<void> check_tool_call(const Block& block) const {
    const bool is_call = block.kind == BlockKind::CycleCall || block.m == 99 || block.m == 89;
    const bool is_mirror = block.kind == BlockKind::CycleDefinition && block.cycle == 8;
    if (has_own_plane_ || !(is_call || is_mirror || block.kind == BlockKind::Probe)) return {};
    return refuse(
        "this needs a TOOL CALL with the spindle axis before all moves, labels and calls");
  }

  Result<void> convert_tool_definition(const Block& block) {
    const bool is_next = !block.length.is_programmed() && !block.radius.is_programmed();
    iso_.set(IsoGroup::Tool, is_next ? 51 : 99);
    iso_.tool = block.target;
    iso_.length = block.length;
    if (block.radius.is_programmed()) iso_.set(IsoSlot::R, block.radius, Distance::AsBefore);
    return put();
  }

  Result<void> convert_tool_call(const Block& block) {
    if (block.target == Block::kNone && !block.axis && !block.is_fourth_axis &&
        !block.spindle.is_programmed()) {
      return refuse("TOOL CALL without words has no counterpart in ISO");
    }
    iso_.tool = block.target;
    iso_.spindle = block.spindle;
    if (block.is_fourth_axis) iso_.set(IsoGroup::Plane, 20);
    if (block.axis) {
      const auto plane = plane_of_axis(*block.axis);
      if (!plane) return refuse("TOOL CALL with this axis has no counterpart in ISO; IV has: G20");
      iso_.set(IsoGroup::Plane, *plane);
    }
    has_plane_ |= iso_.has(IsoGroup::Plane);
    has_own_plane_ |= iso_.has(IsoGroup::Plane) && !has_flow_;
    return put();
  }

  Result<void> convert_corner(const Block& block, std::uint8_t code) {
    iso_.set(IsoGroup::Corner, code);
    iso_.set(IsoSlot::R, block.radius, Distance::AsBefore);
    return put();
  }

  Result<void> convert_rounding(const Block& block, const CompensationTrack& track) {
    const RoundingUse use = track.use_of(blocks_, at_);
    if (use == RoundingUse::Unstated) {
      return refuse("whether RND is G25, G26 or G27 depends on where the run comes from");
    }
    return convert_corner(block, use == RoundingUse::TangentialApproach    ? 26
                                 : use == RoundingUse::TangentialDeparture ? 27
                                                                           : 25);
  }

  Result<void> convert_center(const Block& block) {
    if (block.coordinate_count == 0) iso_.set(IsoGroup::Pole, 29);
    for (std::size_t i = 0; i < block.coordinate_count; ++i) {
      const Coordinate& coordinate = block.coordinates[i];
      if (coordinate.axis > Axis::Z) return refuse("CC with this axis has no counterpart in ISO");
      set_slot(iso_, static_cast<IsoSlot>(coordinate.axis), coordinate.value,
               coordinate.is_incremental);
    }
    sort_distances();
    return put();
  }

  Result<void> convert_flow(const Block& block) {
    if (block.kind == BlockKind::ProgramCall) {
      if (block.target == program_number()) return refuse("the program calls itself");
      iso_.program = block.target;
      return put();
    }
    known_ = {};
    iso_.label = block.target;
    if (block.kind == BlockKind::Label) iso_.set(IsoGroup::Label, 98);
    iso_.repeats = block.repeats;
    return put();
  }
  std::int32_t program_number() const {
    return blocks_.front().kind == BlockKind::Begin ? blocks_.front().target : Block::kNone;
  }

  Result<void> convert_function(const Block& block) {
    const bool is_jump = block.function >= 9;
    iso_.function = static_cast<std::int8_t>(block.function);
    if (!is_jump) iso_.parameter = block.target;
    set_parameter(iso_, 1, {block.first, {}, {}});
    if (block.second.is_programmed()) set_parameter(iso_, 2, {block.second, {}, {}});
    if (is_jump) set_parameter(iso_, 3, {whole(block.target), {}, {}});
    return put();
  }

  /// The sub-blocks that follow one another, as one block.
  Result<void> convert_cycle() {
    const auto rest = std::span(blocks_).subspan(at_);
    const std::size_t count = definition_length(rest);
    if (count == 0) return refuse("CYCL INCOMPLETE: the sub-blocks of the cycle are not complete");
    if (!add_definition_words(rest.first(count), iso_)) {
      return refuse("CYCL DEF 7 names an axis twice");
    }
    sort_distances();
    return put(count);
  }

  Result<void> convert_blank(const Block& block) {
    iso_.set(IsoGroup::Blank, block.is_maximum ? 31 : 30);
    const Axis axis = block.axis.value_or(Axis::Z);
    if (block.axis || !block.is_maximum) {
      if (!plane_of_axis(axis)) return refuse("BLK FORM with this axis has no counterpart in ISO");
      iso_.set(IsoGroup::Plane, *plane_of_axis(axis));
    }
    set_coordinates(iso_, block);
    sort_distances();
    return put();
  }

  Result<void> convert_probe(const Block& block) {
    const bool has_point = at_ + 1 < blocks_.size() && blocks_[at_ + 1].kind == BlockKind::Probe &&
                           blocks_[at_ + 1].part == 1;
    if (block.part != 0 || !has_point)
      return refuse("TCH PROBE 0.0 and 0.1 do not follow one another");
    iso_.set(IsoGroup::Probe, 55);
    set_parameter(iso_, 1, {whole(block.target), {}, {}});
    set_parameter(iso_, 2, {{}, block.axis, block.direction});
    set_parameter(iso_, 3, {});
    set_coordinates(iso_, blocks_[at_ + 1]);
    sort_distances();
    return put(2);
  }

  Result<void> convert_path(const Block& block) {
    const int motion = motion_of(block);
    if (motion == kNoMotion) return refuse("F MAX of this block has no counterpart in ISO");
    const bool moves = is_move(block);
    if (block.kind == BlockKind::PolarLine && !block.radius.is_programmed() &&
        !block.angle.is_programmed()) {
      return refuse("LP without PR and PA has no counterpart in ISO");
    }
    if (moves && (motion == 7 || motion != known_.motion)) {
      iso_.set(IsoGroup::Motion, static_cast<std::uint8_t>(motion));
    }
    if (moves && motion != 7) known_.motion = motion;
    if (block.compensation != Compensation::NotProgrammed) {
      iso_.set(IsoGroup::Compensation,
               static_cast<std::uint8_t>(static_cast<int>(block.compensation) + 39));
    }
    set_coordinates(iso_, block);
    if (block.radius.is_programmed()) {
      set_slot(iso_, IsoSlot::R, block.radius, block.is_radius_incremental);
    }
    if (block.angle.is_programmed())
      set_slot(iso_, IsoSlot::H, block.angle, block.is_angle_incremental);
    iso_.feed = block.feed;
    iso_.m = block.m;
    sort_distances();
    return put();
  }

  static constexpr int kNoMotion = -2;
  static int motion_of(const Block& block) {
    const bool is_clockwise = block.turn == Turn::Clockwise;
    switch (block.kind) {
      case BlockKind::Line:
        return block.is_rapid ? 0 : 1;
      case BlockKind::PolarLine:
        return block.is_rapid ? 10 : 11;
      case BlockKind::Arc:
        return block.is_rapid ? kNoMotion : is_clockwise ? 2 : 3;
      case BlockKind::PolarArc:
        return block.is_rapid ? kNoMotion : is_clockwise ? 12 : 13;
      case BlockKind::TangentArc:
        return block.is_rapid ? kNoMotion : 6;
      default:
        return block.is_rapid ? kNoMotion : 7;
    }
  }

  /// G90 and G91 only where they change something. Words of what is in force come first in the
  /// block, so the others need their own.
  void sort_distances() {
    Distance last = known_.distance;
    for (std::size_t i = 0; i < kIsoSlots; ++i) {
      const auto slot = static_cast<IsoSlot>(i);
      if (!iso_.has(slot) || iso_.distance(slot) == Distance::AsBefore) continue;
      if (iso_.distance(slot) == known_.distance) {
        iso_.set(slot, iso_.value(slot), Distance::AsBefore);
      } else {
        last = iso_.distance(slot);
      }
    }
    known_.distance = last;
  }

  static constexpr std::int32_t kLastNumber = 9'999;
  static constexpr std::size_t kMaxNumber = 65'000;
  const PlainProgram& program_;
  const std::vector<Block>& blocks_;
  const ConversionOptions& options_;
  std::int32_t increment_ = 10;
  std::int32_t number_ = 0;
  std::size_t at_ = 0;
  std::size_t begin_pass_ = 0;
  bool has_start_ = false;
  bool has_plane_ = false;
  bool has_own_plane_ = true;  ///< the program's; else the one the conversion added
  bool has_flow_ = false;
  KnownModes known_;
  IsoBlock iso_;
  std::string text_;
};

}  // namespace

Result<std::string> to_iso(const PlainProgram& program, const ConversionOptions& options) {
  return PlainToIso(program, options).run();
}

}  // namespace dripline::tnc_conversion
