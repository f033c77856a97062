#include <fmt/format.h>
#include <algorithm>
#include <string_view>

#include "gateway/interpreter/dialects/tnc155/reading/plain_reader.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/ranges.hpp"

namespace dripline::interpreter::tnc155::plain {

bool read_m(TextCursor& cursor, Block& block) {
  if (!cursor.is_digit_next()) return true;
  std::int32_t m = 0;
  if (!cursor.read_integer(m, 0, 99, "M")) return false;
  block.m = static_cast<std::int8_t>(m);
  return true;
}

bool read_feed(TextCursor& cursor, Block& block, bool may_be_rapid) {
  if (cursor.is_value_next()) {
    return cursor.read_value(block.feed, feed_range(cursor.form()), "F");
  }
  if (may_be_rapid && cursor.take("MAX")) block.is_rapid = true;
  return true;
}

bool read_turn(TextCursor& cursor, Block& block) {
  if (!cursor.take('R')) return cursor.unexpected();
  if (cursor.take('+')) {
    block.turn = Turn::Counterclockwise;
  } else if (cursor.take('-')) {
    block.turn = Turn::Clockwise;
  } else {
    return cursor.missing("DR");
  }
  return true;
}

bool read_coordinate(TextCursor& cursor, Block& block) {
  Coordinate coordinate;
  char c = cursor.peek();
  if (c == 'I') {
    coordinate.is_incremental = true;
    cursor.advance();
    c = cursor.peek();
  }
  if (!is_axis_letter(c)) return cursor.unexpected();
  cursor.advance();
  coordinate.axis = axis_of_letter(c);
  if (block.names(coordinate.axis)) return cursor.wrong(fmt::format("{} is programmed twice", c));
  const Range& range = coordinate_range(cursor.form(), coordinate.axis);
  if (!cursor.read_value(coordinate.value, range, {&c, 1})) return false;
  block.add(coordinate);
  return true;
}

bool read_coordinates(TextCursor& cursor, Block& block, std::size_t most) {
  while (true) {
    const char c = cursor.peek();
    if (cursor.is_at_end() || (c != 'I' && !is_axis_letter(c))) return true;
    if (block.coordinate_count == most) {
      return cursor.wrong(fmt::format("more than {} coordinates", most));
    }
    if (!read_coordinate(cursor, block)) return false;
  }
}

namespace {

/// After the R.
bool read_compensation(TextCursor& cursor, Block& block) {
  constexpr std::string_view kLetters = "0LR+-";  // in the order of Compensation from Off on
  const std::size_t at = kLetters.find(cursor.peek());
  if (at == std::string_view::npos) return true;  // "not programmed"
  block.compensation = static_cast<Compensation>(static_cast<std::size_t>(Compensation::Off) + at);
  cursor.advance();
  return true;
}

bool is_compensation_right(TextCursor& cursor, const Block& block) {
  if (block.compensation <= Compensation::Off) return true;
  const bool is_single = block.kind == BlockKind::SingleAxis;
  if (is_single == (block.compensation > Compensation::Right)) return true;
  return cursor.wrong(is_single ? "a single-axis block has R0, R+ or R-"
                                : "R+ and R- are for single-axis blocks");
}

/// Direction, compensation, feed, M in this order, up to the end of the block.
bool read_tail(TextCursor& cursor, Block& block) {
  if (cursor.take('D') && !read_turn(cursor, block)) return false;
  if (cursor.take('R') && !read_compensation(cursor, block)) return false;
  if (cursor.take('F') && !read_feed(cursor, block, true)) return false;
  if (cursor.take('M') && !read_m(cursor, block)) return false;
  if (!cursor.is_at_end()) return cursor.unexpected();
  return is_compensation_right(cursor, block);
}

bool read_arc_tail(TextCursor& cursor, Block& block) {
  if (!read_tail(cursor, block)) return false;
  return block.turn ? true : cursor.missing("DR");
}

bool read_straight_tail(TextCursor& cursor, Block& block) {
  if (!read_tail(cursor, block)) return false;
  return block.turn ? cursor.wrong("DR is for circles") : true;
}

/// PR or PA with its I, where one comes next.
bool read_polar_words(TextCursor& cursor, Block& block, bool has_radius) {
  while (true) {
    const char* start = (cursor.peek(), cursor.at());
    const bool is_incremental = cursor.take('I');
    if (!cursor.take('P')) {
      cursor.back_to(start);
      return true;
    }
    if (has_radius && cursor.take('R')) {
      if (block.radius.is_programmed()) return cursor.wrong("PR is programmed twice");
      block.is_radius_incremental = is_incremental;
      if (!cursor.read_value(block.radius, coordinate_range(cursor.form()), "PR")) return false;
    } else if (cursor.take('A')) {
      if (block.angle.is_programmed()) return cursor.wrong("PA is programmed twice");
      block.is_angle_incremental = is_incremental;
      if (!cursor.read_value(block.angle, angle_range(is_incremental), "PA")) return false;
    } else {
      return cursor.unexpected();
    }
  }
}

/// The K (Cartesian) or P (polar) that a `*` block may show; its words say the same.
void take_kind_of_coordinates(TextCursor& cursor) {
  if (cursor.take('K')) return;
  const char* start = (cursor.peek(), cursor.at());
  if (!cursor.take('P')) return;
  const char next = cursor.peek();
  if (next == 'R' || next == 'A') cursor.back_to(start);  // PR, PA
}

bool are_linear(const Block& block) {
  return std::none_of(block.words().begin(), block.words().end(),
                      [](const Coordinate& word) { return is_rotary(word.axis); });
}

}  // namespace

bool read_line(TextCursor& cursor, Block& block) {
  if (cursor.is_value_next()) {
    block.kind = BlockKind::Chamfer;
    if (!cursor.read_value(block.radius, radius_range(cursor.form()), "L")) return false;
    return cursor.ends();
  }
  block.kind = BlockKind::Line;
  return read_coordinates(cursor, block, 3) && read_straight_tail(cursor, block);
}

bool read_polar_line(TextCursor& cursor, Block& block) {
  block.kind = BlockKind::PolarLine;
  return read_polar_words(cursor, block, true) && read_straight_tail(cursor, block);
}

bool read_center(TextCursor& cursor, Block& block) {
  block.kind = BlockKind::Center;
  if (!read_coordinates(cursor, block, 2)) return false;
  if (!are_linear(block)) {
    return cursor.wrong(ErrorCode::WrongAxis, cursor.at(), "CC takes linear axes");
  }
  return cursor.ends();
}

bool read_arc(TextCursor& cursor, Block& block) {
  block.kind = BlockKind::Arc;
  if (!read_coordinates(cursor, block, 2)) return false;
  if (block.coordinate_count == 0) return cursor.unexpected();
  return read_arc_tail(cursor, block);
}

bool read_polar_arc(TextCursor& cursor, Block& block) {
  block.kind = BlockKind::PolarArc;
  if (!read_polar_words(cursor, block, false)) return false;
  if (!block.angle.is_programmed()) return cursor.missing("PA");
  return read_coordinates(cursor, block, 1) && read_arc_tail(cursor, block);
}

bool read_tangent_arc(TextCursor& cursor, Block& block) {
  block.kind = BlockKind::TangentArc;
  if (!read_coordinates(cursor, block, 2)) return false;
  return block.coordinate_count > 0 ? read_straight_tail(cursor, block) : cursor.unexpected();
}

bool read_rounding(TextCursor& cursor, Block& block) {
  block.kind = BlockKind::Rounding;
  cursor.take('R');
  if (!cursor.read_value(block.radius, radius_range(cursor.form()), "RND")) return false;
  return cursor.ends();
}

bool read_single_axis(TextCursor& cursor, Block& block) {
  block.kind = BlockKind::SingleAxis;
  return read_coordinate(cursor, block) && read_straight_tail(cursor, block);
}

bool read_repeated_path(TextCursor& cursor, const ReadingState& state, Block& block) {
  if (!state.last_path) {
    return cursor.wrong(ErrorCode::ProgramStartUndefined, cursor.at(),
                        "* repeats a path function, and there is none yet");
  }
  take_kind_of_coordinates(cursor);
  block.kind = *state.last_path;
  switch (block.kind) {
    case BlockKind::PolarLine:
      return read_polar_line(cursor, block);
    case BlockKind::Arc:
    case BlockKind::PolarArc:
      block.turn = state.last_turn;
      return block.kind == BlockKind::Arc ? read_arc(cursor, block) : read_polar_arc(cursor, block);
    case BlockKind::TangentArc:
      return read_tangent_arc(cursor, block);
    default:
      return read_line(cursor, block);
  }
}

}  // namespace dripline::interpreter::tnc155::plain
