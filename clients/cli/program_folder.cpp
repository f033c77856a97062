#include "clients/cli/program_folder.hpp"

#include <fmt/core.h>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "protocol/base/names.hpp"

namespace dripline::cli {
namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// The number of "O0002" or "2" without leading zeros; empty for other names.
std::string program_number(std::string_view name) {
  if (name.starts_with('O') || name.starts_with('o')) name.remove_prefix(1);
  if (name.empty()) return {};
  for (const char c : name) {
    if (!is_digit(c)) return {};
  }
  while (name.size() > 1 && name.front() == '0') name.remove_prefix(1);
  return std::string(name);
}

}  // namespace

std::vector<std::string> called_program_names(std::string_view name) {
  if (!check_program_name(name)) return {};
  std::vector<std::string> names;
  if (const std::string number = program_number(name); !number.empty()) {
    names = {"O" + number + ".nc", fmt::format("O{:0>4}.nc", number), number + ".nc", number + ".h",
             number + ".i"};
  }
  names.emplace_back(name);
  names.push_back(std::string(name) + ".nc");
  return names;
}

std::optional<std::string> find_called_program(const std::string& folder, std::string_view name) {
  for (const auto& file_name : called_program_names(name)) {
    const auto path = std::filesystem::path(folder) / file_name;
    std::error_code ec;
    if (std::filesystem::is_regular_file(path, ec) && std::ifstream(path, std::ios::binary)) {
      return path.string();
    }
  }
  return std::nullopt;
}

std::optional<std::string> load_called_program(const std::string& folder, std::string_view name) {
  const auto path = find_called_program(folder, name);
  if (!path) return std::nullopt;
  std::ifstream file(*path, std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(file), {});
}

}  // namespace dripline::cli
