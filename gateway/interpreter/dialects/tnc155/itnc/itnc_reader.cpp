#include "gateway/interpreter/dialects/tnc155/itnc/itnc_reader.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>

#include "gateway/interpreter/dialects/tnc155/reading/ranges.hpp"

namespace dripline::interpreter::tnc155::itnc {

const char* line_without_comment(const char* begin, const char* end) {
  bool is_quoted = false;
  const char* at = begin;
  for (; at != end && *at != '\n' && *at != '\r'; ++at) {
    if (*at == '"') is_quoted = !is_quoted;
    if (*at == ';' && !is_quoted) return at;
    if (*at != '~') continue;
    const char* rest = at + 1;
    while (rest != end && (*rest == ' ' || *rest == '\t')) ++rest;
    if (rest == end || *rest == '\n' || *rest == '\r') return at;
  }
  return at;
}

bool refuse(Reading& in, const char* start) {
  std::string words(start, in.end);
  while (!words.empty() && static_cast<unsigned char>(words.back()) <= ' ') words.pop_back();
  constexpr std::size_t kShown = 40;
  if (words.size() > kShown) words = words.substr(0, kShown) + "...";
  return in.cursor.wrong(ErrorCode::NotSupported, start, words);
}

bool refuse_keyword(Reading& in, const char* start) {
  // Words that begin a block of these controls; what they do is not known here.
  constexpr std::array<std::string_view, 29> kOfControl{
      "TCH PROBE", "CYCL",    "CTP",    "FN",         "PLANE",  "FUNCTION", "FPOL",     "FL",
      "FC",        "FSELECT", "LN",     "SPL",        "SEL",    "CALL",     "PATTERN",  "CONTOUR",
      "TRANS",     "DECLARE", "GLOBAL", "TOOL",       "QS",     "TABDATA",  "POLARKIN", "APPR",
      "DEP",       "BLK",     "INSERT", "CORRECTION", "PROBING"};
  for (const std::string_view word : kOfControl) {
    in.cursor.back_to(start);
    const bool is_it = in.cursor.take(word);
    const char next = *in.cursor.at();
    in.cursor.back_to(start);
    const bool is_longer = next >= 'A' && next <= 'Z';  // CYCLE, FLUTE
    if (is_it && !is_longer) return refuse(in, start);
  }
  std::string words(start, in.end);
  constexpr std::size_t kShown = 40;
  if (words.size() > kShown) words.replace(kShown, std::string::npos, "...");
  return in.cursor.wrong(ErrorCode::BlockFormatIncorrect, start,
                         fmt::format("no block of this control begins so: {}", words));
}

bool is_parameter(const char* at) {
  if (*at != 'Q') return false;
  const bool is_other = at[1] == 'L' || at[1] == 'R';
  return TextCursor::is_digit(at[is_other ? 2 : 1]);
}

bool read_parameter_number(Reading& in, std::int32_t& parameter) {
  TextCursor& cursor = in.cursor;
  const char kind = *cursor.at();
  if (kind != 'L' && kind != 'R')
    return cursor.read_integer(parameter, 0, kItncParameters - 1, "Q");
  cursor.advance();
  const bool is_local = kind == 'L';
  const int first = is_local ? kFirstLocal : kFirstRetained;
  const int count = is_local ? kLocalParameters : kRetainedParameters;
  if (!cursor.read_integer(parameter, 0, count - 1, is_local ? "QL" : "QR")) return false;
  parameter += first;
  return true;
}

bool read_value(Reading& in, Value& value, std::string_view name) {
  TextCursor& cursor = in.cursor;
  const char* start = (cursor.peek(), cursor.at());
  const bool is_negative = cursor.take('-');
  if (!is_negative) cursor.take('+');
  cursor.peek();
  if (cursor.take('Q')) {
    std::int32_t parameter = 0;
    if (!is_parameter(cursor.at() - 1)) return refuse(in, start);  // QS: a text
    if (!read_parameter_number(in, parameter)) return false;
    if (parameter >= kFirstRetained) in.words.retained.push_back(parameter);
    const bool is_taken = in.takes_plane_angle && is_plane_angle(parameter);
    if (is_of_control(parameter) && !is_taken) return refuse(in, start);
    value = Value::q(parameter, is_negative);
    return true;
  }
  std::int64_t steps = 0, unit = Value::kStepsPerUnit, digits = 0;
  const char* at = cursor.at();
  for (; TextCursor::is_digit(*at) && digits < 9; ++at, ++digits) steps = steps * 10 + (*at - '0');
  steps *= unit;
  if (*at == '.' || *at == ',') {
    for (++at; TextCursor::is_digit(*at); ++at, ++digits) {
      if (unit == 1 && *at >= '5') ++steps;  // the fifth decimal rounds, those after it do not
      unit /= 10;
      steps += unit * (*at - '0');
    }
  }
  if (digits == 0) return cursor.missing(name);
  cursor.back_to(at);
  constexpr std::int64_t kMost = 100'000 * kUnit - 1;
  if (steps > kMost) {
    return cursor.wrong(ErrorCode::EntryOutOfRange, start,
                        fmt::format("{} is beyond 99999.9999", name));
  }
  value = Value::steps(static_cast<std::int32_t>(is_negative ? -steps : steps));
  return true;
}

std::string read_word(Reading& in) {
  std::string word;
  in.cursor.peek();
  const char* at = in.cursor.at();
  while (at != in.end && static_cast<unsigned char>(*at) > ' ' && word.size() < 1000) word += *at++;
  in.cursor.back_to(at);
  return word;
}

bool read_quoted(Reading& in, std::string& text) {
  if (!in.cursor.take('"')) return in.cursor.unexpected();
  const char* at = in.cursor.at();
  const char* close = std::find(at, in.end, '"');
  if (close == in.end || close == at) return in.cursor.missing("the name");
  text.assign(at, close);
  in.cursor.back_to(close + 1);
  return true;
}

bool read_axis_word(Reading& in) {
  TextCursor& cursor = in.cursor;
  Coordinate word;
  word.is_incremental = cursor.take('I');
  const char c = cursor.peek();
  if (!is_axis_letter(c)) return cursor.unexpected();
  cursor.advance();
  word.axis = axis_of_letter(c);
  if (in.block.names(word.axis)) return cursor.wrong(fmt::format("{} is programmed twice", c));
  if (in.block.coordinate_count == Block::kMaxCoordinates) {
    return cursor.wrong(fmt::format("more than {} axes", Block::kMaxCoordinates));
  }
  in.takes_plane_angle = is_rotary(word.axis);
  const bool is_read = read_value(in, word.value, {&c, 1});
  in.takes_plane_angle = false;
  if (!is_read) return false;
  in.block.add(word);
  return true;
}

namespace {

bool read_frame(Reading& in, BlockKind kind) {
  in.block.kind = kind;
  in.cursor.peek();
  std::string_view text(in.cursor.at(), in.end);
  const auto trim = [&text] {
    while (!text.empty() && static_cast<unsigned char>(text.back()) <= ' ') text.remove_suffix(1);
  };
  trim();
  constexpr std::string_view kMetric = " MM", kInch = " INCH";  // a name may have blanks
  if (text.ends_with(kInch)) {
    in.block.units = Units::Inch;
    text.remove_suffix(kInch.size());
  } else if (text.ends_with(kMetric)) {
    text.remove_suffix(kMetric.size());
  } else {
    return in.cursor.missing("MM or INCH");
  }
  trim();
  in.words.name = text;
  if (in.words.name.empty()) return in.cursor.missing("PGM");
  in.cursor.back_to(in.end);
  return true;
}

/// LBL 5, LBL "NAME"; `least`: LBL 0 ends a subprogram.
bool read_label(Reading& in, BlockKind kind, std::int32_t least) {
  in.block.kind = kind;
  if (in.cursor.peek() == '"') {
    in.block.target = kNameLabel;
    const char* start = in.cursor.at();
    if (!read_quoted(in, in.words.name)) return false;
    return in.words.name.size() <= kLongestLabel ||
           in.cursor.wrong(ErrorCode::EntryOutOfRange, start,
                           fmt::format("a label of {} characters, at most {}", in.words.name.size(),
                                       kLongestLabel));
  }
  return in.cursor.read_integer(in.block.target, least, kLastItncLabel, "LBL");
}

bool read_label_call(Reading& in) {
  if (!read_label(in, BlockKind::LabelCall, 1)) return false;
  if (in.cursor.take("REP")) {
    // A TNC 155 lists its call of a subprogram so; what a later control does is not known.
    if (!in.cursor.is_digit_next()) {
      return in.cursor.wrong(
          "REP without a number: CALL LBL alone calls a subprogram, REP 2 repeats");
    }
    if (!in.cursor.read_integer(in.block.repeats, 0, kLastItncLabel, "REP")) return false;
    std::int32_t left = 0;  // as a listing shows it; a run begins with all
    if (in.cursor.take('/') && !in.cursor.read_integer(left, 0, in.block.repeats, "REP")) {
      return false;
    }
  }
  return in.cursor.ends();
}

/// The file's name without folder and .H: the control's own folders are not ours.
std::string program_name(std::string text) {
  text.erase(0, text.find_last_of("\\/:") + 1);
  if (text.ends_with(".H") || text.ends_with(".h")) text.resize(text.size() - 2);
  return text;
}

bool read_program_call(Reading& in) {
  in.block.kind = BlockKind::ProgramCall;
  const char* start = (in.cursor.peek(), in.cursor.at());
  std::string text;
  if (*start == '"') {
    if (!read_quoted(in, text)) return false;
  } else {
    text = read_word(in);
  }
  if (text.ends_with(".I") || text.ends_with(".i")) return refuse(in, start);
  in.words.name = program_name(text);
  if (in.words.name.empty()) return in.cursor.missing("CALL PGM");
  return in.cursor.ends();
}

bool is_contour_end(Reading& in) {
  constexpr std::array kForms{"LT", "LN", "CT", "LCT", "PLT", "PLN", "PCT", "PLCT"};
  constexpr std::size_t kPolar = 4;
  const char* start = in.cursor.at();
  const bool is_approach = in.cursor.take("APPR");
  if (!is_approach && !in.cursor.take("DEP")) return false;
  for (std::size_t form = 0; form < kForms.size(); ++form) {
    in.cursor.back_to(start);
    in.cursor.take(is_approach ? "APPR" : "DEP");
    if (!in.cursor.take(kForms[form])) continue;
    const bool has_end = is_approach || form % kPolar == kPolar - 1;
    if (form >= kPolar && !has_end) break;
    in.block.kind = is_approach ? BlockKind::Approach : BlockKind::Departure;
    in.block.part = static_cast<std::uint8_t>(form % kPolar);
    in.words.is_polar = form >= kPolar;
    return true;
  }
  in.cursor.back_to(start);
  return false;
}

bool read_keyword(Reading& in, const char* start) {
  TextCursor& cursor = in.cursor;
  if (is_contour_end(in)) return read_contour_end(in);
  if (cursor.take("TOOL CALL")) return read_tool_call(in);
  if (cursor.take("TOOL DEF")) return read_tool_definition(in);
  if (cursor.take("BEGIN PGM")) return read_frame(in, BlockKind::Begin);
  if (cursor.take("END PGM")) return read_frame(in, BlockKind::End);
  if (cursor.take("BLK FORM")) return read_blank(in);
  if (cursor.take("STOP")) return in.block.kind = BlockKind::Stop, read_m_words(in);
  if (cursor.take("RND")) return read_corner(in, BlockKind::Rounding);
  if (cursor.take("FN")) return read_function(in);
  if (cursor.take("PLANE")) return read_plane(in, start);
  if (cursor.take("FUNCTION RESET TCPM") && cursor.is_at_end()) {
    in.words.name = "FUNCTION RESET TCPM";
    in.words.tip = TipWords::End;
    return in.block.kind = BlockKind::TipControl, true;
  }
  cursor.back_to(start);
  if (cursor.take("FUNCTION TCPM")) return read_tip_control(in, start);
  cursor.back_to(start);
  if (is_parameter(start)) return cursor.advance(), read_assignment(in);
  const bool is_axis = is_axis_letter(*start) && !(start[1] >= 'A' && start[1] <= 'P');
  if (*start == 'I' || is_axis) return read_path(in, BlockKind::SingleAxis);
  if (*start == 'M' && TextCursor::is_digit(start[1])) {
    return in.block.kind = BlockKind::Line, read_m_words(in);
  }
  return refuse_keyword(in, start);
}

bool read_c(Reading& in, const char* start) {
  TextCursor& cursor = in.cursor;
  if (cursor.take("CYCL DEF")) return cursor.wrong("CYCL DEF without its number");
  if (cursor.take("CYCL CALL POS")) return read_call_at(in);
  if (cursor.take("CYCL CALL PAT")) return refuse(in, start);
  if (cursor.take("CYCL CALL")) return in.block.kind = BlockKind::CycleCall, read_m_words(in);
  if (cursor.take("CALL LBL")) return read_label_call(in);
  if (cursor.take("CALL PGM")) return read_program_call(in);
  if (cursor.take("CALL")) return refuse(in, start);
  if (cursor.take("CHF")) return read_corner(in, BlockKind::Chamfer);
  if (cursor.take("CTP") || cursor.take("CYC")) return refuse_keyword(in, start);
  if (cursor.take("CC")) return read_center(in);
  if (cursor.take("CP")) return read_path(in, BlockKind::PolarArc);
  if (cursor.take("CT")) return read_path(in, BlockKind::TangentArc);
  if (cursor.take("CR")) return read_path(in, BlockKind::RadiusArc);
  if ((kCharacterBits[static_cast<unsigned char>(start[1])] & kValueBit) != 0) {
    return read_path(in, BlockKind::SingleAxis);
  }
  return cursor.advance(), read_path(in, BlockKind::Arc);
}

bool read_l(Reading& in, const char* start) {
  TextCursor& cursor = in.cursor;
  if (cursor.take("LBL")) return read_label(in, BlockKind::Label, 0) && cursor.ends();
  if (cursor.take("LP")) return read_path(in, BlockKind::PolarLine);
  cursor.advance();
  const bool is_other = start[1] >= 'A' && start[1] <= 'Z' && start[1] != 'I' &&
                        !is_axis_letter(start[1]) && start[1] != 'R' && start[1] != 'F' &&
                        start[1] != 'M';
  if (is_other) return refuse(in, start);  // LN and others
  return read_path(in, BlockKind::Line);
}

/// Whether a jump still finds a label that is skipped, and where a program ends without its end,
/// the manuals do not say.
bool may_be_skipped(TextCursor& cursor) {
  const char* start = cursor.at();
  bool may = true;
  for (const std::string_view word : {"LBL", "BEGIN", "END PGM"}) {
    may &= !cursor.take(word);
    cursor.back_to(start);
  }
  return may;
}

}  // namespace

}  // namespace dripline::interpreter::tnc155::itnc

namespace dripline::interpreter::tnc155 {

bool read_itnc_block(const char* begin, const char* end, const ReadingState& state,
                     BlockParts& parts, Fault& fault) {
  parts.clear();
  parts.itnc.clear();
  Block& block = parts.add(BlockKind::Line);
  const char* line_end = itnc::line_without_comment(begin, end);
  TextCursor cursor(begin, line_end, state.program, fault);
  itnc::Reading in{cursor, block, parts.itnc, line_end, false};
  constexpr std::int32_t kHighest = 99'999'999;
  const char* slash = (cursor.peek(), cursor.at());
  bool is_skipped = cursor.take('/');  // by the switch of the panel; it is off
  if (cursor.is_digit_next() && !cursor.read_integer(block.number, 0, kHighest, "block number")) {
    return false;
  }
  if (!is_skipped) {
    slash = (cursor.peek(), cursor.at());
    is_skipped = cursor.take('/');
  }
  const char* start = (cursor.peek(), cursor.at());
  if (cursor.is_at_end()) return cursor.unexpected();
  if (cursor.take("CYCL DEF") && cursor.is_digit_next()) return itnc::read_cycle(in, end);
  cursor.back_to(start);
  if (is_skipped && !itnc::may_be_skipped(cursor)) return itnc::refuse(in, slash);
  const bool is_read = *start == 'L'   ? itnc::read_l(in, start)
                       : *start == 'C' ? itnc::read_c(in, start)
                                       : itnc::read_keyword(in, start);
  if (!is_read || line_end == end || std::find(line_end, end, '\n') == end) return is_read;
  return cursor.wrong(ErrorCode::NotSupported, start, "~ in a block other than CYCL DEF");
}

}  // namespace dripline::interpreter::tnc155
