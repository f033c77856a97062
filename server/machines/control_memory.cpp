#include "server/machines/control_memory.hpp"

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
  for (const auto& candidate : names) {
    auto revisions = sources.store.programs.revisions(candidate);
    if (!revisions) {
      if (revisions.error().code == Errc::NotFound) continue;
      return fail(revisions.error());
    }
    const storage::Revision* newest = nullptr;
    for (const auto& revision : *revisions) {
      const bool fits = revision.control.empty() || revision.control == run.control;
      if (!fits || !library::Releases::may_call(revision, run)) continue;
      if (newest == nullptr || revision.number > newest->number) newest = &revision;
    }
    if (newest == nullptr) continue;
    if (auto good = sources.releases.check_call(*newest, run); !good) return fail(good.error());
    if (auto good = sources.releases.check_numbering(*newest); !good) return fail(good.error());
    return *newest;
  }
  return fail(Errc::NotFound,
              "program '{}' called by '{}' was not {} for control {} when the run began", name,
              run.program,
              run.allowed_as == storage::RunAllowance::Released ? "released" : "in the library",
              run.control);
}

}  // namespace dripline::machines
