#pragma once

#include <compare>
#include <filesystem>
#include <map>
#include <optional>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "gateway/interpreter/core/program_source.hpp"
#include "gateway/interpreter/registry.hpp"

namespace dripline::interpreter {

/// One file tests/golden/<control>/<case>.golden: a note and the parts of the case, each after a
/// line `-- NAME --`. README.md of this folder lists the parts.
struct GoldenCase {
  std::string control;
  std::string name;
  std::filesystem::path file;
  std::string note;  ///< the text before the first part
  std::vector<std::pair<std::string, std::string>> parts;

  /// nullptr: the case has no such part.
  const std::string* find(std::string_view part) const;
  /// Empty when the case has no such part.
  std::string text(std::string_view part) const;
  std::string program() const { return text("program.nc"); }
};

/// Names one case without its text: every test runs in a process of its own, and reading all cases
/// for each of them took most of the suite's processor time.
struct GoldenName {
  std::string control;
  std::string name;
  friend auto operator<=>(const GoldenName&, const GoldenName&) = default;
};

/// Prints a case in gtest's listings.
std::ostream& operator<<(std::ostream& out, const GoldenName& golden);

/// Every case in the tree, or those of one control, in the order of their names.
std::vector<GoldenName> golden_names(std::string_view control = {});
/// `control_name`, with an underscore for what a name of gtest cannot have.
std::string test_name(const GoldenName& golden);
/// The case with this test name, if there is one.
std::vector<GoldenName> golden_named(std::string_view test_name);
/// Those of one control, or all, read.
std::vector<GoldenCase> golden_cases(std::string_view control = {});
/// Throws when there is no such file or its form is wrong.
GoldenCase read_golden_case(std::string_view control, std::string_view name);
/// Replaces the part `expected.jsonl` in the file of the case.
void accept_trace(GoldenCase golden, const std::string& trace);

/// Setup of the case: its part, or the defaults.
Setup setup_of(const GoldenCase& golden, const Dialect& dialect);
/// Called programs of the case: its parts `O2.nc`, `O0002.nc`.
MemorySource::Loader loader_of(const GoldenCase& golden);

/// The verdict on a program that is to be refused, in its line 1 or, of a control without comments,
/// in the part `verdict`: `(expect CEN0549 4:9)`.
struct Verdict {
  std::string id;
  std::uint64_t line = 0;
  std::uint32_t column = 0;
};
std::optional<Verdict> verdict_of(const GoldenCase& golden);

}  // namespace dripline::interpreter
