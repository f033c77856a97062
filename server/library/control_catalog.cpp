#include "server/library/control_catalog.hpp"

#include <algorithm>
#include <array>
#include <map>

#include <fmt/ranges.h>

#include "gateway/interpreter/core/program_source.hpp"
#include "gateway/interpreter/registry.hpp"

namespace dripline::library {

Result<void> check_fits(const storage::Revision& revision, const storage::Machine& machine) {
  if (revision.control.empty() || machine.control.empty() || revision.control == machine.control) {
    return {};
  }
  return fail(Errc::Unsupported, "program '{}' revision {} is for control {}; machine '{}' is a {}",
              revision.program, revision.number, revision.control, machine.name, machine.control);
}

Result<void> check_control(const ControlCatalog& catalog, std::string_view control) {
  const std::vector<std::string> names = catalog.names();
  if (std::ranges::find(names, control) != names.end()) return {};
  return fail(Errc::Unsupported, "control '{}' is not known; known are: {}", control,
              fmt::join(names, ", "));
}

Result<std::string> detect_control(const ControlCatalog& catalog, std::string_view head,
                                   std::string_view program) {
  std::vector<std::string> candidates = catalog.detect(head, program);
  if (candidates.size() == 1) return std::move(candidates.front());
  if (candidates.empty()) {
    return fail(Errc::Unsupported,
                "program '{}' does not show which control it is for; name it, one of: {}", program,
                fmt::join(catalog.names(), ", "));
  }
  return fail(Errc::Unsupported, "program '{}' could be for several controls; name one of: {}",
              program, fmt::join(candidates, ", "));
}

std::vector<std::string> DialectCatalog::names() const {
  std::vector<std::string> names;
  for (const auto& dialect : interpreter::dialects()) names.emplace_back(dialect.name);
  return names;
}

std::vector<std::string> DialectCatalog::detect(std::string_view head,
                                                std::string_view program) const {
  std::vector<std::string> names;
  for (const auto* dialect : interpreter::detect_dialect(head, program)) {
    names.emplace_back(dialect->name);
  }
  return names;
}

Result<void> DialectCatalog::check_setup(std::string_view control, std::string_view toml) const {
  const auto dialect = interpreter::find_dialect(control);
  if (!dialect) return fail(dialect.error());
  const auto data = interpreter::parse_control_data(toml, (*dialect)->units);
  if (!data) return fail(data.error());
  interpreter::MemorySource no_text("");
  interpreter::EventSink no_sink;
  const auto made = (*dialect)->make(*data, no_text, no_sink);
  if (!made) return fail(made.error());
  return {};
}

bool DialectCatalog::is_protected(std::string_view control, std::string_view head) const {
  const auto dialect = interpreter::find_dialect(control);
  return dialect && (*dialect)->is_protected != nullptr && (*dialect)->is_protected(head);
}

namespace {

/// The dialect decides: it refuses an option or a place that its control does not have.
StartSearch find_start_search(const interpreter::Dialect& dialect) {
  const auto accepts = [&](std::string_view toml) {
    const auto data = interpreter::parse_control_data(toml, dialect.units);
    if (!data) return false;
    interpreter::MemorySource no_text("");
    interpreter::EventSink no_sink;
    return dialect.make(*data, no_text, no_sink).has_value();
  };
  constexpr std::array kPlaces{std::pair{"block", "N1"}, std::pair{"line", "L1"},
                               std::pair{"byte", "B1"}, std::pair{"tool", "T1"},
                               std::pair{"count", "+1"}};
  StartSearch found;
  for (const auto& [name, place] : kPlaces) {
    if (accepts(fmt::format("[control]\nstart_at = \"{}\"\n", place))) found.at.emplace_back(name);
  }
  if (found.at.empty()) return found;
  constexpr std::string_view kStart = "[control]\nstart_at = \"N1\"\n";
  found.has_memory = accepts(fmt::format("{}start_memory = \"now\"\n", kStart));
  found.has_pass = accepts(fmt::format("{}start_pass = 1\n", kStart));
  return found;
}

}  // namespace

const StartSearch& start_search_of(std::string_view control) {
  static const StartSearch kNone;
  static const auto kFound = [] {
    std::map<std::string_view, StartSearch, std::less<>> found;
    for (const auto& dialect : interpreter::dialects())
      found.emplace(dialect.name, find_start_search(dialect));
    return found;
  }();
  const auto at = kFound.find(control);
  return at == kFound.end() ? kNone : at->second;
}

std::string control_words(std::string_view control, Refusal refusal) {
  const auto dialect = interpreter::find_dialect(control);
  if (!dialect || (*dialect)->refusal_words == nullptr) return {};
  return (*dialect)->refusal_words(refusal);
}

Error with_control_words(Error error, std::string_view control, Refusal refusal) {
  const std::string words = control_words(control, refusal);
  if (!words.empty()) error.what += fmt::format(" ({} {})", control, words);
  return error;
}

}  // namespace dripline::library
