#include <fmt/format.h>
#include <algorithm>

#include "gateway/interpreter/dialects/tnc155/itnc/cycle_tables.hpp"
#include "gateway/interpreter/dialects/tnc155/itnc/itnc_reader.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/cycle_names.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/plain_reader.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/ranges.hpp"

namespace dripline::interpreter::tnc155::itnc {
namespace {

/// Q200=+2 ;SET-UP CLEARANCE
bool read_cycle_word(Reading& in, int cycle) {
  TextCursor& cursor = in.cursor;
  const char* start = (cursor.peek(), cursor.at());
  CycleWord word;
  if (!cursor.take('Q') || !cursor.is_digit_next()) return refuse(in, start);
  if (!cursor.read_integer(word.parameter, 0, kItncParameters - 1, "Q")) return false;
  if (!cursor.take('=')) return cursor.missing("=");
  const auto table = cycle_table(cycle);
  const auto row = std::ranges::find_if(
      table, [&](const CycleParameter& known) { return known.q == word.parameter; });
  if (row == table.end()) {
    return cursor.wrong(ErrorCode::NotSupported, start,
                        fmt::format("Q{} of CYCL DEF {}", word.parameter, cycle));
  }
  for (const CycleWord& before : in.words.words) {
    if (before.parameter != word.parameter) continue;
    return cursor.wrong(fmt::format("Q{} is programmed twice", word.parameter));
  }
  if (cursor.take("FAUTO") || cursor.take("AUTO")) {
    if (row->use != CycleUse::Feed) return refuse(in, start);
    word.is_auto = true;
  } else if (cursor.take("FMAX") || cursor.take("MAX")) {
    if (word.parameter != kRetractionFeed) return refuse(in, start);
    word.is_rapid = true;
  } else if (!cursor.is_value_next()) {
    return refuse(in, start);
  } else if (!read_value(in, word.value, fmt::format("Q{}", word.parameter))) {
    return false;
  }
  in.words.words.push_back(word);
  return cursor.ends();
}

/// The lines of Q words after that of the number and the name.
bool read_table(Reading& in, int cycle, const char* block_end) {
  in.block.kind = BlockKind::CycleTable;
  in.block.cycle = static_cast<std::uint16_t>(cycle);
  const char* name_end = in.end;
  const char* words = std::find(name_end, block_end, '\n');
  if (words == block_end) {
    // All in one line: the words begin with the first Q and its digits.
    const char* at = in.cursor.at();
    while (at != name_end && !(*at == 'Q' && TextCursor::is_digit(at[1]))) ++at;
    if (at != name_end) {
      in.cursor.back_to(at);
      return in.cursor.wrong(ErrorCode::NotSupported, at,
                             "the Q words of a cycle in its first line");
    }
  }
  const char* begin = in.cursor.begin();
  while (words != block_end) {
    const char* line = words + 1;
    words = std::find(line, block_end, '\n');
    const char* line_end = line_without_comment(line, words);
    TextCursor cursor(begin, line_end, in.cursor.form(), in.cursor.fault());
    cursor.back_to(line);
    Reading part{cursor, in.block, in.words, line_end, false};
    if (!cursor.is_at_end() && !read_cycle_word(part, cycle)) return false;
  }
  for (const CycleParameter& row : cycle_table(cycle)) {
    const bool has = std::ranges::any_of(
        in.words.words, [&](const CycleWord& word) { return word.parameter == row.q; });
    if (row.is_needed && !has) {
      return in.cursor.wrong(ErrorCode::CycleIncomplete, begin,
                             fmt::format("CYCL DEF {} has no Q{}", cycle, row.q));
    }
  }
  return true;
}

bool refuse_cycle(Reading& in, const char* start, int cycle) {
  return in.cursor.wrong(ErrorCode::NotSupported, start, fmt::format("CYCL DEF {}", cycle));
}

/// A transformation's sub-block with this control's numbers; the others are the TNC 155's.
bool read_shift(Reading& in) {
  in.cursor.peek();
  const char* start = in.cursor.at();
  if (*start == '#') return refuse(in, start);
  return read_axis_word(in) && in.cursor.ends();
}

}  // namespace

bool read_cycle(Reading& in, const char* block_end) {
  TextCursor& cursor = in.cursor;
  const char* start = cursor.at();
  std::int32_t cycle = 0, part = 0;
  if (!cursor.read_integer(cycle, 0, 9999, "CYCL DEF")) return false;
  if (!cycle_table(cycle).empty()) return read_table(in, cycle, block_end);
  const bool has_part = cursor.take('.');
  if (has_part && !cursor.read_integer(part, 0, 99, "CYCL DEF")) return false;
  constexpr int kProgramCall = 12, kWorkingPlane = 19, kTolerance = 32;
  if (has_part && cycle == kTolerance) {
    in.block.kind = BlockKind::Accepted;
    in.words.name = "CYCL DEF 32 (tolerance of the path)";
    return true;
  }
  if (has_part && cycle == kWorkingPlane && (part == 0 || (part == 1 && cursor.is_at_end()))) {
    in.block.kind = BlockKind::Accepted;
    in.words.name = "CYCL DEF 19 without angles";
    return true;
  }
  const bool is_known = has_part && cycle <= kLastCycle && !cycle_parts(cycle).empty();
  if (!is_known || cycle == kProgramCall) return refuse_cycle(in, start, cycle);
  if (cycle == 7 && part > 0) {
    if (part >= static_cast<int>(cycle_parts(7).size())) return refuse(in, start);
    in.block.kind = BlockKind::CycleDefinition;
    in.block.cycle = 7;
    in.block.part = static_cast<std::uint8_t>(part);
    return read_shift(in);
  }
  cursor.back_to(start);
  return plain::read_cycle(cursor, in.block);
}

}  // namespace dripline::interpreter::tnc155::itnc
