#include "server/paths/impl/interpretation.hpp"

namespace dripline::paths {

Result<interpreter::Setup> interpretation_setup(const machines::RunSources& sources,
                                                const std::string& machine,
                                                const interpreter::Dialect& dialect) {
  if (machine.empty()) return interpreter::Setup{};
  const auto stored = sources.store.setups.find(machine, std::nullopt);
  if (stored) return interpreter::parse_control_data(stored->text, dialect.units);
  if (stored.error().code != Errc::NotFound) return fail(stored.error());
  return interpreter::Setup{};
}

storage::Run interpreted_run(const machines::RunSources& sources, const storage::Revision& revision,
                             const std::string& machine) {
  storage::Run run;
  run.machine = machine;
  run.program = revision.program;
  run.revision = revision.number;
  run.content = revision.content;
  run.size = revision.size;
  run.control = revision.control;
  run.created = sources.clock.now();
  return run;
}

}  // namespace dripline::paths
