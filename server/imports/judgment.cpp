#include "server/imports/judgment.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "server/library/programs.hpp"

namespace dripline::imports {
namespace {

using nlohmann::json;

/// What the interpretation could not pass; null: nothing.
const json* obstacle(const json& comparison) {
  for (const auto& condition : comparison.at("motion").at("conditions")) {
    const std::string kind = condition.at("kind");
    if (kind == "alarm" || kind == "fault") return &condition;
  }
  return nullptr;
}

}  // namespace

std::optional<std::string> reason_to_wait(const library::ReleasePolicy& policy,
                                          const Evidence& evidence) {
  const std::string edit = evidence.comparison.value("class", "other");
  if (!policy.accept_at_once.contains(edit))
    return fmt::format("the policy leaves edits of class {} to a person", edit);
  if (evidence.revision.comment.find(library::Programs::kDamageMark) != std::string::npos)
    return "it came over a line with faults";
  if (evidence.base.state == storage::RevisionState::Withdrawn)
    return fmt::format("revision {} was withdrawn", evidence.base.number);
  if (evidence.base.number != evidence.newest) {
    return fmt::format("revision {} is newer than revision {}, with which it was compared",
                       evidence.newest, evidence.base.number);
  }
  if (!evidence.comparison.contains("motion")) return "it was not compared by motion";
  if (const json* met = obstacle(evidence.comparison)) {
    return fmt::format("the comparison met an {} at line {}: {}", met->value("kind", ""),
                       met->value("line", std::uint64_t{0}), met->value("text", ""));
  }
  if (!evidence.has_setup && edit != "comment")
    return "the machine has no setup with which motion can be compared";
  return std::nullopt;
}

}  // namespace dripline::imports
