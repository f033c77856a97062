#include <fmt/format.h>
#include <string_view>

#include "gateway/interpreter/dialects/tnc155/reading/iso_block.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/ranges.hpp"

namespace dripline::interpreter::tnc155 {
namespace {

constexpr int kMaxCodes = 8;
constexpr int kProgramDigits = 8;
constexpr std::string_view kSlotLetters = "IJKXYZABCUVWRH";  ///< in the order of IsoSlot

/// Reads the words of one block, in any order.
class IsoReader {
 public:
  IsoReader(const char* begin, const char* end, const ProgramForm& form, IsoBlock& block,
            Fault& fault)
      : cursor_(begin, end, form, fault), block_(block) {}

  bool read() {
    while (!cursor_.is_at_end()) {
      if (!read_word(cursor_.peek())) return false;
    }
    return finish();
  }

 private:
  bool read_word(char letter) {
    const char* start = cursor_.at();
    cursor_.advance();
    if (const std::size_t slot = kSlotLetters.find(letter); slot != std::string_view::npos)
      return read_slot(slot, letter);
    switch (letter) {
      case 'G':
        return read_g(start);
      case 'N':
        return read_once(block_.number, 0, kMaxBlockNumber, "N", start);
      case 'T':
        return read_once(block_.tool, 0, kMaxTool, "T", start);
      case 'M':
        return read_m(start);
      case 'F':
        return keep_place(feed_, start, letter);
      case 'L':
        return keep_place(label_, start, letter);
      case 'S':
        if (block_.spindle.is_programmed()) return twice(letter, start);
        return cursor_.read_value(block_.spindle, kSpindleSpeed, "S");
      case 'P':
        return read_parameter(start);
      case 'D':
        return read_function(start);
      case 'Q':
        return read_once(block_.parameter, 0, 99, "Q", start);
      case '%':
        return read_once(block_.program, 0, kMaxProgram, "%", start);
      default:
        cursor_.back_to(start);
        return cursor_.unexpected();
    }
  }

  bool twice(char letter, const char* start) {
    return cursor_.wrong(ErrorCode::BlockFormatIncorrect, start,
                         fmt::format("{} is programmed twice", letter));
  }
  bool read_once(std::int32_t& value, std::int32_t low, std::int32_t high, std::string_view name,
                 const char* start) {
    if (value != IsoBlock::kNone) return twice(name.front(), start);
    return cursor_.read_integer(value, low, high, name);
  }

  bool read_g(const char* start) {
    std::int32_t code = 0;
    if (!cursor_.read_integer(code, 0, 999, "G")) return false;
    const std::uint8_t group =
        code > 99 ? kIllegalCode : kGroupsOfCodes[static_cast<std::size_t>(code)];
    if (group == kDistanceCode) return take_distance(code, start);
    if (group == kIllegalCode) {
      return cursor_.wrong(ErrorCode::IllegalGCode, start, fmt::format("G{:02}", code));
    }
    if (block_.has(static_cast<IsoGroup>(group))) {
      return cursor_.wrong(
          ErrorCode::GCodeGroupAssigned, start,
          fmt::format("G{:02} after G{:02}", code, block_.code(static_cast<IsoGroup>(group))));
    }
    block_.set(static_cast<IsoGroup>(group), static_cast<std::uint8_t>(code));
    ++code_count_;
    return true;
  }

  bool take_distance(int code, const char* start) {
    if (block_.last_distance != Distance::AsBefore) {
      return cursor_.wrong(ErrorCode::GCodeGroupAssigned, start,
                           fmt::format("G{} directly after G90 or G91", code));
    }
    distance_ = code == 90 ? Distance::Absolute : Distance::Incremental;
    block_.last_distance = block_.written_distance = distance_;
    return true;
  }

  bool read_slot(std::size_t slot, char letter) {
    const auto name = static_cast<IsoSlot>(slot);
    if (block_.has(name)) return twice(letter, cursor_.at() - 1);
    block_.last_distance = Distance::AsBefore;
    Value& value = block_.add(name, distance_);
    axis_count_ += name >= IsoSlot::X && name <= IsoSlot::W ? 1 : 0;
    if (!cursor_.is_value_next()) {  // only the mirror cycle names axes alone
      value = Value{};
      bare_ |= 1u << slot;
      return true;
    }
    const bool is_rotary = name >= IsoSlot::A && name <= IsoSlot::C;
    const Range& range = name == IsoSlot::H ? kIncrementalAngle
                         : is_rotary        ? kRotaryCoordinate
                                            : coordinate_range(cursor_.form());
    return cursor_.read_value(value, range, {&letter, 1});
  }

  bool read_m(const char* start) {
    std::int32_t m = 0;
    if (block_.m != IsoBlock::kNone) return twice('M', start);
    if (!cursor_.read_integer(m, 0, 99, "M")) return false;
    block_.m = static_cast<std::int8_t>(m);
    return true;
  }

  /// What F and L mean depends on the G codes of the block, which may come later.
  bool keep_place(const char*& place, const char* start, char letter) {
    if (place) return twice(letter, start);
    if (!cursor_.is_value_next()) return cursor_.missing({&letter, 1});
    place = cursor_.at();
    if (letter == 'F') {
      std::int32_t whole = 0;
      is_short_feed_ = cursor_.read_short_integer(whole);
      if (is_short_feed_) return block_.feed = Value::steps(whole * Value::kStepsPerUnit), true;
    }
    cursor_.skip_value();
    return true;
  }

  bool read_parameter(const char* start) {
    std::size_t number = 0;
    for (int i = 0; i < 2; ++i) {
      if (!cursor_.is_digit_next()) return cursor_.missing("number of P");
      number = number * 10 + static_cast<std::size_t>(cursor_.peek() - '0');
      cursor_.advance();
    }
    if (number < 1 || number > 7) {
      return cursor_.wrong(ErrorCode::EntryOutOfRange, start,
                           fmt::format("P{:02} is not within P01 to P07", number));
    }
    if (block_.has_parameter(number)) return twice('P', start);
    block_.parameters = static_cast<std::uint8_t>(block_.parameters | 1u << number);
    block_.cycle[number] = IsoParameter{};
    if (number == 1 && cursor_.is_digit_next()) return read_first(block_.cycle[1].value);
    return read_parameter_value(block_.cycle[number]);
  }

  /// P01 of G39 is the number of a program, longer than other values are; G39 may come after it.
  bool read_first(Value& value) {
    const char* start = cursor_.at();
    if (block_.has_code(IsoGroup::Cycle, 39)) {
      return cursor_.read_integer(block_.called_program, 0, kMaxProgram, "P01");
    }
    std::int32_t whole = 0;
    if (!cursor_.read_short_integer(whole, kProgramDigits)) {
      return cursor_.read_value(value, kOperand, "P");
    }
    if (whole * kUnit > kOperand.high) long_first_ = start;
    value = Value::steps(long_first_ ? 0 : whole * Value::kStepsPerUnit);
    block_.called_program = whole;
    return true;
  }

  bool read_parameter_value(IsoParameter& parameter) {
    if (is_axis_letter(cursor_.peek())) {
      const char* start = cursor_.at();
      const Axis axis = axis_of_letter(cursor_.peek());
      cursor_.advance();
      const char sign = cursor_.peek();
      if (sign == '+' || sign == '-') {
        const char* after_axis = cursor_.at();
        cursor_.advance();
        if (!cursor_.is_value_next()) {
          parameter.axis = axis;
          parameter.direction = sign == '+' ? ProbeDirection::Positive : ProbeDirection::Negative;
          return true;
        }
        cursor_.back_to(after_axis);
      }
      // The point of a probing block follows its P03 as words of its own.
      if (block_.has(IsoGroup::Probe) || !cursor_.is_value_next())
        return cursor_.back_to(start), true;
      parameter.axis = axis;
      return cursor_.read_value(parameter.value, kOperand, "P");
    }
    if (!cursor_.is_value_next()) return true;  // P03 of a probing block
    return cursor_.read_value(parameter.value, kOperand, "P");
  }

  bool read_function(const char* start) {
    std::int32_t function = 0;
    if (block_.function != IsoBlock::kNone) return twice('D', start);
    if (!cursor_.read_integer(function, 0, 12, "D")) return false;
    block_.function = static_cast<std::int8_t>(function);
    return true;
  }

  bool finish() {
    if (code_count_ > kMaxCodes) {
      return cursor_.wrong(fmt::format("more than {} G functions", kMaxCodes));
    }
    if (bare_ != 0 && !are_bare_words_right()) return false;
    if (block_.has_parameter(1) && !finish_first()) return false;
    if (label_ && !read_label()) return false;
    if (feed_ && !read_feed()) return false;
    if (axis_count_ > max_axes()) {
      return cursor_.wrong(fmt::format("more than {} coordinates", max_axes()));
    }
    return is_alone() && check_radius() && check_angle();
  }

  /// %, D functions and label calls share their block with nothing but N and what belongs to them.
  bool is_alone() {
    constexpr unsigned kHead = 1u << static_cast<unsigned>(IsoGroup::Unit) |
                               1u << static_cast<unsigned>(IsoGroup::Protection);
    const bool is_program = block_.program != IsoBlock::kNone;
    const bool is_function = block_.function != IsoBlock::kNone;
    const bool is_call = block_.label != IsoBlock::kNone && !block_.has(IsoGroup::Label);
    if (!is_program && (block_.groups & kHead) != 0) {
      return cursor_.wrong("G50, G70 and G71 belong in the % block");
    }
    if (!is_function && block_.parameter != IsoBlock::kNone) {
      return cursor_.wrong("Q is programmed without a D function");
    }
    if (!is_program && !is_function && !is_call) return true;
    const bool has_words = block_.slots != 0 || block_.m != IsoBlock::kNone ||
                           block_.tool != IsoBlock::kNone || block_.feed.is_programmed() ||
                           block_.spindle.is_programmed() || block_.length.is_programmed() ||
                           block_.factor != IsoBlock::kNone ||
                           block_.last_distance != Distance::AsBefore;
    const bool is_two = is_program + is_function + (block_.label != IsoBlock::kNone) > 1;
    if (is_two || has_words || (block_.groups & ~(is_program ? kHead : 0u)) != 0 ||
        (!is_function && block_.parameters != 0)) {
      return cursor_.wrong(is_program    ? "% must be alone in its block"
                           : is_function ? "a D function must be alone in its block"
                                         : "a label call must be alone in its block");
    }
    return true;
  }

  int max_axes() const { return block_.has(IsoGroup::Cycle) ? 4 : 3; }

  bool are_bare_words_right() {
    if (block_.has_code(IsoGroup::Cycle, 28) && (bare_ & ~kAxisSlots) == 0 &&
        bare_ == block_.slots) {
      return true;
    }
    return cursor_.wrong("a coordinate has no value");
  }

  bool finish_first() {
    const Value& value = block_.cycle[1].value;
    if (block_.has_code(IsoGroup::Cycle, 39)) {
      const bool is_number = block_.called_program == IsoBlock::kNone && !block_.cycle[1].axis &&
                             value.kind == Value::Kind::Number && value.number >= 0 &&
                             value.number % Value::kStepsPerUnit == 0;
      if (is_number) block_.called_program = value.number / Value::kStepsPerUnit;
      return block_.called_program != IsoBlock::kNone ||
             cursor_.wrong(
                 fmt::format("P01 of G39 is the number of a program, 0 to {}", kMaxProgram));
    }
    block_.called_program = IsoBlock::kNone;
    if (!long_first_) return true;
    cursor_.back_to(long_first_);
    return cursor_.read_value(block_.cycle[1].value, kOperand, "P");
  }

  bool read_label() {
    const char* end = cursor_.at();
    cursor_.back_to(label_);
    if (block_.has_code(IsoGroup::Tool, 99)) {
      return cursor_.read_value(block_.length, coordinate_range(cursor_.form()), "L") &&
             is_whole(end);
    }
    const bool is_set = block_.has(IsoGroup::Label);
    if (!cursor_.read_integer(block_.label, 0, kMaxLabel, "L")) return false;
    if (!is_set && block_.label == 0) {
      return cursor_.wrong(ErrorCode::JumpToLabelZero, label_, "L0");
    }
    if (!is_set && cursor_.take('.') &&
        !cursor_.read_integer(block_.repeats, 0, kMaxRepeats, "L")) {
      return false;
    }
    return is_whole(end);
  }

  bool read_feed() {
    const char* end = cursor_.at();
    const bool is_dwell = block_.has_code(IsoGroup::Cycle, 4);
    const bool is_scale = block_.has_code(IsoGroup::Cycle, 72);
    cursor_.back_to(feed_);
    if (is_scale) {
      block_.feed = {};
      return cursor_.read_millionths(block_.factor, kMaxScale, "F") && is_whole(end);
    }
    const Range& range = is_dwell ? kSeconds : feed_range(cursor_.form());
    if (is_short_feed_ && block_.feed.number <= range.high) return go_back(end);
    return cursor_.read_value(block_.feed, range, "F") && is_whole(end);
  }

  bool go_back(const char* end) { return cursor_.back_to(end), true; }
  /// Nothing that was skipped with the value is left over.
  bool is_whole(const char* end) {
    return cursor_.is_value_next() ? cursor_.unexpected() : go_back(end);
  }

  /// The R of corners has no sign and no direction; that of a tool is a length.
  bool check_radius() {
    if (!block_.has(IsoGroup::Corner)) return true;
    if (!block_.has(IsoSlot::R)) return cursor_.missing("R");
    const Value& radius = block_.value(IsoSlot::R);
    const Range& range = radius_range(cursor_.form());
    if (!radius.is_q() && (radius.number < 0 || radius.number > range.high)) {
      return cursor_.wrong(ErrorCode::EntryOutOfRange, cursor_.at(),
                           fmt::format("R {} is not within 0 to {}", radius.amount(),
                                       static_cast<double>(range.high) / kUnit));
    }
    return true;
  }

  bool check_angle() {
    if (!block_.has(IsoSlot::H) || block_.distance(IsoSlot::H) != Distance::Absolute) return true;
    const Value& angle = block_.value(IsoSlot::H);
    if (angle.is_q() ||
        (angle.number >= kAbsoluteAngle.low && angle.number <= kAbsoluteAngle.high)) {
      return true;
    }
    return cursor_.wrong(ErrorCode::EntryOutOfRange, cursor_.at(),
                         fmt::format("H {} is not within -360 to 360", angle.amount()));
  }

  TextCursor cursor_;
  IsoBlock& block_;
  Distance distance_ = Distance::AsBefore;
  int code_count_ = 0;
  int axis_count_ = 0;
  unsigned bare_ = 0;  ///< slots without values
  bool is_short_feed_ = false;
  const char* long_first_ = nullptr;  ///< P01, where only a program's number can be so long
  const char* feed_ = nullptr;
  const char* label_ = nullptr;
};

void clear(IsoBlock& block) {
  block.number = block.tool = block.label = block.repeats = IsoBlock::kNone;
  block.program = block.called_program = block.parameter = block.factor = IsoBlock::kNone;
  block.groups = block.slots = 0;
  block.parameters = 0;
  block.m = block.function = IsoBlock::kNone;
  block.last_distance = block.written_distance = Distance::AsBefore;
  block.length = block.feed = block.spindle = Value{};
}

}  // namespace

bool read_iso_block(const char* begin, const char* end, const ProgramForm& form, IsoBlock& block,
                    Fault& fault) {
  clear(block);
  return IsoReader(begin, end, form, block, fault).read();
}

}  // namespace dripline::interpreter::tnc155
