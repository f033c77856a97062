#include <fmt/format.h>

#include <array>

#include "gateway/interpreter/dialects/tnc155/reading/cycle_names.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/plain_reader.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/ranges.hpp"

namespace dripline::interpreter::tnc155::plain {
namespace {

/// After the F.
bool read_needed_feed(TextCursor& cursor, Block& block) {
  return cursor.read_value(block.feed, feed_range(cursor.form()), "F");
}

bool read_side(TextCursor& cursor, Block& block) {
  if (!read_coordinate(cursor, block)) return false;
  return block.coordinates[0].is_incremental ? cursor.wrong("a side is not incremental") : true;
}

bool read_axes(TextCursor& cursor, Block& block) {
  while (is_axis_letter(cursor.peek())) {
    const Axis axis = axis_of_letter(cursor.peek());
    if (block.names(axis)) return cursor.wrong("an axis is programmed twice");
    if (block.coordinate_count == 4) {
      return cursor.wrong("more than 4 axes");
    }
    cursor.advance();
    if (cursor.is_value_next()) {
      return cursor.wrong(ErrorCode::WrongAxis, cursor.at(), "mirrored axes have no values");
    }
    block.add({.value = {}, .axis = axis});
  }
  return true;
}

bool read_rotation(TextCursor& cursor, Block& block) {
  block.is_angle_incremental = cursor.take('I');
  if (!cursor.take("ROT")) return cursor.unexpected();
  return cursor.read_value(block.angle, kAbsoluteAngle, "ROT");
}

bool has_word(CycleField field) {
  return field != CycleField::Side && field != CycleField::Shift && field != CycleField::Axes &&
         field != CycleField::Rotation;
}

bool is_word_character(char c) {
  return (c >= 'A' && c <= 'Z') || static_cast<unsigned char>(c) >= 0x80;
}

/// A word of the control's own table, which is another one's name.
bool takes_known_word(TextCursor& cursor, bool is_name) {
  for (int cycle = 1; cycle <= kLastCycle; ++cycle) {
    for (const CyclePart& part : cycle_parts(cycle)) {
      if (has_word(part.field) && (part.field == CycleField::Name) == is_name &&
          cursor.take(part.word)) {
        return true;
      }
    }
  }
  return false;
}

/// The word of a control that was set to another language, up to its value or the block's end: the
/// number of the sub-block says what it is. A point or hyphen before a letter belongs to the word.
bool read_foreign_word(TextCursor& cursor, const CyclePart& part) {
  bool has_any = false;
  for (;; cursor.advance()) {
    const char c = cursor.peek();
    if (cursor.is_at_end() || (c == 'Q' && TextCursor::is_digit(cursor.at()[1]))) break;
    if (is_word_character(c)) {
      has_any = true;
      continue;
    }
    if (c != '.' && c != '-' && c != '\'') break;
    const bool is_value = TextCursor::is_digit(cursor.at()[1]);
    if (is_value && c == '.' && has_any) {
      return cursor.wrong(
          fmt::format("the point before {} is of the word or of the value", cursor.at()[1]));
    }
    if (!is_word_character(cursor.at()[1]) && c != '.') break;
  }
  return has_any || cursor.wrong(fmt::format("{} is missing", part.word));
}

/// Whether the sub-block may name its word in another language.
bool has_translated_word(CycleField field) {
  using enum CycleField;
  return field == Name || field == Length || field == Dwell || field == Peck || field == Radius ||
         field == Scale;
}

bool read_word(TextCursor& cursor, const CyclePart& part) {
  if (cursor.take(part.word)) return true;
  if (part.word == "SET-UP" && cursor.take("SETUP")) return true;  // as some listings have it
  if (part.word.starts_with("PECK") && (cursor.take("PECKING") || cursor.take("PECKG")))
    return true;
  if (!has_translated_word(part.field) ||
      takes_known_word(cursor, part.field == CycleField::Name)) {
    return cursor.wrong(fmt::format("{} is missing", part.word));
  }
  return read_foreign_word(cursor, part);
}

bool read_field(TextCursor& cursor, Block& block, const CyclePart& part) {
  const Range& lengths = coordinate_range(cursor.form());
  switch (part.field) {
    case CycleField::Name:
      return true;
    case CycleField::Length:
      return cursor.read_value(block.first, lengths, part.word);
    case CycleField::Dwell:
      return cursor.read_value(block.first, kSeconds, part.word);
    case CycleField::Feed:
      return read_needed_feed(cursor, block);
    case CycleField::Peck:
      if (!cursor.read_value(block.first, lengths, part.word)) return false;
      return cursor.take('F') ? read_needed_feed(cursor, block) : cursor.missing("F");
    case CycleField::FeedTurn:
      if (!read_needed_feed(cursor, block)) return false;
      return cursor.take('D') ? read_turn(cursor, block) : cursor.missing("DR");
    case CycleField::Radius:
      return cursor.read_value(block.radius, lengths, part.word);
    case CycleField::Scale:
      return cursor.read_millionths(block.factor, kMaxScale, part.word);
    case CycleField::Program:
      return cursor.read_integer(block.target, 0, kMaxProgram, part.word);
    case CycleField::Side:
      return read_side(cursor, block);
    case CycleField::Shift:
      return read_coordinate(cursor, block);
    case CycleField::Axes:
      return read_axes(cursor, block);
    case CycleField::Rotation:
      return read_rotation(cursor, block);
  }
  return false;
}

bool are_three(TextCursor& cursor, const Block& block) {
  return block.coordinate_count == 3 ? true : cursor.wrong("BLK FORM needs three coordinates");
}

/// A spindle axis is a letter with another letter after it.
void read_spindle_axis(TextCursor& cursor, Block& block) {
  const char* start = (cursor.peek(), cursor.at());
  if (!is_axis_letter(cursor.peek())) return;
  const Axis axis = axis_of_letter(cursor.peek());
  cursor.advance();
  if (cursor.is_value_next()) return cursor.back_to(start);
  block.axis = axis;
}

bool read_reference_plane(TextCursor& cursor, Block& block) {
  cursor.take("REF. PLANE");
  if (!cursor.take('Q')) return cursor.missing("Q");
  if (!cursor.read_integer(block.target, 0, 99, "Q")) return false;
  if (!is_axis_letter(cursor.peek())) return cursor.missing("probing axis");
  block.axis = axis_of_letter(cursor.peek());
  cursor.advance();
  if (cursor.take('+')) {
    block.direction = ProbeDirection::Positive;
  } else if (!cursor.take('-')) {
    return cursor.missing("probing direction");
  }
  return cursor.ends();
}

bool read_operand(TextCursor& cursor, Value& value) {
  return cursor.read_value(value, kOperand, "operand");
}

/// After the sign of equality.
bool read_calculation(TextCursor& cursor, Block& block) {
  static constexpr std::array<std::string_view, 9> kOperators{"",     "+",   "-",   "*",  "DIV",
                                                              "SQRT", "SIN", "COS", "LEN"};
  const std::string_view name = kOperators[block.function];
  const bool is_unary = block.function >= 5 && block.function <= 7;
  if (is_unary && !cursor.take(name)) return cursor.wrong(fmt::format("{} is missing", name));
  if (!read_operand(cursor, block.first)) return false;
  if (is_unary || block.function == 0) return cursor.ends();
  if (!cursor.take(name)) return cursor.wrong(fmt::format("{} is missing", name));
  return read_operand(cursor, block.second) && cursor.ends();
}

bool read_jump(TextCursor& cursor, Block& block) {
  static constexpr std::array<std::string_view, 4> kRelations{"EQU", "NE", "GT", "LT"};
  const std::string_view name = kRelations[block.function - 9u];
  if (!cursor.take("IF")) return cursor.wrong("IF is missing");
  if (!read_operand(cursor, block.first)) return false;
  if (!cursor.take(name)) return cursor.wrong(fmt::format("{} is missing", name));
  if (!read_operand(cursor, block.second)) return false;
  if (!cursor.take("GOTO LBL")) return cursor.wrong("GOTO LBL is missing");
  const char* start = (cursor.peek(), cursor.at());
  if (!cursor.read_integer(block.target, 0, kMaxLabel, "GOTO LBL")) return false;
  if (block.target == 0) return cursor.wrong(ErrorCode::JumpToLabelZero, start, "GOTO LBL 0");
  return cursor.ends();
}

}  // namespace

bool read_cycle(TextCursor& cursor, Block& block) {
  block.kind = BlockKind::CycleDefinition;
  const char* start = (cursor.peek(), cursor.at());
  std::int32_t cycle = 0;
  std::int32_t part = 0;
  if (!cursor.read_integer(cycle, 0, 99, "CYCL DEF")) return false;
  if (!cursor.take('.')) return cursor.missing("sub-block");
  if (!cursor.read_integer(part, 0, 99, "CYCL DEF")) return false;
  const auto parts = cycle_parts(cycle);
  if (static_cast<std::size_t>(part) >= parts.size()) {
    return cursor.wrong(ErrorCode::BlockFormatIncorrect, start,
                        fmt::format("there is no CYCL DEF {}.{}", cycle, part));
  }
  block.cycle = static_cast<std::uint8_t>(cycle);
  block.part = static_cast<std::uint8_t>(part);
  const CyclePart& row = parts[static_cast<std::size_t>(part)];
  if (has_word(row.field) && !read_word(cursor, row)) return false;
  return read_field(cursor, block, row) && cursor.ends();
}

bool read_blank_form(TextCursor& cursor, Block& block, bool has_def) {
  block.kind = BlockKind::BlankForm;
  if (cursor.take(has_def ? "MAX" : "0.2")) {
    block.is_maximum = true;
  } else if (!cursor.take(has_def ? "MIN" : "0.1")) {
    return cursor.missing("BLK FORM");
  }
  read_spindle_axis(cursor, block);
  if (!read_coordinates(cursor, block, 3) || !are_three(cursor, block)) return false;
  for (std::size_t i = 0; i < 3 && !block.is_maximum; ++i) {
    if (block.coordinates[i].is_incremental) {
      return cursor.wrong(ErrorCode::BlankFormIncorrect, cursor.at(),
                          "the MIN corner is not incremental");
    }
  }
  return cursor.ends();
}

bool read_probe(TextCursor& cursor, Block& block) {
  block.kind = BlockKind::Probe;
  if (cursor.take("0.0")) return read_reference_plane(cursor, block);
  if (!cursor.take("0.1")) return cursor.missing("TCH PROBE");
  block.part = 1;
  if (!read_coordinates(cursor, block, 3)) return false;
  return block.coordinate_count > 0 ? cursor.ends() : cursor.missing("TCH PROBE 0.1");
}

bool read_function(TextCursor& cursor, Block& block) {
  block.kind = BlockKind::Function;
  std::int32_t function = 0;
  if (!cursor.read_integer(function, 0, 12, "FN")) return false;
  block.function = static_cast<std::uint8_t>(function);
  cursor.take(':');
  if (function >= 9) return read_jump(cursor, block);
  if (!cursor.take('Q')) return cursor.missing("Q");
  if (!cursor.read_integer(block.target, 0, 99, "Q")) return false;
  if (!cursor.take('=')) return cursor.missing("=");
  return read_calculation(cursor, block);
}

}  // namespace dripline::interpreter::tnc155::plain
