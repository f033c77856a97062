#include "server/library/release_policy.hpp"

#include <fmt/ranges.h>
#include <toml++/toml.h>
#include <algorithm>
#include <fstream>
#include <sstream>

#include "protocol/base/names.hpp"
#include "protocol/process/log.hpp"

namespace dripline::library {
namespace {

using storage::RevisionState;
using storage::RevisionStep;
using storage::Role;

/// What a policy may choose from; `usual` without a word of it.
struct StepBounds {
  RevisionStep step;
  Role lowest;  ///< as the API asks (server/api/route_permissions.cpp)
  std::set<RevisionState> usual, possible;
};

const std::array<StepBounds, storage::kRevisionSteps>& step_bounds() {
  using enum RevisionState;
  static const std::array<StepBounds, storage::kRevisionSteps> kBounds{{
      {RevisionStep::Submit, Role::Programmer, {Draft}, {Draft}},
      {RevisionStep::Approve, Role::Approver, {InReview}, {Draft, InReview}},
      {RevisionStep::Reject, Role::Approver, {InReview, Approved}, {InReview, Approved}},
      {RevisionStep::Release, Role::Approver, {Approved}, {Draft, InReview, Approved}},
      {RevisionStep::Withdraw,
       Role::Approver,
       {Draft, InReview, Approved, Released},
       {Draft, InReview, Approved, Released}},
  }};
  return kBounds;
}

tl::unexpected<Error> wrong(const toml::node& node, std::string_view key, std::string_view needed) {
  return fail(Errc::Syntax, "line {}: {} must be {}", node.source().begin.line, key, needed);
}

Result<void> read_flag(const toml::node& node, std::string_view key, bool& flag) {
  if (!node.is_boolean()) return wrong(node, key, "true or false");
  flag = node.as_boolean()->get();
  return {};
}

Result<std::set<std::string>> read_words(const toml::node& node, std::string_view key) {
  const auto* const list = node.as_array();
  if (list == nullptr) return wrong(node, key, "a list of strings");
  std::set<std::string> words;
  for (const auto& element : *list) {
    if (!element.is_string()) return wrong(element, key, "a list of strings");
    words.insert(element.as_string()->get());
  }
  return words;
}

Result<Role> read_role(const toml::node& node, std::string_view key, Role lowest) {
  if (!node.is_string()) return wrong(node, key, "a role");
  const auto role = storage::parse_role(node.as_string()->get());
  if (!role)
    return fail(role.error().code, "line {}: {}: {}", node.source().begin.line, key,
                role.error().what);
  if (*role >= lowest) return *role;
  return wrong(node, key, fmt::format("at least {}", storage::to_string(lowest)));
}

Result<std::set<RevisionState>> read_states(const toml::node& node, const StepBounds& bounds) {
  const auto words = read_words(node, "from");
  if (!words) return fail(words.error());
  std::set<RevisionState> states;
  for (const auto& word : *words) {
    const auto state = storage::parse_revision_state(word);
    if (!state) return wrong(node, "from", state.error().what);
    if (!bounds.possible.contains(*state)) {
      return fail(Errc::Syntax, "line {}: from: {} is no step from {}", node.source().begin.line,
                  storage::to_string(bounds.step), word);
    }
    states.insert(*state);
  }
  return states;
}

Result<void> read_rule(const toml::node& node, const StepBounds& bounds, StepRule& rule) {
  const auto* const table = node.as_table();
  if (table == nullptr) return wrong(node, storage::to_string(bounds.step), "a table");
  for (const auto& [key, value] : *table) {
    Result<void> read;
    if (key.str() == "from") {
      auto states = read_states(value, bounds);
      if (!states) return fail(states.error());
      rule.from = *std::move(states);
    } else if (key.str() == "role") {
      const auto role = read_role(value, "role", bounds.lowest);
      if (!role) return fail(role.error());
      rule.role = *role;
    } else if (key.str() == "four_eyes") {
      read = read_flag(value, key.str(), rule.needs_four_eyes);
    } else if (key.str() == "comment") {
      read = read_flag(value, key.str(), rule.needs_comment);
    } else {
      read = wrong(value, key.str(), "one of from, role, four_eyes and comment");
    }
    if (!read) return read;
  }
  return {};
}

Result<void> read_prove_out(const toml::node& node, ReleasePolicy& policy) {
  const auto* const table = node.as_table();
  if (table == nullptr) return wrong(node, "prove_out", "a table");
  for (const auto& [key, value] : *table) {
    if (key.str() == "machines") {
      auto machines = read_words(value, key.str());
      if (!machines) return fail(machines.error());
      for (const auto& machine : *machines) {
        if (auto good = check_machine_name(machine); !good) return fail(good.error());
      }
      policy.prove_out_machines = *std::move(machines);
    } else if (key.str() == "role") {
      const auto role = read_role(value, key.str(), Role::Operator);
      if (!role) return fail(role.error());
      policy.prove_out_role = *role;
    } else {
      return wrong(value, key.str(), "one of machines and role");
    }
  }
  return {};
}

Result<void> read_imports(const toml::node& node, ReleasePolicy& policy) {
  const auto* const table = node.as_table();
  if (table == nullptr) return wrong(node, "imports", "a table");
  for (const auto& [key, value] : *table) {
    if (key.str() != "accept_at_once") return wrong(value, key.str(), "accept_at_once");
    auto classes = read_words(value, key.str());
    if (!classes) return fail(classes.error());
    for (const auto& word : *classes) {
      if (std::ranges::find(kAtOnceClasses, word) != kAtOnceClasses.end()) continue;
      return wrong(value, fmt::format("accept_at_once: '{}'", word),
                   fmt::format("one of {}", fmt::join(kAtOnceClasses, ", ")));
    }
    policy.accept_at_once = *std::move(classes);
  }
  return {};
}

Result<void> read_runs(const toml::node& node, ReleasePolicy& policy) {
  const std::string word = node.value_or(std::string());
  if (word != "open" && word != "release") return wrong(node, "runs", "open or release");
  policy.runs_released_only = word == "release";
  return {};
}

Result<void> read_key(std::string_view key, const toml::node& value, ReleasePolicy& policy) {
  if (key == "runs") return read_runs(value, policy);
  if (key == "prove_out") return read_prove_out(value, policy);
  if (key == "imports") return read_imports(value, policy);
  const auto bounds = std::ranges::find_if(
      step_bounds(), [&](const auto& row) { return storage::to_string(row.step) == key; });
  if (bounds == step_bounds().end())
    return wrong(value, key,
                 "one of runs, prove_out, imports, submit, approve, reject, release, withdraw");
  return read_rule(value, *bounds, policy.rules.at(static_cast<std::size_t>(bounds->step)));
}

}  // namespace

Result<ReleasePolicy> ReleasePolicy::parse(std::string_view text) {
  ReleasePolicy policy;
  policy.digest = sha256(text);
  for (const auto& bounds : step_bounds()) {
    StepRule& rule = policy.rules.at(static_cast<std::size_t>(bounds.step));
    rule.from = bounds.usual;
    rule.role = bounds.lowest;
  }
  toml::table table;
  try {
    table = toml::parse(text);
  } catch (const toml::parse_error& e) {
    return fail(Errc::Syntax, "line {}: {}", e.source().begin.line, e.description());
  }
  for (const auto& [key, value] : table) {
    if (auto read = read_key(key.str(), value, policy); !read) return fail(read.error());
  }
  return policy;
}

Result<ReleasePolicy> ReleasePolicy::read(const std::string& name) {
  if (name.empty()) return parse("");
  std::ifstream file(name, std::ios::binary);
  std::ostringstream text;
  if (!file || !(text << file.rdbuf()))
    return fail(Errc::NotFound, "policy: file '{}' cannot be read", name);
  auto policy = parse(text.str());
  if (!policy) return fail(Errc::Denied, "policy {}: {}", name, policy.error().what);
  process::log_info("policy {}: machines run {} revisions", name,
                    policy->runs_released_only ? "released" : "all");
  return policy;
}

}  // namespace dripline::library
