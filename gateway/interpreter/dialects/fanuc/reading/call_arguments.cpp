#include "gateway/interpreter/dialects/fanuc/reading/call_arguments.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <array>

#include "gateway/interpreter/dialects/fanuc/memory/variables.hpp"

namespace dripline::interpreter::fanuc {
namespace {

constexpr int kFirstOfG = 9010;
constexpr int kFirstOfM = 9020;
constexpr int kProgramOfT = 9000;
constexpr AddressSet kPlainArguments = set_of(D, H, M, S, T, F);

/// Assignment I: the variable of each letter, 0 where there is none.
constexpr std::array<std::uint8_t, kAddressCount> kVariableOf{
    1, 2, 3, 7, 8, 9, 0, 11, 4, 5, 6, 0, 13, 0, 0, 0, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26};

std::ptrdiff_t place_in(const std::vector<std::int64_t>& codes, double code) {
  const auto at = std::find_if(codes.begin(), codes.end(), [code](std::int64_t each) {
    return static_cast<double>(each) == code;
  });
  return at == codes.end() ? -1 : at - codes.begin();
}

bool read_call_number(Run& run, const Word& word, double most, const DiagnosticRow& error,
                      double& value) {
  value = run.whole(word);
  if (word.form == WordForm::Point) return run.fail(ErrorCode::DecimalPoint, word.column);
  if (value >= 1 && value <= most) return true;
  return run.fail(error, word.column, fmt::format("{} is not 1 to {}", value, most));
}

/// Numbers of arguments without a point count least increments, or units, by their letter.
double argument_value(Run& run, char letter, const Word& word) {
  if (word.form != WordForm::Whole || run.options.calculator_point) return word.value;
  const AddressSet set = set_of(address_of(letter));
  if ((set & kPlainArguments) != 0) return word.value;
  if (word.value != 0) run.block.warn(WarningCode::ArgumentWithoutPoint, word.column);
  return word.value /
         ((set & kRotaryWords) != 0 ? run.increments.per_degree : run.increments.per_unit);
}

}  // namespace

bool is_in_code_call(const Run& run) {
  return std::any_of(run.state.calls.begin(), run.state.calls.end(),
                     [](const CallFrame& frame) { return frame.kind == CallKind::Code; });
}

bool calls_macro_by_g(const Run& run, double code) {
  return !run.options.g_macros.empty() && place_in(run.options.g_macros, code) >= 0 &&
         !is_in_code_call(run);
}
bool calls_macro_by_m(const Run& run, double code) {
  return !run.options.m_macros.empty() && place_in(run.options.m_macros, code) >= 0 &&
         !is_in_code_call(run);
}

bool begin_call(Run& run, bool is_modal, std::uint32_t column) {
  Block& block = run.block;
  if (block.words.present() != 0) {
    return run.fail(ErrorCode::ArgumentAddress, column, "words stand before the call");
  }
  block.parts.kind = BlockKind::Call;
  block.parts.is_modal_call = is_modal;
  block.parts.call = CallKind::Macro;
  return true;
}

bool begin_code_call(Run& run, CodeCall by, double code, std::uint32_t column) {
  Block::Parts& parts = run.block.parts;
  if (!begin_call(run, false, column)) return false;
  parts.call = CallKind::Code;
  parts.has_call_program = true;
  switch (by) {
    case CodeCall::G:
      parts.call_program =
          static_cast<std::uint32_t>(kFirstOfG + place_in(run.options.g_macros, code));
      return true;
    case CodeCall::M:
      parts.call_program =
          static_cast<std::uint32_t>(kFirstOfM + place_in(run.options.m_macros, code));
      return true;
    case CodeCall::T:
      break;
  }
  parts.call_program = kProgramOfT;
  parts.variable = 149;
  parts.value = code;
  return true;
}

bool add_argument(Run& run, char letter, const Word& word) {
  Block& block = run.block;
  double value = 0;
  if (letter == 'P' && block.parts.call != CallKind::Code) {
    if (block.parts.name_end != 0)
      return run.fail(ErrorCode::ImproperCommand, word.column, "two programs in one block");
    if (run.options.model == Model::M0 && word.form == WordForm::Computed) {
      return run.fail(ErrorCode::ImproperG, word.column, "MACRO A");
    }
    if (!read_call_number(run, word, run.options.program_digits == 8 ? 99'999'999 : 9999,
                          ErrorCode::IllegalProgramNumber, value))
      return false;
    block.parts.call_program = static_cast<std::uint32_t>(value);
    block.parts.has_call_program = true;
    return true;
  }
  if (letter == 'L') {
    if (!read_call_number(run, word, 9999, ErrorCode::TooManyDigits, value)) return false;
    block.parts.call_passes = static_cast<std::uint32_t>(value);
    return true;
  }
  if (kVariableOf[static_cast<std::size_t>(letter - 'A')] == 0) {
    return run.fail(ErrorCode::ArgumentAddress, word.column, std::string_view(&letter, 1));
  }
  if (block.parts.argument_count == Block::kMaxArguments) {
    return run.fail(ErrorCode::ArgumentAddress, word.column, "too many arguments");
  }
  block.arguments[block.parts.argument_count++] = {letter, argument_value(run, letter, word)};
  return true;
}

/// A repeated or descending I, J or K begins the next set: #4 to #6, #7 to #9, up to #33.
bool assign_arguments(Run& run, Locals& locals) {
  constexpr int kMaxSets = 10;
  const Block& block = run.block;
  locals = null_locals();
  int set = 0;
  char last = 'H';
  for (std::size_t i = 0; i < block.parts.argument_count; ++i) {
    const Argument& argument = block.arguments[i];
    int variable = kVariableOf[static_cast<std::size_t>(argument.letter - 'A')];
    if (argument.letter >= 'I' && argument.letter <= 'K') {
      if (argument.letter <= last) ++set;
      last = argument.letter;
      if (set == kMaxSets)
        return run.fail(ErrorCode::ArgumentAddress, 0, "more than 10 sets of I J K");
      variable += 3 * set;
    }
    locals[static_cast<std::size_t>(variable - 1)] = argument.value;
  }
  return true;
}

}  // namespace dripline::interpreter::fanuc
