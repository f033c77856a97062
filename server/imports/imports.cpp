#include "server/imports/imports.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "protocol/process/log.hpp"
#include "server/imports/judgment.hpp"

namespace dripline::imports {
namespace {

using nlohmann::json;
using storage::ImportState;

constexpr const char* kPolicy = "release policy";  ///< no user has a blank in his name
constexpr std::uint64_t kAtOnce = 16;              ///< asked of the store at a time

/// Not the program's fault: another time it may go well.
bool is_passing(const Error& error) {
  return error.code == Errc::Busy || error.code == Errc::Io;
}

}  // namespace

Imports::~Imports() {
  worker_.request_stop();
}

void Imports::begin() {
  worker_ = std::jthread([this](const std::stop_token& stop) { work(stop); });
}

void Imports::note(const storage::Revision& revision) {
  publish(revision.program, revision.number);
  {
    const std::lock_guard lock(mutex_);
    is_woken_ = true;
  }
  changed_.notify_one();
}

void Imports::publish(const std::string& program, std::uint64_t revision) {
  if (!parts_.on_change) return;
  if (const auto import = parts_.store.imports.find(program, revision); import)
    parts_.on_change(*import);
}

/// The released revision, else the newest in force. What is pending may be the newest of all.
Result<std::optional<storage::Revision>> Imports::base_of(const std::string& program,
                                                          std::uint64_t number) {
  const auto all = parts_.store.programs.revisions(program);
  if (!all) return fail(all.error());
  const auto in_force = [&](const storage::Revision& revision) {
    return !revision.is_held && revision.number != number;
  };
  auto found = std::ranges::find_if(*all, [&](const auto& revision) {
    return in_force(revision) && revision.state == storage::RevisionState::Released;
  });
  if (found == all->end()) found = std::ranges::find_if(*all, in_force);
  if (found == all->end()) return std::optional<storage::Revision>();
  auto checked = parts_.store.programs.revision(program, found->number);  // its content too
  if (!checked) return fail(checked.error());
  return std::optional(*std::move(checked));
}

Result<std::string> Imports::compare(const storage::Import& import, const storage::Revision& base,
                                     paths::CompareBy by, const std::stop_token& stop) {
  return parts_.paths.compare({.first = base,
                               .second = import.revision,
                               .by = by,
                               .machine = import.machine,
                               .stop = stop});
}

Result<ComparedImport> Imports::show(const std::string& program, std::uint64_t revision) {
  auto import = parts_.store.imports.find(program, revision);
  if (!import) return fail(import.error());
  ComparedImport shown{.import = *std::move(import), .base = {}, .comparison = {}, .fault = {}};
  const bool is_pending = shown.import.state == ImportState::Pending;
  if (is_pending) {
    auto base = base_of(program, revision);
    if (!base) return fail(base.error());
    shown.base = *std::move(base);
  } else if (shown.import.compared && shown.import.compared->base) {
    if (auto base = parts_.store.programs.revision(program, *shown.import.compared->base); base)
      shown.base = *std::move(base);
  }
  if (!shown.base) {
    shown.fault = "there is no revision to compare it with";
    return shown;
  }
  auto text = compare(shown.import, *shown.base, paths::CompareBy::Motion, {});
  shown.by_motion = text.has_value();
  if (!text) {
    shown.fault = text.error().what;
    text = compare(shown.import, *shown.base, paths::CompareBy::Text, {});
  }
  if (text) shown.comparison = *std::move(text);
  return shown;
}

Result<storage::Revision> Imports::decide(storage::ImportDecision decision) {
  if (decision.reason.size() > kMaxReason) {
    return fail(Errc::LimitExceeded, "reason of {} bytes: at most {}", decision.reason.size(),
                kMaxReason);
  }
  const bool has_words = decision.reason.find_first_not_of(" \t\r\n") != std::string::npos;
  if (decision.state == ImportState::Rejected && !has_words)
    return fail(Errc::Syntax, "a rejection needs a reason");
  decision.time = parts_.clock.now();
  auto decided = parts_.store.imports.decide(decision);
  if (!decided) return decided;
  process::log_info("import program={} revision={} {} by={}", decision.program, decision.revision,
                    storage::to_string(decision.state), decision.who.name);
  publish(decision.program, decision.revision);
  return decided;
}

void Imports::work(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    {
      std::unique_lock lock(mutex_);
      changed_.wait_for(lock, stop, parts_.retry, [this] { return is_woken_; });
      is_woken_ = false;
    }
    for (;;) {
      const auto waiting = parts_.store.imports.uncompared(kAtOnce);
      if (!waiting || waiting->empty() || stop.stop_requested()) break;
      const auto done = std::ranges::count_if(*waiting, [&](const auto& import) {
        return !stop.stop_requested() && look_at(import, stop);
      });
      if (done == 0) break;
    }
  }
}

bool Imports::look_at(const storage::Import& import, const std::stop_token& stop) {
  const auto base = base_of(import.revision.program, import.revision.number);
  if (!base && is_passing(base.error())) return false;
  storage::ImportClass found{.base = {}, .edit = {}, .fault = {}, .time = parts_.clock.now()};
  if (!base || !*base) {
    found.fault = base ? "there is no revision to compare it with" : base.error().what;
    return keep(import, std::move(found));
  }
  const auto text = compare(import, **base, paths::CompareBy::Motion, stop);
  if (stop.stop_requested()) return false;
  if (text) return judge(import, **base, *text);
  if (is_passing(text.error())) return false;
  found.base = (*base)->number;
  found.fault = text.error().what;
  return keep(import, std::move(found));
}

bool Imports::judge(const storage::Import& import, const storage::Revision& base,
                    const std::string& text) {
  const std::string& program = import.revision.program;
  const auto newest = parts_.store.programs.revision(program, std::nullopt);
  const auto setup = parts_.store.setups.find(import.machine, std::nullopt);
  if (!newest && is_passing(newest.error())) return false;
  const json comparison = json::parse(text, nullptr, false);
  const bool is_sound = comparison.is_object() && newest;
  std::optional<std::string> wait = "it could not be compared";
  if (is_sound) {
    wait = reason_to_wait(parts_.policy, {.revision = import.revision,
                                          .base = base,
                                          .newest = newest->number,
                                          .comparison = comparison,
                                          .has_setup = setup.has_value()});
  }
  storage::ImportClass found{.base = base.number,
                             .edit = is_sound ? comparison.value("class", "") : "",
                             .fault = {},
                             .time = parts_.clock.now()};
  if (!wait) {
    const auto accepted =
        decide({.program = program,
                .revision = import.revision.number,
                .who = kPolicy,
                .reason = fmt::format("policy sha256 {}", parts_.policy.digest.hex()),
                .at_once = found});
    if (accepted) return true;
    if (is_passing(accepted.error())) return false;
    wait = fmt::format("it was not accepted at once: {}", accepted.error().what);
  }
  // Without such a policy everything waits; that is no finding.
  if (!parts_.policy.accept_at_once.empty() || !is_sound) found.fault = *wait;
  return keep(import, std::move(found));
}

bool Imports::keep(const storage::Import& import, storage::ImportClass found) {
  const std::string& program = import.revision.program;
  const std::uint64_t number = import.revision.number;
  const auto kept = parts_.store.imports.set_class(program, number, found);
  if (!kept) return !is_passing(kept.error());
  process::log_info("import machine={} program={} revision={} class={} {}", import.machine, program,
                    number, found.edit.empty() ? "unknown" : found.edit, found.fault);
  publish(program, number);
  return true;
}

}  // namespace dripline::imports
