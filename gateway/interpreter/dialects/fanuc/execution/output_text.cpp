#include "gateway/interpreter/dialects/fanuc/execution/output_text.hpp"

#include <fmt/format.h>
#include <array>
#include <cmath>
#include <iterator>

#include "gateway/interpreter/dialects/fanuc/memory/variables.hpp"
#include "gateway/interpreter/dialects/fanuc/reading/block_reader.hpp"
#include "gateway/interpreter/dialects/fanuc/reading/expression_reader.hpp"

namespace dripline::interpreter::fanuc {
namespace {

constexpr std::array<double, 10> kPowersOfTen{1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9};
constexpr int kMaxDigits = 8;

bool refuse(Run& run, const char* at, std::string_view detail) {
  return run.fail(ErrorCode::MacroFormat, run.column(at), detail);
}

/// A variable and its value; `at` is on the #.
bool read_value(Run& run, const char*& at, double& value) {
  const std::uint32_t column = run.column(at);
  int number = 0;
  if (!read_variable_number(run, at, number)) return false;
  if (!read_variable(run, number, column, value)) return false;
  if (std::isnan(value)) value = 0;
  return true;
}

/// Up to two digits in brackets; -1 for the first when there is only one.
bool read_format(Run& run, const char*& at, int& first, int& second) {
  at = skip_blanks(at);
  const char* start = at;
  if (*at != '[') return refuse(run, at, "# needs its format in brackets");
  std::array<int, 2> digits{};
  std::size_t count = 0;
  for (at = skip_blanks(at + 1); is_digit(*at); at = skip_blanks(at + 1)) {
    if (count == digits.size()) return refuse(run, start, "a format has one or two digits");
    digits[count++] = *at - '0';
  }
  if (count == 0 || *at != ']') return refuse(run, start, "a format has one or two digits");
  ++at;
  first = count == 2 ? digits[0] : -1;
  second = digits[count - 1];
  return true;
}

bool append_decimal_variable(Run& run, const char*& at) {
  const char* start = at;
  double value = 0;
  DecimalField field;
  if (!read_value(run, at, value) || !read_format(run, at, field.whole, field.decimals)) {
    return false;
  }
  if (field.whole < 0) field.whole = kMaxDigits - field.decimals;
  if (field.whole < 0 || field.whole + field.decimals > kMaxDigits) {
    return refuse(run, start, "a format has at most 8 digits");
  }
  field.blanks_for_zeros = run.options.leading_zero_print;
  field.expands = run.options.print_expands;
  append_decimal(run.scratch, value, field);
  return true;
}

bool append_binary_variable(Run& run, const char*& at) {
  const char* start = at;
  double value = 0;
  int first = 0;
  int decimals = 0;
  if (!read_value(run, at, value) || !read_format(run, at, first, decimals)) return false;
  if (first >= 0) return refuse(run, start, "the format of BPRNT is one digit");
  append_binary(run.scratch, value, decimals);
  return true;
}

/// Between the brackets; blanks mean nothing, * is a blank.
template <class AppendVariable>
bool read_text(Run& run, const char*& at, AppendVariable append_variable) {
  skip_gaps(run, at);
  if (*at != '[') return refuse(run, at, "[ is expected here");
  ++at;
  run.scratch.clear();
  while (*at != ']') {
    const CharKind kind = kind_of(*at);
    if (kind == CharKind::EndOfBlock) return refuse(run, at, "] is missing");
    if (kind == CharKind::Bad) return run.fail(ErrorCode::IllegalAddress, run.column(at));
    if (kind == CharKind::Hash) {
      if (!append_variable(run, at)) return false;
      continue;
    }
    if (kind != CharKind::Blank) {
      run.scratch += *at == '*' ? ' ' : kind == CharKind::Letter ? upper(*at) : *at;
    }
    ++at;
  }
  ++at;
  return true;
}

}  // namespace

void append_decimal(std::string& text, double value, const DecimalField& field) {
  // Decimal fractions are rarely exact in binary: what is written as a half must round as one.
  constexpr double kNudge = 1e-9;
  constexpr double kMax = 9e15;  // beyond it the scaled number is not exact
  const auto power =
      static_cast<std::uint64_t>(kPowersOfTen[static_cast<std::size_t>(field.decimals)]);
  const double exact = std::fabs(value) * static_cast<double>(power);
  const auto scaled = static_cast<std::uint64_t>(std::floor(std::fmin(exact, kMax) + 0.5 + kNudge));
  std::uint64_t whole = scaled / power;
  const std::uint64_t fraction = scaled % power;
  if (!field.expands) {
    whole %= static_cast<std::uint64_t>(kPowersOfTen[static_cast<std::size_t>(field.whole)]);
  }
  if (value < 0 && scaled != 0) {
    text += '-';
  } else if (field.blanks_for_zeros && !field.expands) {
    text += ' ';
  }
  if (field.whole > 0 || field.expands) {
    const bool pads = field.blanks_for_zeros && field.whole > 0;
    text += fmt::format("{:>{}}", whole, pads ? field.whole : 1);
  }
  if (field.decimals > 0) {
    text += fmt::format(".{:0{}}", fraction, field.decimals);
  }
}

void append_binary(std::string& text, double value, int decimals) {
  const double scaled = std::round(value * kPowersOfTen[static_cast<std::size_t>(decimals)]);
  // Two's complement of what fits; beyond it the high bits are lost, as in any register.
  const double low = std::fmod(scaled, 4294967296.0);
  const auto bits = static_cast<std::uint32_t>(static_cast<std::int64_t>(low));
  for (int shift = 24; shift >= 0; shift -= 8) {
    text += fmt::format("\\x{:02X}", bits >> shift & 0xFF);
  }
}

bool read_decimal_output(Run& run, const char*& at) {
  return read_text(run, at, append_decimal_variable);
}
bool read_binary_output(Run& run, const char*& at) {
  return read_text(run, at, append_binary_variable);
}

bool execute_output(Run& run) {
  ModalState& state = run.state;
  switch (run.block.parts.statement) {
    case StatementKind::OpenPort:
      state.is_port_open = true;
      run.events().on_open({run.origin, OutputDevice::Port1, {}});
      return true;
    case StatementKind::ClosePort:
      if (!state.is_port_open)
        run.warn(WarningCode::PrintNotOpen, run.block.parts.statement_column);
      state.is_port_open = false;
      run.events().on_close({run.origin, OutputDevice::Port1});
      return true;
    default:
      break;
  }
  if (!state.is_port_open) run.warn(WarningCode::PrintNotOpen, run.block.parts.statement_column);
  run.events().on_output({run.origin, OutputDevice::Port1, run.scratch});
  return true;
}

}  // namespace dripline::interpreter::fanuc
