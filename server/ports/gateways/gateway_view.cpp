#include "server/ports/gateways/gateway_view.hpp"

#include <algorithm>
#include <array>
#include <sstream>

#include "server/ports/port_settings.hpp"

namespace dripline::ports {
namespace {

static_assert(static_cast<int>(dds::LineTransferState::Interrupted) ==
              static_cast<int>(TransferState::Interrupted));

/// The words of the disciplines (LineState::waiting_for), which live as long as the program.
std::string_view waiting_word(std::string_view text) {
  constexpr std::array<std::string_view, 11> kWords{
      "DC1", "CTS", "text", "EOT", "NAK", "ACK", "block", "run", "tape", "end of block", "heading"};
  const auto known = std::ranges::find(kWords, text);
  if (known != kWords.end()) return *known;
  return text.empty() ? std::string_view() : std::string_view("the control");
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream all(text);
  for (std::string line; std::getline(all, line);) lines.push_back(line);
  return lines;
}

PortTransfer transfer_of(const dds::LineTransfer& transfer) {
  return {.id = transfer.id,
          .programs = lines_of(transfer.programs),
          .size = transfer.size,
          .sent = transfer.sent,
          // A gateway reports what has passed for certain.
          .at_most =
              transfer.state == dds::LineTransferState::Completed ? transfer.sent : transfer.size,
          .state = static_cast<TransferState>(transfer.state),
          .reason = transfer.reason};
}

void set_port(storage::Port& port, const std::string& machine, const dds::LineStatus& line) {
  port.name = port.machine = machine;
  port.address = line.address;
  port.line_template = line.line_template;
  for (const std::string& word : lines_of(line.settings)) {
    if (word.empty()) continue;
    const auto equals = word.find('=');
    if (equals == std::string::npos) {
      port.settings.emplace_back("line", word);
    } else {
      port.settings.emplace_back(word.substr(0, equals), word.substr(equals + 1));
    }
  }
}

}  // namespace

PortView view_of(const machines::MachineView& machine, const dds::LineStatus& line) {
  PortView view;
  view.names = {machine.machine.name, machine.machine.name, line.address};
  set_port(view.port, machine.machine.name, line);
  if (auto known = effective_settings(view.port)) view.settings = *std::move(known);
  view.is_open = machine.is_connected && line.is_open;
  view.fault = machine.is_connected ? line.fault : "its gateway is not connected";
  view.line.phase = static_cast<wire::Phase>(line.phase);
  view.line.is_stopped = line.is_stopped;
  view.line.is_stopping = line.is_stopping;
  view.line.waiting_for = waiting_word(line.waiting_for);
  view.line.may_wait_without_limit = line.waits_without_limit;
  view.sent = line.characters_sent;
  view.received = line.characters_received;
  view.waiting_since = line.waiting_since;
  if (line.transfer) view.transfer = transfer_of(*line.transfer);
  if (line.asked) {
    view.request = PortRequest{
        .since = line.asked->since, .program = line.asked->program, .answer = line.asked->answer};
  }
  if (machine.status) view.run = machine.status->run;
  return view;
}

}  // namespace dripline::ports
