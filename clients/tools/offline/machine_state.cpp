#include "clients/tools/offline/machine_state.hpp"

namespace dripline::interpreter {

void MachineState::on_line(const Line& event) {
  position_ = event.to;
  feed_ = event.feed;
}

void MachineState::on_arc(const Arc& event) {
  position_ = event.to;
  feed_ = event.feed;
}

void MachineState::on_tool(const ToolChange& event) {
  if (!event.is_preselection) tool_ = event.number;
}

void MachineState::on_probe(const Probe& event) {
  if (event.result) position_ = event.result->at;
}

}  // namespace dripline::interpreter
