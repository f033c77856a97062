#include "clients/cli/server/program_folder.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>

#include "gateway/interpreter/core/called_program_names.hpp"

namespace dripline::cli {

std::optional<std::string> find_called_program(const std::string& folder, std::string_view name) {
  for (const auto& file_name : interpreter::called_program_names(name)) {
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
