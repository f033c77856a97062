#include "server/ports/control_protocol.hpp"

#include "gateway/interpreter/core/setup.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/control_version.hpp"

namespace dripline::ports {

namespace tnc155 = interpreter::tnc155;

Result<void> check_protocol(storage::SetupStore& store, const std::string& machine,
                            wire::Flow flow) {
  if (flow != wire::Flow::HeidenhainBcc) return {};
  const auto stored = store.find(machine, std::nullopt);
  if (!stored) return {};
  const auto setup = interpreter::parse_control_data(stored->text);
  // Options of another control are no question here.
  const auto version = setup ? tnc155::version_of(setup->control)
                             : Result<tnc155::ControlVersion>(fail(setup.error()));
  if (!version || version->has(tnc155::Feature::BlockwiseTransfer)) return {};
  return fail(Errc::Unsupported,
              "machine '{}', setup {}: {}; flow heidenhain (template tnc155) is its interface",
              machine, stored->number, version->lacks(tnc155::Feature::BlockwiseTransfer));
}

}  // namespace dripline::ports
