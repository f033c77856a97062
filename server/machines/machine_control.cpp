#include "server/machines/machine_control.hpp"

#include <algorithm>

namespace dripline::machines {

std::vector<MachineView> MachineControl::machines_after(const MachinePage& page) const {
  auto views = machines();
  std::erase_if(views, [&](const MachineView& view) { return view.machine.name <= page.after; });
  std::ranges::sort(views, {}, [](const MachineView& view) { return view.machine.name; });
  if (views.size() > page.limit) views.resize(page.limit);
  return views;
}

Result<void> MachineControl::remove(const std::string& machine, const storage::Actor&) {
  return fail(Errc::Unsupported, "machine '{}' cannot be removed", machine);
}

Result<std::string> MachineControl::confirm_gateway(const std::string& machine) {
  return fail(Errc::Conflict, "machine '{}': no gateway waits to be confirmed", machine);
}

}  // namespace dripline::machines
