#include "server/ports/programs/broken_program.hpp"

#include <fmt/ranges.h>

#include "gateway/line/line_words.hpp"

namespace dripline::ports {
namespace {

using storage::RunState;
using storage::TransferState;

/// Nothing of it has left. While a server or a gateway is lost only the least is known.
bool is_unsent(const storage::Run& run) {
  const bool is_counted = run.state == RunState::Aborted || run.state == RunState::Alarmed;
  return run.state == RunState::Refused || (is_counted && run.counters.sent == 0);
}

/// The latest of a machine of which something may have left.
Result<std::optional<storage::Run>> last_run(storage::RunStore& store, const std::string& machine) {
  constexpr std::uint64_t kLook = 50;
  const auto runs = store.list({.machine = machine, .program = {}, .state = {}}, {.limit = kLook});
  if (!runs) return fail(runs.error());
  for (const auto& run : *runs)
    if (!is_unsent(run)) return run;
  return std::nullopt;
}

/// The latest of a port of which something may have left.
Result<std::optional<storage::PortTransfer>> last_transfer(storage::PortStore& store,
                                                           const std::string& port) {
  if (port.empty()) return std::nullopt;
  const auto transfers = store.transfers(port);
  if (!transfers) return fail(transfers.error());
  for (const auto& transfer : *transfers) {
    const bool has_begun = transfer.at_most > 0;
    if (transfer.direction == storage::TransferDirection::Send && has_begun) return transfer;
  }
  return std::nullopt;
}

/// With DC1, a heading or an answer to every block the control itself begins each program.
bool sends_at_once(const wire::LineSettings& settings) {
  switch (settings.flow) {
    case wire::Flow::None:
    case wire::Flow::XonXoff:
    case wire::Flow::RtsCts:
      return !settings.wait_for_xon;
    default:
      return false;
  }
}

bool is_sending(const LineView& port) {
  return !port.run.empty() ||
         (port.transfer && port.transfer->state == line::TransferState::Sending);
}

}  // namespace

Result<std::optional<BrokenProgram>> broken_program(const storage::Store& store, const SentTo& to) {
  const auto run = last_run(store.runs, to.machine);
  if (!run) return fail(run.error());
  const auto sent = last_transfer(store.ports, to.port);
  if (!sent) return fail(sent.error());
  if (*sent && (!*run || (*run)->created <= (*sent)->began)) {
    const auto& transfer = **sent;
    const bool is_over = transfer.state == TransferState::Completed ||
                         (transfer.state == TransferState::Aborted && to.are_aborts_told);
    if (is_over) return std::nullopt;
    return BrokenProgram{transfer.id, fmt::format("{}", fmt::join(transfer.programs, ", "))};
  }
  if (!*run) return std::nullopt;
  const RunState state = (*run)->state;
  if (state == RunState::Completed || (state == RunState::Aborted && to.are_aborts_told))
    return std::nullopt;
  return BrokenProgram{(*run)->id,
                       fmt::format("run {} of program {}", (*run)->id, (*run)->program)};
}

bool ResetGate::is_confirmed(const std::string& machine, const std::string& id) const {
  const std::lock_guard lock(mutex_);
  const auto found = confirmed_.find(machine);
  return found != confirmed_.end() && found->second == id;
}

Result<void> ResetGate::check(const LineView& port, const std::string& stored_port) const {
  if (!sends_at_once(port.settings) || is_sending(port)) return {};  // a busy line refuses itself
  const auto broken = broken_program(store_, {.machine = port.names.machine, .port = stored_port});
  if (!broken) return fail(broken.error());
  if (!*broken || is_confirmed(port.names.machine, (*broken)->id)) return {};
  return fail(Errc::Conflict,
              "{} was broken off, and the control of machine '{}' would read the next program as "
              "its rest: reset the control, then confirm that (dnc port confirm-reset {})",
              (*broken)->what, port.names.machine, port.names.name);
}

Result<std::string> ResetGate::confirm(const LineView& port, const std::string& stored_port) {
  const std::string& name = port.names.name;
  if (!sends_at_once(port.settings)) {
    return fail(Errc::Unsupported,
                "port {}: its control asks for each program by itself: no reset is to be confirmed",
                name);
  }
  if (is_sending(port))
    return fail(Errc::Busy, "port {} is busy: it is {}", name, line::what_it_does(port));
  const auto broken = broken_program(store_, {.machine = port.names.machine, .port = stored_port});
  if (!broken) return fail(broken.error());
  if (!*broken) {
    return fail(Errc::Conflict, "port {}: no program was broken off: no reset is to be confirmed",
                name);
  }
  const std::lock_guard lock(mutex_);
  confirmed_[port.names.machine] = (*broken)->id;
  return (*broken)->what;
}

}  // namespace dripline::ports
