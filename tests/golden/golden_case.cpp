#include "tests/golden/golden_case.hpp"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <fstream>
#include <sstream>

namespace dripline::interpreter {
namespace fs = std::filesystem;

namespace {

const fs::path kRoot = "tests/golden";  // tests run in the source folder
constexpr std::string_view kSuffix = ".golden";
constexpr std::string_view kOpen = "-- ";
constexpr std::string_view kClose = " --";
constexpr std::string_view kUnended = ", without a final newline --";
constexpr std::string_view kTrace = "expected.jsonl";

std::string read_file(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("there is no golden case " + path.string());
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// The name in a line `-- NAME --`; empty for every other line.
std::string_view part_name(std::string_view line) {
  if (!line.starts_with(kOpen)) return {};
  line.remove_prefix(kOpen.size());
  if (line.ends_with(kUnended)) return line.substr(0, line.size() - kUnended.size());
  if (line.ends_with(kClose)) return line.substr(0, line.size() - kClose.size());
  return {};
}

GoldenCase parse_case(const fs::path& file, const std::string& text) {
  GoldenCase golden{file.parent_path().filename(), file.stem(), file, {}, {}};
  bool is_unended = false;
  const auto end_part = [&] {
    if (is_unended) golden.parts.back().second.pop_back();
  };
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t newline = text.find('\n', begin);
    if (newline == std::string::npos) throw std::runtime_error(file.string() + " is cut off");
    const auto line = std::string_view(text).substr(begin, newline - begin);
    if (const auto name = part_name(line); !name.empty()) {
      end_part();
      golden.parts.emplace_back(name, "");
      is_unended = line.ends_with(kUnended);
    } else {
      auto& part = golden.parts.empty() ? golden.note : golden.parts.back().second;
      part.append(line).push_back('\n');
    }
    begin = newline + 1;
  }
  end_part();
  if (golden.find("program.nc") == nullptr) {
    throw std::runtime_error(file.string() + " has no part program.nc");
  }
  return golden;
}

}  // namespace

const std::string* GoldenCase::find(std::string_view part) const {
  const auto found = std::find_if(parts.begin(), parts.end(),
                                  [&](const auto& each) { return each.first == part; });
  return found == parts.end() ? nullptr : &found->second;
}

std::string GoldenCase::text(std::string_view part) const {
  const std::string* found = find(part);
  return found == nullptr ? std::string() : *found;
}

std::ostream& operator<<(std::ostream& out, const GoldenName& golden) {
  return out << golden.control << '/' << golden.name;
}

std::vector<GoldenName> golden_names(std::string_view control) {
  std::vector<GoldenName> names;
  if (!fs::exists(kRoot)) return names;
  for (const auto& entry : fs::recursive_directory_iterator(kRoot)) {
    const fs::path& path = entry.path();
    if (path.extension() != kSuffix) continue;
    if (!control.empty() && path.parent_path().filename() != control) continue;
    names.push_back({path.parent_path().filename(), path.stem()});
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string test_name(const GoldenName& golden) {
  std::string name = golden.control + "_" + golden.name;
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}

std::vector<GoldenName> golden_named(std::string_view wanted) {
  if (!fs::exists(kRoot)) return {};
  for (const auto& folder : fs::directory_iterator(kRoot)) {
    const std::string control = folder.path().filename();
    if (!folder.is_directory() || !wanted.starts_with(test_name({control, {}}))) continue;
    for (const auto& file : fs::directory_iterator(folder)) {
      GoldenName golden{control, file.path().stem()};
      const std::size_t length = control.size() + 1 + golden.name.size();
      if (length == wanted.size() && test_name(golden) == wanted) return {std::move(golden)};
    }
  }
  return {};
}

std::vector<GoldenCase> golden_cases(std::string_view control) {
  std::vector<GoldenCase> cases;
  for (const auto& [folder, name] : golden_names(control)) {
    cases.push_back(read_golden_case(folder, name));
  }
  return cases;
}

GoldenCase read_golden_case(std::string_view control, std::string_view name) {
  const fs::path path = kRoot / control / (std::string(name) + std::string(kSuffix));
  return parse_case(path, read_file(path));
}

void accept_trace(GoldenCase golden, const std::string& trace) {
  auto expected = std::find_if(golden.parts.begin(), golden.parts.end(),
                               [](const auto& part) { return part.first == kTrace; });
  if (expected == golden.parts.end()) {
    expected = golden.parts.emplace(golden.parts.end(), kTrace, "");
  }
  expected->second = trace;
  std::ofstream file(golden.file, std::ios::binary);
  file << golden.note;
  for (const auto& [name, text] : golden.parts) {
    const bool is_unended = !text.empty() && text.back() != '\n';
    file << kOpen << name << (is_unended ? kUnended : kClose) << '\n'
         << text << (is_unended ? "\n" : "");
  }
}

Setup setup_of(const GoldenCase& golden, const Dialect& dialect) {
  const auto setup = parse_setup(golden.text("setup.toml"), dialect.units);
  if (!setup) throw std::runtime_error(golden.file.string() + ": " + setup.error().what);
  return *setup;
}

MemorySource::Loader loader_of(const GoldenCase& golden) {
  return [golden](std::string_view name) -> std::optional<std::string> {
    const std::string* part = golden.find(std::string(name) + ".nc");
    return part == nullptr ? std::nullopt : std::optional(*part);
  };
}

std::optional<Verdict> verdict_of(const GoldenCase& golden) {
  const std::string* part = golden.find("verdict");
  const std::string text = part == nullptr ? golden.program() : *part;
  char id[32] = {};
  unsigned long line = 0;
  unsigned column = 0;
  if (std::sscanf(text.c_str(), "(expect %31[-A-Za-z0-9] %lu:%u)", id, &line, &column) != 3) {
    return std::nullopt;
  }
  return Verdict{id, line, column};
}

}  // namespace dripline::interpreter
