#include "server/feeds/called_programs.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <optional>

#include "protocol/base/names.hpp"

namespace dripline::feeds {
namespace {

constexpr std::string_view kExtensions[] = {"",   ".nc", ".NC",  ".h",   ".H",
                                            ".i", ".I",  ".txt", ".tap", ".cnc"};

/// The digits of `O0002` without leading zeros ("2"), or empty when `name` is not of this form.
std::string program_number(std::string_view name) {
  if (name.size() < 2 || (name.front() != 'O' && name.front() != 'o')) return {};
  std::string_view digits = name.substr(1);
  if (!std::ranges::all_of(digits, [](char c) { return c >= '0' && c <= '9'; })) return {};
  digits.remove_prefix(std::min(digits.find_first_not_of('0'), digits.size() - 1));
  return std::string(digits);
}

}  // namespace

std::vector<std::string> library_names(std::string_view name) {
  std::vector<std::string> stems{std::string(name)};
  if (const std::string number = program_number(name); !number.empty()) {
    for (const char letter : {'O', 'o'}) {
      for (const int width : {4, 1, 5, 8}) {
        std::string stem = fmt::format("{}{:0>{}}", letter, number, width);
        if (std::ranges::find(stems, stem) == stems.end()) stems.push_back(std::move(stem));
      }
    }
  }
  std::vector<std::string> names;
  for (const auto& stem : stems) {
    for (const auto extension : kExtensions) names.push_back(stem + std::string(extension));
  }
  return names;
}

Result<storage::Revision> resolve_called_program(storage::Store& store, const storage::Run& run,
                                                 const std::string& name) {
  if (auto good = check_program_name(name); !good)
    return fail(Errc::NotFound, "{}", good.error().what);
  for (const auto& candidate : library_names(name)) {
    auto revisions = store.revisions(candidate);
    if (!revisions) {
      if (revisions.error().code == Errc::NotFound) continue;
      return fail(revisions.error());
    }
    const storage::Revision* pinned = nullptr;
    for (const auto& revision : *revisions) {
      const bool fits = revision.control.empty() || revision.control == run.control;
      if (revision.is_held || revision.in_force_since() > run.created || !fits) continue;
      if (pinned == nullptr || revision.number > pinned->number) pinned = &revision;
    }
    if (pinned != nullptr) return *pinned;
  }
  return fail(
      Errc::NotFound,
      "program '{}' called by '{}' was not in the library for control {} when the run began", name,
      run.program, run.control);
}

}  // namespace dripline::feeds
