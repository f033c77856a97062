#include "protocol/base/names.hpp"

#include <algorithm>

namespace dripline {
namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool is_lower(char c) {
  return c >= 'a' && c <= 'z';
}
bool is_upper(char c) {
  return c >= 'A' && c <= 'Z';
}
bool is_program_name_character(char c) {
  return is_digit(c) || is_lower(c) || is_upper(c) ||
         std::string_view(" ._-+").find(c) != std::string_view::npos;
}
bool is_machine_name_character(char c) {
  return is_digit(c) || is_lower(c) || c == '-' || c == '_';
}

/// The name of a machine or port on the shop floor.
Result<void> check_handle(std::string_view thing, std::string_view name) {
  if (name.empty()) return fail(Errc::Syntax, "a {} name cannot be empty", thing);
  if (name.size() > kMaxMachineName) {
    return fail(Errc::LimitExceeded, "{} name of {} characters: at most {}", thing, name.size(),
                kMaxMachineName);
  }
  if (!std::ranges::all_of(name, is_machine_name_character) ||
      !(is_digit(name.front()) || is_lower(name.front()))) {
    return fail(Errc::Syntax,
                "{} name '{}': use lower-case letters, digits, - and _, beginning with a "
                "letter or digit",
                thing, name);
  }
  return {};
}

}  // namespace

Result<void> check_program_name(std::string_view name) {
  if (name.empty()) return fail(Errc::Syntax, "a program name cannot be empty");
  if (name.size() > kMaxProgramName) {
    return fail(Errc::LimitExceeded, "program name of {} characters: at most {}", name.size(),
                kMaxProgramName);
  }
  if (!std::ranges::all_of(name, is_program_name_character) || name.front() == '.' ||
      name.front() == '-' || name.front() == ' ' || name.back() == ' ') {
    return fail(Errc::Syntax,
                "program name '{}': use letters, digits, blanks and . _ - +, not beginning with a "
                "dot, a minus or a blank",
                name);
  }
  return {};
}

Result<void> check_machine_name(std::string_view name) {
  return check_handle("machine", name);
}

Result<void> check_port_name(std::string_view name) {
  return check_handle("port", name);
}

}  // namespace dripline
