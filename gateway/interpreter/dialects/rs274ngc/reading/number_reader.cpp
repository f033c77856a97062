#include "gateway/interpreter/dialects/rs274ngc/reading/number_reader.hpp"

#include <charconv>
#include <string>

namespace dripline::interpreter::rs274ngc {

namespace {

/// More digits than the fast reader takes: nothing is wrong with them here.
bool read_long_number(Run& run, const char*& at, double& value) {
  std::string digits;
  bool has_point = false;
  for (;; ++at) {
    if (is_blank(*at)) continue;
    const bool is_sign = (*at == '-' || *at == '+') && digits.empty();
    const bool is_point = *at == '.' && !has_point;
    if (!is_digit(*at) && !is_sign && !is_point) break;
    has_point |= is_point;
    digits += *at;
  }
  const char* begin = digits.c_str() + (digits.front() == '+' ? 1 : 0);
  const auto read = std::from_chars(begin, digits.c_str() + digits.size(), value);
  if (read.ec == std::errc{}) return true;
  return run.fail(ErrorCode::BadNumber, run.column(at), "a number this long");
}

}  // namespace

bool read_unusual_number(Run& run, const char*& at, double& value) {
  constexpr NumberRules kRules{.skip_blanks = true};
  NumberText number;
  // the line's end is no character of a number, so that no end need be given
  const char* after = read_number<kRules>(at, nullptr, number);
  switch (number.fault) {
    case NumberFault::None:
      value = number.value;
      at = after;
      return true;
    case NumberFault::TooManyDigits:
      return read_long_number(run, at, value);
    case NumberFault::SecondPoint:
      return run.fail(ErrorCode::BadNumber, run.column(at), "a second point");
    case NumberFault::NoDigits:
      break;
  }
  return run.fail(ErrorCode::NoDigits, run.column(at));
}

}  // namespace dripline::interpreter::rs274ngc
