#include "gateway/interpreter/dialects/rs274ngc/reading/oword_reader.hpp"

#include <fmt/core.h>
#include <algorithm>

#include "gateway/interpreter/dialects/rs274ngc/reading/block_reader.hpp"
#include "gateway/interpreter/dialects/rs274ngc/reading/expression_reader.hpp"
#include "gateway/interpreter/dialects/rs274ngc/reading/words.hpp"

namespace dripline::interpreter::rs274ngc {
namespace {

struct Spelling {
  const char* text;
  Oword word;
};
/// Longer words before their beginnings.
constexpr std::array kSpellings{Spelling{"SUB", Oword::Sub},
                                Spelling{"ENDSUB", Oword::EndSub},
                                Spelling{"CALL", Oword::Call},
                                Spelling{"RETURN", Oword::Return},
                                Spelling{"IF", Oword::If},
                                Spelling{"ELSEIF", Oword::ElseIf},
                                Spelling{"ELSE", Oword::Else},
                                Spelling{"ENDIF", Oword::EndIf},
                                Spelling{"WHILE", Oword::While},
                                Spelling{"ENDWHILE", Oword::EndWhile},
                                Spelling{"DO", Oword::Do},
                                Spelling{"REPEAT", Oword::Repeat},
                                Spelling{"ENDREPEAT", Oword::EndRepeat},
                                Spelling{"BREAK", Oword::Break},
                                Spelling{"CONTINUE", Oword::Continue}};

Oword take_oword(const char*& at) {
  const char first = upper(*at);
  for (const Spelling& spelling : kSpellings) {
    if (spelling.text[0] == first && take_word(at, spelling.text)) return spelling.word;
  }
  return Oword::None;
}

/// Names come after the numbers, by their place among the names met so far.
constexpr std::int64_t kFirstName = std::int64_t{1} << 40;

bool name_label(Run& run, std::uint32_t column, Label& label) {
  auto& names = run.state.label_names;
  const auto known = std::find(names.begin(), names.end(), run.scratch);
  if (known == names.end() && names.size() == kMaxLabels) {
    return run.fail(ErrorCode::OwordNesting, column, fmt::format("more than {} names", kMaxLabels));
  }
  label.value = kFirstName + (known - names.begin());
  if (known == names.end()) names.push_back(run.scratch);
  return true;
}

bool read_label(Run& run, const char*& at, Label& label) {
  at = skip_blanks(at);
  const std::uint32_t column = run.column(at);
  if (*at == '<') return read_name(run, at, run.scratch) && name_label(run, column, label);
  if (!is_digit(*at) && *at != '[' && *at != '#') return run.fail(ErrorCode::OwordMissing, column);
  int number = 0;
  if (!read_integer(run, at, number)) return false;
  if (number < 0) return run.fail(ErrorCode::OwordMissing, column, "a negative number");
  label.value = number;
  return true;
}

bool is_end_of_items(char c) {
  return is_end_of_line(c) || c == '(' || c == ';';
}

}  // namespace

bool read_oword(Run& run, const char* at, OwordHead& head) {
  ++at;
  if (!read_label(run, at, head.label)) return false;
  at = skip_blanks(at);
  head.after = at;
  if (is_end_of_items(*at)) {
    head.word = Oword::Alone;
    return true;
  }
  head.word = take_oword(at);
  head.after = at;
  return head.word != Oword::None || run.fail(ErrorCode::OwordUnknown, run.column(at));
}

OwordHead peek_oword(Run& run) {
  OwordHead head;
  const char* at = run.line_begin;
  bool is_skip = false;
  const bool is_oword = read_line_head(run, at, is_skip) && upper(*at) == 'O' &&
                        !(is_skip && run.block_skip) && read_oword(run, at, head);
  run.pause = Pause::None;
  if (!is_oword) head.word = Oword::None;
  return head;
}

bool read_operand(Run& run, const char*& at, double& value) {
  at = skip_blanks(at);
  if (*at != '[') return run.fail(ErrorCode::OwordExpression, run.column(at));
  return read_expression(run, at, value);
}

bool end_of_oword(Run& run, const char* at) {
  if (!skip_comments(run, at)) return false;
  return is_end_of_line(*at) || run.fail(ErrorCode::OwordTrailing, run.column(at));
}

}  // namespace dripline::interpreter::rs274ngc
