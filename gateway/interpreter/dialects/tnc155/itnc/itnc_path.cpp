#include <fmt/format.h>

#include "gateway/interpreter/dialects/tnc155/itnc/itnc_reader.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/ranges.hpp"

namespace dripline::interpreter::tnc155::itnc {
namespace {

/// Of several M functions one may say how the path runs.
bool is_of_path(int m) {
  return m == 91 || m == 92 || m == 97 || m == 98;
}

/// After M140: MB and the distance to retract, or MAX.
bool read_retract(Reading& in, const char* start) {
  if (in.words.retracts || !in.cursor.take("MB")) return refuse(in, start);
  in.words.retracts = true;
  if (in.cursor.take("MAX")) return in.words.retracts_to_limit = true;
  return read_value(in, in.words.retract, "MB");
}

/// M128 may have a feed of its own, for the moves that compensate; it limits those of the axes, and
/// the program's F is the tip's.
bool read_tip_m(Reading& in, int m) {
  in.words.tip = m == 128 ? TipWords::Begin : TipWords::End;
  if (m == 129 || !in.cursor.take('F')) return true;
  Value feed;
  return read_value(in, feed, "F of M128");
}

/// After the M.
bool read_m(Reading& in, const char* start) {
  if (!in.cursor.is_digit_next()) return true;
  std::int32_t m = 0;
  if (!in.cursor.read_integer(m, 0, 9999, "M")) return false;
  if (m == 140) return read_retract(in, start);
  if (m == 128 || m == 129) return read_tip_m(in, m);
  if (m > 99 || m == 93 || m == 95 || m == 96) {
    switch (m) {
      case 107:
      case 108:
      case 111:
      case 115:
      case 116:
      case 117:
      case 120:
      case 126:
      case 127:
      case 135:
      case 137:
      case 145:
      case 149:
        break;
      default:
        return refuse(in, start);
    }
  }
  if (m == 120 && in.cursor.take("LA")) {
    Value blocks;
    if (!read_value(in, blocks, "LA")) return false;
  }
  if (is_of_path(m) && in.block.m == Block::kNone) {
    in.block.m = static_cast<std::int8_t>(m);
    return true;
  }
  if (in.words.m_count == ItncWords::kMaxM || is_of_path(m)) {
    return in.cursor.wrong(fmt::format("M{} is one too many in the block", m));
  }
  in.words.m[in.words.m_count++] = static_cast<std::int16_t>(m);
  return true;
}

/// After the R: R0, RL, RR, and R+ or R- of single axes.
bool read_compensation(Reading& in) {
  TextCursor& cursor = in.cursor;
  const bool is_single = in.block.kind == BlockKind::SingleAxis;
  switch (cursor.peek()) {
    case '0':
      in.block.compensation = Compensation::Off;
      break;
    case 'L':
    case 'R':
      if (is_single) return cursor.wrong("a single-axis block has R0, R+ or R-");
      in.block.compensation = *cursor.at() == 'L' ? Compensation::Left : Compensation::Right;
      break;
    case '+':
    case '-':
      if (!is_single) return cursor.wrong("R+ and R- are for single-axis blocks");
      in.block.compensation = *cursor.at() == '+' ? Compensation::Longer : Compensation::Shorter;
      break;
    default:
      return true;  // "not programmed"
  }
  cursor.advance();
  return true;
}

/// After the P of PR or PA.
bool read_polar(Reading& in, bool is_incremental) {
  Block& block = in.block;
  const bool is_line = block.kind == BlockKind::PolarLine || in.words.is_polar;
  if (is_line && in.cursor.take('R')) {
    block.is_radius_incremental = is_incremental;
    return read_value(in, block.radius, "PR");
  }
  if ((is_line || block.kind == BlockKind::PolarArc) && in.cursor.take('A')) {
    block.is_angle_incremental = is_incremental;
    return read_value(in, block.angle, "PA");
  }
  return in.cursor.unexpected();
}

bool read_turn(Reading& in) {
  if (!in.cursor.take('R')) return in.cursor.unexpected();
  if (in.cursor.take('+')) return in.block.turn = Turn::Counterclockwise, true;
  if (in.cursor.take('-')) return in.block.turn = Turn::Clockwise, true;
  return in.cursor.missing("DR");
}

/// After the R of CR: its radius comes first.
bool is_radius_next(Reading& in) {
  return in.block.kind == BlockKind::RadiusArc && !in.block.radius.is_programmed();
}

bool read_path_word(Reading& in) {
  TextCursor& cursor = in.cursor;
  const char c = cursor.peek();
  const char* start = cursor.at();
  if (c == 'I' || c == 'P') {
    const bool is_incremental = cursor.take('I');
    if (cursor.take('P')) return read_polar(in, is_incremental);
    cursor.back_to(start);
  }
  if (c == 'I' || is_axis_letter(c)) return read_axis_word(in);
  cursor.advance();
  switch (c) {
    case 'D':
      return read_turn(in);
    case 'R':
      return is_radius_next(in) ? read_value(in, in.block.radius, "R") : read_compensation(in);
    case 'F':
      return read_feed(in, false);
    case 'M':
      return read_m(in, start);
    case 'S':  // of TOOL CALL alone
      cursor.back_to(start);
      return cursor.wrong("S in a positioning block: the speed is that of TOOL CALL");
    default:
      return refuse(in, start);
  }
}

bool is_complete(Reading& in) {
  const Block& block = in.block;
  const bool is_arc = block.kind == BlockKind::Arc || block.kind == BlockKind::PolarArc ||
                      block.kind == BlockKind::RadiusArc;
  if (is_arc != block.turn.has_value()) {
    return is_arc ? in.cursor.missing("DR") : in.cursor.wrong("DR is for circles");
  }
  if (block.kind == BlockKind::PolarArc && !block.angle.is_programmed()) {
    return in.cursor.missing("PA");
  }
  if (block.kind == BlockKind::RadiusArc && !block.radius.is_programmed()) {
    return in.cursor.missing("R");
  }
  // C without coordinates ends where it begins: a full circle.
  const bool needs_end = block.kind == BlockKind::TangentArc ||
                         block.kind == BlockKind::RadiusArc || block.kind == BlockKind::SingleAxis;
  if (needs_end && block.coordinate_count == 0) return in.cursor.missing("the end point");
  return true;
}

}  // namespace

bool read_feed(Reading& in, bool is_own) {
  TextCursor& cursor = in.cursor;
  const char* start = cursor.at() - 1;
  if (cursor.take("MAX")) return in.block.is_rapid = true;
  if (cursor.take("AUTO")) return in.words.is_auto_feed = true;
  if (cursor.is_value_next()) return read_value(in, is_own ? in.words.feed : in.block.feed, "F");
  const char next = cursor.peek();
  if (!cursor.is_at_end() && next >= 'A' && next <= 'Z' && next != 'M') return refuse(in, start);
  return true;
}

bool read_path(Reading& in, BlockKind kind) {
  in.block.kind = kind;
  while (!in.cursor.is_at_end()) {
    if (!read_path_word(in)) return false;
  }
  if (kind == BlockKind::SingleAxis && in.block.coordinate_count > 1) {
    return in.cursor.wrong("more than one axis without L");
  }
  return is_complete(in);
}

namespace {

/// R5, not the R0, RL and RR of compensation.
bool is_arc_radius_next(TextCursor& cursor) {
  if (cursor.peek() != 'R') return false;
  const char* next = cursor.at() + 1;
  if (*next == '0') return TextCursor::is_digit(next[1]) || next[1] == '.' || next[1] == ',';
  return (kCharacterBits[static_cast<unsigned char>(*next)] & kValueBit) != 0;
}

/// A word that only APPR and DEP have, into `value`; its name, or nothing.
std::string_view take_contour_end_word(Reading& in, Value*& value) {
  const bool is_by_circle = in.block.part >= 2;
  if (is_by_circle && is_arc_radius_next(in.cursor)) {
    in.cursor.advance();
    value = &in.words.arc_radius;
    return "R";
  }
  const bool has_angle = in.block.part == 2;
  if (has_angle && in.cursor.take("CCA")) return value = &in.words.center_angle, "CCA";
  if (!is_by_circle && in.cursor.take("LEN")) return value = &in.words.length, "LEN";
  return {};
}

}  // namespace

bool read_contour_end(Reading& in) {
  Block& block = in.block;
  while (!in.cursor.is_at_end()) {
    Value* value = nullptr;
    const std::string_view name = take_contour_end_word(in, value);
    if (value == nullptr) {
      if (!read_path_word(in)) return false;
      continue;
    }
    if (value->is_programmed()) return in.cursor.wrong(fmt::format("{} twice", name));
    if (!read_value(in, *value, name)) return false;
  }
  const bool has_side =
      block.compensation == Compensation::Left || block.compensation == Compensation::Right;
  if (block.part < 2 && !in.words.length.is_programmed()) return in.cursor.missing("LEN");
  if (block.part >= 2 && !in.words.arc_radius.is_programmed()) return in.cursor.missing("R");
  if (block.part == 2 && !in.words.center_angle.is_programmed()) return in.cursor.missing("CCA");
  if (block.turn) return in.cursor.wrong("DR is for circles");
  if (block.kind == BlockKind::Approach) return has_side || in.cursor.wrong("APPR needs RL or RR");
  return block.compensation <= Compensation::Off || in.cursor.wrong("DEP ends RL and RR");
}

bool read_corner(Reading& in, BlockKind kind) {
  in.block.kind = kind;
  in.cursor.take('R');
  if (!read_value(in, in.block.radius, kind == BlockKind::Rounding ? "RND" : "CHF")) return false;
  if (in.cursor.take('F') && !read_feed(in, true)) return false;
  return in.cursor.ends();
}

bool read_center(Reading& in) {
  in.block.kind = BlockKind::Center;
  while (!in.cursor.is_at_end()) {
    if (!read_axis_word(in)) return false;
    if (is_rotary(in.block.words().back().axis)) return in.cursor.wrong("CC takes linear axes");
  }
  return true;
}

bool read_call_at(Reading& in) {
  in.block.kind = BlockKind::CycleCallAt;
  while (!in.cursor.is_at_end()) {
    const char* start = in.cursor.at();
    if (in.cursor.take('F')) {
      if (!read_feed(in, true)) return false;
    } else if (in.cursor.take('M')) {
      if (!read_m(in, start)) return false;
    } else if (!read_axis_word(in)) {
      return false;
    }
  }
  return true;
}

bool read_m_words(Reading& in) {
  while (!in.cursor.is_at_end()) {
    const char* start = in.cursor.at();
    if (!in.cursor.take('M')) return refuse(in, start);
    if (!read_m(in, start)) return false;
  }
  return true;
}

bool read_tool_definition(Reading& in) {
  in.block.kind = BlockKind::ToolDefinition;
  if (in.cursor.peek() == '"') return refuse(in, in.cursor.at());
  if (!in.cursor.read_integer(in.block.target, 0, 32'767, "TOOL DEF")) return false;
  if (in.cursor.take('L') && !read_value(in, in.block.length, "L")) return false;
  if (in.cursor.take('R') && !read_value(in, in.block.radius, "R")) return false;
  return in.cursor.is_at_end() || refuse(in, in.cursor.at());
}

bool read_tool_call(Reading& in) {
  TextCursor& cursor = in.cursor;
  in.block.kind = BlockKind::ToolCall;
  if (cursor.peek() == '"') {
    if (!read_quoted(in, in.words.name)) return false;
  } else if (cursor.peek() == 'Q') {
    if (!read_value(in, in.words.tool, "TOOL CALL")) return false;
  } else if (cursor.is_digit_next()) {
    if (!cursor.read_integer(in.block.target, 0, 32'767, "TOOL CALL")) return false;
    if (*cursor.at() == '.') return refuse(in, cursor.at());  // an indexed tool
  }
  if (is_axis_letter(cursor.peek())) {
    in.block.axis = axis_of_letter(*cursor.at());
    if (is_rotary(*in.block.axis)) return refuse(in, cursor.at());
    cursor.advance();
  }
  while (!cursor.is_at_end()) {
    const char* start = cursor.at();
    if (cursor.take("DR2")) return refuse(in, start);
    const bool is_read = cursor.take("DL")   ? read_value(in, in.words.delta_length, "DL")
                         : cursor.take("DR") ? read_value(in, in.words.delta_radius, "DR")
                         : cursor.take('S')  ? read_value(in, in.block.spindle, "S")
                         : cursor.take('F')  ? read_feed(in, true)
                                             : refuse(in, start);
    if (!is_read) return false;
  }
  return true;
}

bool read_blank(Reading& in) {
  TextCursor& cursor = in.cursor;
  in.block.kind = BlockKind::BlankForm;
  const char* start = cursor.at();
  if (cursor.take("0.2")) {
    in.block.is_maximum = true;
  } else if (!cursor.take("0.1")) {
    return refuse(in, start);
  }
  const char axis = cursor.peek();
  if (is_axis_letter(axis)) {
    const char* at = cursor.at();
    cursor.advance();
    if (cursor.is_value_next()) {
      cursor.back_to(at);
    } else {
      in.block.axis = axis_of_letter(axis);
    }
  }
  while (!cursor.is_at_end()) {
    if (!read_axis_word(in)) return false;
  }
  for (const Coordinate& word : in.block.words()) {
    if (word.is_incremental && !in.block.is_maximum) {
      return cursor.wrong("the MIN corner is not incremental");
    }
  }
  return in.block.coordinate_count == 3 || cursor.wrong("BLK FORM needs three coordinates");
}

}  // namespace dripline::interpreter::tnc155::itnc
