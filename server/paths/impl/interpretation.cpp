#include "server/paths/impl/interpretation.hpp"

#include <nlohmann/json.hpp>

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

nlohmann::json extents_json(const interpreter::Summary& summary) {
  auto extents = nlohmann::json::object();
  for (const auto axis : interpreter::kAllAxes) {
    const auto& extent = summary.extents[static_cast<std::size_t>(axis)];
    if (extent) extents[std::string(1, letter(axis))] = {extent->least, extent->most};
  }
  return extents;
}

}  // namespace dripline::paths
