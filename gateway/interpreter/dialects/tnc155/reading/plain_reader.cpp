#include "gateway/interpreter/dialects/tnc155/reading/plain_reader.hpp"

#include "gateway/interpreter/dialects/tnc155/reading/ranges.hpp"

namespace dripline::interpreter::tnc155 {
namespace {

using namespace plain;

/// After BEGIN or END.
bool read_frame(TextCursor& cursor, Block& block, BlockKind kind) {
  block.kind = kind;
  if (!cursor.take("PGM")) return cursor.unexpected();
  if (!cursor.read_integer(block.target, 0, kMaxProgram, "PGM")) return false;
  if (cursor.take("INCH")) {
    block.units = Units::Inch;
  } else if (!cursor.take("MM")) {
    return cursor.missing("MM or INCH");
  }
  block.is_protected = cursor.take('P');
  return cursor.ends();
}

bool read_tool_definition(TextCursor& cursor, Block& block) {
  block.kind = BlockKind::ToolDefinition;
  if (!cursor.read_integer(block.target, 1, kMaxTool, "TOOL DEF")) return false;
  const Range& range = coordinate_range(cursor.form());
  if (cursor.take('L') && !cursor.read_value(block.length, range, "L")) return false;
  if (cursor.take('R') && !cursor.read_value(block.radius, range, "R")) return false;
  return cursor.ends();
}

bool read_tool_call(TextCursor& cursor, Block& block) {
  block.kind = BlockKind::ToolCall;
  if (cursor.is_digit_next() && !cursor.read_integer(block.target, 0, kMaxTool, "TOOL CALL")) {
    return false;
  }
  if (cursor.take("IV")) {
    block.is_fourth_axis = true;
  } else if (const char c = cursor.peek(); is_axis_letter(c)) {
    block.axis = axis_of_letter(c);
    cursor.advance();
  }
  if (cursor.take('S') && !cursor.read_value(block.spindle, kSpindleSpeed, "S")) return false;
  return cursor.ends();
}

bool read_stop(TextCursor& cursor, Block& block, BlockKind kind) {
  block.kind = kind;
  if (cursor.take('M') && !read_m(cursor, block)) return false;
  return cursor.ends();
}

bool read_label(TextCursor& cursor, Block& block) {
  block.kind = BlockKind::Label;
  return cursor.read_integer(block.target, 0, kMaxLabel, "LBL") && cursor.ends();
}

bool read_label_call(TextCursor& cursor, Block& block) {
  block.kind = BlockKind::LabelCall;
  const char* start = (cursor.peek(), cursor.at());
  if (!cursor.read_integer(block.target, 0, kMaxLabel, "CALL LBL")) return false;
  if (block.target == 0) return cursor.wrong(ErrorCode::JumpToLabelZero, start, "CALL LBL 0");
  if (!cursor.take("REP") || !cursor.is_digit_next()) return cursor.ends();
  if (!cursor.read_integer(block.repeats, 0, kMaxRepeats, "REP")) return false;
  block.repeats_left = block.repeats;
  if (cursor.take('/') && !cursor.read_integer(block.repeats_left, 0, block.repeats, "REP")) {
    return false;
  }
  return cursor.ends();
}

bool read_program_call(TextCursor& cursor, Block& block) {
  block.kind = BlockKind::ProgramCall;
  return cursor.read_integer(block.target, 0, kMaxProgram, "CALL PGM") && cursor.ends();
}

/// After a C.
bool read_c(TextCursor& cursor, Block& block, const char* start) {
  switch (cursor.peek()) {
    case 'C':
      cursor.advance();
      return read_center(cursor, block);
    case 'P':
      cursor.advance();
      return read_polar_arc(cursor, block);
    case 'T':
      cursor.advance();
      return read_tangent_arc(cursor, block);
    case 'A':
      if (cursor.take("ALL LBL")) return read_label_call(cursor, block);
      if (cursor.take("ALL PGM")) return read_program_call(cursor, block);
      break;
    case 'Y':
      if (cursor.take("YCL DEF")) return read_cycle(cursor, block);
      if (cursor.take("YCL CALL")) return read_stop(cursor, block, BlockKind::CycleCall);
      break;
    default:
      break;
  }
  if (cursor.is_value_next()) {  // the axis C
    cursor.back_to(start);
    return read_single_axis(cursor, block);
  }
  return read_arc(cursor, block);
}

/// After an L.
bool read_l(TextCursor& cursor, Block& block) {
  switch (cursor.peek()) {
    case 'P':
      cursor.advance();
      return read_polar_line(cursor, block);
    case 'B':
      return cursor.take("BL") ? read_label(cursor, block) : read_line(cursor, block);
    default:
      return read_line(cursor, block);
  }
}

bool read_keyword(TextCursor& cursor, Block& block, const char* start) {
  cursor.back_to(start);
  if (cursor.take("TOOL DEF")) return read_tool_definition(cursor, block);
  if (cursor.take("TOOL CALL")) return read_tool_call(cursor, block);
  if (cursor.take("TCH PROBE")) return read_probe(cursor, block);
  if (cursor.take("STOP")) return read_stop(cursor, block, BlockKind::Stop);
  if (cursor.take("RND")) return read_rounding(cursor, block);
  if (cursor.take("FN")) return read_function(cursor, block);
  if (cursor.take("BEGIN")) return read_frame(cursor, block, BlockKind::Begin);
  if (cursor.take("END")) return read_frame(cursor, block, BlockKind::End);
  if (cursor.take("DEF BLK FORM")) return read_blank_form(cursor, block, true);
  if (cursor.take("BLK FORM")) return read_blank_form(cursor, block, false);
  const char c = cursor.peek();
  if (c == 'I' || is_axis_letter(c)) return read_single_axis(cursor, block);
  return cursor.unexpected();
}

}  // namespace

bool read_plain_block(const char* begin, const char* end, const ReadingState& state, Block& block,
                      Fault& fault) {
  TextCursor cursor(begin, end, state.program, fault);
  block.clear(BlockKind::Line);
  if (cursor.is_digit_next() &&
      !cursor.read_integer(block.number, 0, kMaxBlockNumber, "block number")) {
    return false;
  }
  const char first = cursor.peek();
  const char* start = (cursor.peek(), cursor.at());
  if (first == 'L') return cursor.advance(), read_l(cursor, block);
  if (first == 'C') return cursor.advance(), read_c(cursor, block, start);
  if (first == '*' && !cursor.is_at_end()) {
    return cursor.advance(), read_repeated_path(cursor, state, block);
  }
  return read_keyword(cursor, block, start);
}

void note_plain_block(const Block& block, ReadingState& state) {
  switch (block.kind) {
    case BlockKind::Begin:
      state.program.units = block.units;
      state.program.number = block.target;
      return;
    case BlockKind::Arc:
    case BlockKind::PolarArc:
      state.last_turn = *block.turn;
      state.last_path = block.kind;
      return;
    case BlockKind::Line:
    case BlockKind::PolarLine:
    case BlockKind::TangentArc:
      state.last_path = block.kind;
      return;
    default:
      return;
  }
}

}  // namespace dripline::interpreter::tnc155
