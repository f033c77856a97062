#include "gateway/interpreter/core/called_program_names.hpp"

#include <fmt/core.h>
#include <algorithm>

#include "protocol/base/names.hpp"

namespace dripline::interpreter {
namespace {

/// .h and .i are those of TNC programs, .ngc is the only one that LinuxCNC knows.
constexpr std::string_view kExtensions[] = {"",   ".nc", ".NC", ".ngc", ".NGC", ".h",
                                            ".H", ".i",  ".I",  ".txt", ".tap", ".cnc"};

/// The digits of `O0002` or `2` without leading zeros; empty when `name` is no number.
std::string program_number(std::string_view name) {
  if (name.starts_with('O') || name.starts_with('o')) name.remove_prefix(1);
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  if (name.empty() || !std::ranges::all_of(name, is_digit)) return {};
  name.remove_prefix(std::min(name.find_first_not_of('0'), name.size() - 1));
  return std::string(name);
}

}  // namespace

std::vector<std::string> called_program_names(std::string_view name) {
  if (!check_program_name(name)) return {};
  std::vector<std::string> stems{std::string(name)};
  const auto add = [&stems](std::string stem) {
    if (std::ranges::find(stems, stem) == stems.end()) stems.push_back(std::move(stem));
  };
  if (const std::string number = program_number(name); !number.empty()) {
    for (const char letter : {'O', 'o'}) {
      for (const int width : {4, 1, 5, 8}) add(fmt::format("{}{:0>{}}", letter, number, width));
    }
    add(number);
  }
  std::vector<std::string> names;
  for (const auto& stem : stems) {
    for (const auto extension : kExtensions) names.push_back(stem + std::string(extension));
  }
  return names;
}

}  // namespace dripline::interpreter
