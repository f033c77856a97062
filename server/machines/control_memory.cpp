#include "server/machines/control_memory.hpp"

#include "gateway/interpreter/core/called_program_names.hpp"
#include "gateway/interpreter/registry.hpp"
#include "protocol/base/names.hpp"
#include "server/machines/stored_programs.hpp"

namespace dripline::machines {

Result<void> check_control_memory(const storage::Store& store, const storage::Run& run) {
  const auto dialect = interpreter::find_dialect(run.control);
  if (!dialect || (*dialect)->check_memory == nullptr) return {};
  const auto stored = store.setups.find(run.machine, std::nullopt);
  if (!stored) return {};  // its gateway has its own setup
  const auto setup = interpreter::parse_control_data(stored->text, (*dialect)->units);
  if (!setup) return fail(setup.error());
  StoredPrograms source(store, run);
  const auto verdict = (*dialect)->check_memory(*setup, source);
  if (!verdict) return fail(verdict.error());
  if (!verdict->is_binding || verdict->refused.empty()) return {};
  const auto& refused = verdict->refused.front();
  return fail(Errc::LimitExceeded, "machine '{}' cannot keep program '{}': line {}: {}",
              run.machine, run.program, refused.line, refused.text);
}

Result<storage::Revision> resolve_called_program(storage::ProgramStore& store,
                                                 const storage::Run& run, const std::string& name) {
  if (auto good = check_program_name(name); !good)
    return fail(Errc::NotFound, "{}", good.error().what);
  for (const auto& candidate : interpreter::called_program_names(name)) {
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

}  // namespace dripline::machines
