#include "server/machines/control_memory.hpp"

#include <algorithm>

#include "gateway/interpreter/core/called_program_names.hpp"
#include "gateway/interpreter/registry.hpp"
#include "protocol/base/names.hpp"
#include "server/machines/stored_programs.hpp"

namespace dripline::machines {

Result<void> check_control_memory(const RunSources& sources, const storage::Run& run) {
  const auto dialect = interpreter::find_dialect(run.control);
  if (!dialect || (*dialect)->check_memory == nullptr) return {};
  const auto stored = sources.store.setups.find(run.machine, std::nullopt);
  if (!stored) return {};  // its gateway has its own setup
  const auto setup = interpreter::parse_control_data(stored->text, (*dialect)->units);
  if (!setup) return fail(setup.error());
  StoredPrograms source(sources, run);
  const auto verdict = (*dialect)->check_memory(*setup, source);
  if (!verdict) return fail(verdict.error());
  if (!verdict->is_binding || verdict->refused.empty()) return {};
  const auto& refused = verdict->refused.front();
  return fail(Errc::LimitExceeded, "machine '{}' cannot keep program '{}': line {}: {}",
              run.machine, run.program, refused.line, refused.text);
}

namespace {

Result<void> check_given(const RunSources& sources, const storage::Run& run,
                         const storage::Revision& revision) {
  if (auto good = sources.releases.check_call(revision, run); !good) return good;
  return sources.releases.check_numbering(revision);
}

/// A run keeps what its machine has got text of.
Result<storage::Revision> kept_revision(const RunSources& sources, const storage::Run& run,
                                        const storage::RunCall& call) {
  auto revision = sources.store.programs.revision(call.program, call.revision);
  if (!revision) return revision;
  if (revision->content != call.content) {
    return fail(Errc::Corrupt,
                "run {} called program {} revision {}, whose content is another one now: the "
                "database was changed",
                run.id, call.program, call.revision);
  }
  if (auto good = check_given(sources, run, *revision); !good) return fail(good.error());
  return revision;
}

/// The newest that is in force for the run's control; absent: none is.
Result<std::optional<storage::Revision>> newest_callable(const RunSources& sources,
                                                         const storage::Run& run,
                                                         const std::string& program) {
  std::optional<storage::Revision> newest;
  auto revisions = sources.store.programs.revisions(program);
  if (!revisions && revisions.error().code == Errc::NotFound) return newest;
  if (!revisions) return fail(revisions.error());
  for (auto& revision : *revisions) {
    const bool fits = revision.control.empty() || revision.control == run.control;
    if (!fits || !library::Releases::may_call(revision, run)) continue;
    if (!newest || revision.number > newest->number) newest = std::move(revision);
  }
  if (!newest) return newest;
  if (auto good = check_given(sources, run, *newest); !good) return fail(good.error());
  return newest;
}

}  // namespace

Result<storage::Revision> resolve_called_program(const RunSources& sources, const storage::Run& run,
                                                 const std::string& name) {
  if (auto good = check_program_name(name); !good)
    return fail(Errc::NotFound, "{}", good.error().what);
  const auto names = interpreter::called_program_names(name);
  auto pinned = sources.releases.pinned_call(run, names);
  if (!pinned) return fail(pinned.error());
  if (*pinned) {
    if (auto good = sources.releases.check_numbering(**pinned); !good) return fail(good.error());
    return std::move(**pinned);
  }
  Result<std::vector<storage::RunCall>> calls = std::vector<storage::RunCall>{};
  if (run.number != 0) calls = sources.store.runs.calls(run.id);  // otherwise it is not stored
  if (!calls) return fail(calls.error());
  const auto same = std::ranges::find(*calls, name, &storage::RunCall::name);
  if (same != calls->end()) return kept_revision(sources, run, *same);
  for (const auto& candidate : names) {
    const auto known = std::ranges::find(*calls, candidate, &storage::RunCall::program);
    if (known != calls->end()) return kept_revision(sources, run, *known);
    auto newest = newest_callable(sources, run, candidate);
    if (!newest) return fail(newest.error());
    if (*newest) return std::move(**newest);
  }
  return fail(Errc::NotFound,
              "program '{}' called by '{}' was not {} for control {} when the run began", name,
              run.program,
              run.allowed_as == storage::RunAllowance::Released ? "released" : "in the library",
              run.control);
}

}  // namespace dripline::machines
