#include "server/machines/called_programs.hpp"

#include "gateway/interpreter/core/called_program_names.hpp"
#include "protocol/base/names.hpp"

namespace dripline::machines {

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
