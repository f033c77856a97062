#include "gateway/interpreter/dialects/centurion/flow/output_text.hpp"

#include <fmt/core.h>
#include <array>
#include <cmath>

#include "gateway/interpreter/dialects/centurion/reading/expression_reader.hpp"

namespace dripline::interpreter::centurion {
namespace {

constexpr int kPrintableParameters = 500;
constexpr int kAsciiFormat = 0;
constexpr int kTimeFormat = -1;
constexpr int kDateFormat = -2;
/// The powers for the maximum number of decimals of #n[LT].
constexpr std::array<double, 10> kPowersOfTen{1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9};

bool append_clock(Run& run, int format) {
  const Answer* answer = run.next_answer();
  if (answer == nullptr) return run.ask(TimeQuestion{});
  const auto& now = std::get<LocalTime>(*answer);
  if (format == kTimeFormat) {
    run.scratch += fmt::format("{:03}:{:02}:{:02}", now.hour, now.minute, now.second);
  } else {
    run.scratch += fmt::format("{:02}/{:02}/{:02}", now.year % 100, now.month, now.day);
  }
  return true;
}

bool append_formatted(Run& run, double value, int format, std::uint32_t column) {
  if (format == kTimeFormat || format == kDateFormat) return append_clock(run, format);
  if (format == kAsciiFormat) {
    const double code = std::round(value);
    if (!(code >= 1 && code <= 127)) {
      return run.fail(ErrorCode::ParameterOutOfRange, column,
                      fmt::format("{} is not the code of a character", value));
    }
    run.scratch += static_cast<char>(code);
    return true;
  }
  append_number(run.scratch, value, format / 10, format % 10);
  return true;
}

/// LT of #n[LT]: two digits, or -1 or -2.
bool read_format(Run& run, const char*& at, int& format) {
  const char* start = at;
  ++at;  // the bracket
  const bool negative = *at == '-';
  if (negative) ++at;
  int digits = 0;
  for (format = 0; is_digit(*at) && digits < 3; ++at, ++digits) format = 10 * format + (*at - '0');
  if (negative) format = -format;
  if (digits == 0 || digits > 2 || format < kDateFormat) {
    return run.fail(ErrorCode::BadNumber, run.column(start), "format of #n is [LT], [-1] or [-2]");
  }
  if (*at != ']') return run.fail(ErrorCode::MissingCloseBracket, run.column(at));
  ++at;
  return true;
}

/// `at` is on the #.
bool append_parameter(Run& run, const char*& at) {
  const std::uint32_t column = run.column(at);
  ++at;
  if (!is_digit(*at)) {
    return run.fail(ErrorCode::BadNumber, column, "# needs a parameter number");
  }
  int number = 0;
  while (is_digit(*at) && number < kPrintableParameters) number = 10 * number + (*at++ - '0');
  if (!check_parameter_number(run, number, kPrintableParameters, column)) return false;
  double value = 0;
  if (!read_parameter(run, number, column, value)) return false;
  if (*at == '[') {
    int format = 0;
    return read_format(run, at, format) && append_formatted(run, value, format, column);
  }
  const auto units = static_cast<std::size_t>(run.state.units);
  append_number(run.scratch, value, run.options.leading_digits[units],
                run.options.trailing_digits[units]);
  if (*at == ' ') ++at;  // this blank only ends the number
  return true;
}

/// The text between the brackets into `scratch`. Everything but #n is copied.
bool read_text(Run& run, const char*& at) {
  if (!skip_gaps(run, at)) return false;
  if (*at != '[') return run.fail(ErrorCode::MissingOpenBracket, run.column(at));
  ++at;
  run.scratch.clear();
  while (*at != ']') {
    if (*at == '#') {
      if (!append_parameter(run, at)) return false;
      continue;
    }
    if (is_end_of_block(*at)) return run.fail(ErrorCode::MissingCloseBracket, run.column(at));
    if (kind_of(*at) == CharKind::Bad) return run.fail(ErrorCode::BadCharacter, run.column(at));
    run.scratch += *at++;
  }
  ++at;
  return true;
}

}  // namespace

void append_number(std::string& text, double value, int leading, int decimals) {
  // Decimal fractions are rarely exact in binary: a half as written must round as a half.
  constexpr double kNudge = 1e-9;
  const double scaled = std::floor(
      std::fabs(value) * kPowersOfTen[static_cast<std::size_t>(decimals)] + 0.5 + kNudge);
  const int zero_padded = leading + decimals + (decimals > 0 ? 1 : 0);
  if (scaled >= 9e15) {  // beyond what the scaled number holds exactly
    text += fmt::format("{:0{}.{}f}", value, value < 0 ? zero_padded + 1 : zero_padded, decimals);
    return;
  }
  if (value < 0 && scaled > 0) text += '-';
  const auto whole_and_decimals = static_cast<std::uint64_t>(scaled);
  const auto power = static_cast<std::uint64_t>(kPowersOfTen[static_cast<std::size_t>(decimals)]);
  text += fmt::format("{:0{}}", whole_and_decimals / power, leading);
  if (decimals > 0) text += fmt::format(".{:0{}}", whole_and_decimals % power, decimals);
}

bool print_to_screen(Run& run, const char*& at) {
  if (!read_text(run, at)) return false;
  run.events().on_output({run.origin, OutputDevice::Screen, run.scratch});
  return true;
}

bool print_to_device(Run& run, const char*& at) {
  const std::uint32_t column = run.column(at);
  if (!read_text(run, at)) return false;
  if (!run.state.open_device) {
    return run.fail(ErrorCode::FileNotOpen, column, "DPRNT without POPEN");
  }
  run.events().on_output({run.origin, *run.state.open_device, run.scratch});
  return true;
}

bool open_device(Run& run, const char*& at) {
  if (!skip_gaps(run, at)) return false;
  const std::uint32_t column = run.column(at);
  if (!take_word(at, "P")) return run.fail(ErrorCode::IllegalStatement, column, "POPEN needs P");
  std::uint32_t number = 0;
  if (!read_whole(run, at, 2, number)) return false;
  constexpr OutputDevice kDevices[] = {OutputDevice::File, OutputDevice::Port1,
                                       OutputDevice::Port2};
  close_open_device(run);
  run.state.open_device = kDevices[number];
  Open opened{run.origin, kDevices[number], {}};
  if (opened.device == OutputDevice::File) opened.name = run.options.report_file;
  run.events().on_open(opened);
  return true;
}

void close_open_device(Run& run) {
  if (!run.state.open_device) return;
  run.events().on_close({run.origin, *run.state.open_device});
  run.state.open_device.reset();
}

}  // namespace dripline::interpreter::centurion
