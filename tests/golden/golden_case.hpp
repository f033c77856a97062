#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "gateway/interpreter/memory_source.hpp"
#include "gateway/interpreter/registry.hpp"

namespace dripline::interpreter {

/// One folder tests/golden/<control>/<case>: program.nc, setup.toml if the defaults will not do,
/// expected.jsonl, and a README.md that says which rule it shows.
struct GoldenCase {
  std::string control;
  std::string name;
  std::filesystem::path folder;
};

/// Every case in the tree, in the order of their names.
std::vector<GoldenCase> golden_cases();

std::string read_text(const std::filesystem::path& path);
/// Setup of the case: its file, or the defaults.
Setup setup_of(const GoldenCase& golden, const Dialect& dialect);
/// Called programs of the case: `O2.nc`, `O0002.nc` beside its program.
MemorySource::Loader loader_of(const GoldenCase& golden);

/// The verdict on a program that is to be refused, in its line 1 or, of a control without comments,
/// in a file verdict.txt beside it: `(expect CEN0549 4:9)`.
struct Verdict {
  std::string id;
  std::uint64_t line = 0;
  std::uint32_t column = 0;
};
std::optional<Verdict> verdict_of(const GoldenCase& golden, const std::string& program);

}  // namespace dripline::interpreter
