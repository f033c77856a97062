#include "tests/golden/golden_case.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <sstream>

namespace dripline::interpreter {
namespace fs = std::filesystem;

namespace {
const fs::path kRoot = "tests/golden";  // tests run in the source folder
}

std::vector<GoldenCase> golden_cases() {
  std::vector<GoldenCase> cases;
  if (!fs::exists(kRoot)) return cases;
  for (const auto& control : fs::directory_iterator(kRoot)) {
    if (!control.is_directory()) continue;
    for (const auto& folder : fs::directory_iterator(control)) {
      if (!fs::exists(folder.path() / "program.nc")) continue;
      cases.push_back({control.path().filename(), folder.path().filename(), folder.path()});
    }
  }
  std::sort(cases.begin(), cases.end(),
            [](const auto& a, const auto& b) { return a.folder < b.folder; });
  return cases;
}

std::string read_text(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

Setup setup_of(const GoldenCase& golden, const Dialect& dialect) {
  const fs::path path = golden.folder / "setup.toml";
  const auto setup = parse_setup(fs::exists(path) ? read_text(path) : "", dialect.units);
  if (!setup) throw std::runtime_error(path.string() + ": " + setup.error().what);
  return *setup;
}

MemorySource::Loader loader_of(const GoldenCase& golden) {
  return [folder = golden.folder](std::string_view name) -> std::optional<std::string> {
    const fs::path path = folder / (std::string(name) + ".nc");
    if (!fs::exists(path)) return std::nullopt;
    return read_text(path);
  };
}

std::optional<Verdict> verdict_of(const GoldenCase& golden, const std::string& program) {
  const fs::path file = golden.folder / "verdict.txt";
  const std::string text = fs::exists(file) ? read_text(file) : program;
  char id[32] = {};
  unsigned long line = 0;
  unsigned column = 0;
  if (std::sscanf(text.c_str(), "(expect %31[-A-Za-z0-9] %lu:%u)", id, &line, &column) != 3) {
    return std::nullopt;
  }
  return Verdict{id, line, column};
}

}  // namespace dripline::interpreter
