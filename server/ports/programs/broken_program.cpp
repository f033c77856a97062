#include "server/ports/programs/broken_program.hpp"

#include <fmt/ranges.h>
#include <algorithm>

#include "gateway/line/line_words.hpp"
#include "gateway/line/port_transfer.hpp"

namespace dripline::ports {
namespace {

using storage::RunState;

/// Nothing of it has left. While a server or a gateway is lost only the least is known.
bool is_unsent(const storage::Run& run) {
  if (run.state == RunState::Refused || run.state == RunState::Tested) return true;
  const bool is_counted = run.state == RunState::Aborted || run.state == RunState::Alarmed;
  const bool has_head_left = run.reason.find(line::kHeadLeft) != std::string::npos;
  return is_counted && run.counters.sent == 0 && !has_head_left;
}

/// The latest of which something may have left; `runs` begin with the newest.
const storage::Run* last_sent(const std::vector<storage::Run>& runs) {
  const auto sent = std::ranges::find_if_not(runs, is_unsent);
  return sent == runs.end() ? nullptr : &*sent;
}

/// The newest runs of the machine, to the latest of which something may have left and further.
Result<std::vector<storage::Run>> runs_to_last_sent(storage::RunStore& store,
                                                    const std::string& machine) {
  constexpr std::uint64_t kLook = 50;
  std::vector<storage::Run> runs;
  for (;;) {
    auto more = store.list({.machine = machine, .program = {}, .state = {}},
                           {.limit = kLook, .offset = runs.size()});
    if (!more) return fail(more.error());
    const bool is_last = more->size() < kLook;
    std::ranges::move(*more, std::back_inserter(runs));
    if (is_last || last_sent(runs) != nullptr) return runs;
  }
}

/// Whether a program without a run passed the line after `run`. By what the store has written down
/// in its order: a clock may be set back.
bool is_later(const storage::PortTransfer& transfer, const storage::Run& run,
              const std::vector<storage::Run>& runs) {
  if (!transfer.after_run) return run.created <= transfer.began;
  if (transfer.after_run->empty()) return false;
  const auto at = std::ranges::find(runs, *transfer.after_run, &storage::Run::id);
  const auto own = std::ranges::find(runs, run.id, &storage::Run::id);
  return at <= own && at != runs.end();
}

/// The port was another machine's then: only the times can be compared.
Result<void> forget_others_run(storage::RunStore& store, const std::string& machine,
                               storage::PortTransfer& transfer) {
  if (!transfer.after_run || transfer.after_run->empty()) return {};
  const auto run = store.find(*transfer.after_run);
  if (!run && run.error().code != Errc::NotFound) return fail(run.error());
  if (!run || run->machine != machine) transfer.after_run.reset();
  return {};
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

/// Of a port of the store, or of a gateway.
template <class Transfer>
BrokenProgram sent_program(const Transfer& transfer) {
  return {.id = transfer.id, .what = fmt::format("{}", fmt::join(transfer.programs, ", "))};
}

bool is_sending(const LineView& port) {
  return !port.run.empty() ||
         (port.transfer && port.transfer->state == line::TransferState::Sending);
}

}  // namespace

Result<std::optional<BrokenProgram>> broken_program(const storage::Store& store, const SentTo& to) {
  const auto runs = runs_to_last_sent(store.runs, to.machine);
  if (!runs) return fail(runs.error());
  const storage::Run* const run = last_sent(*runs);
  auto sent = last_transfer(store.ports, to.port);
  if (!sent) return fail(sent.error());
  if (*sent) {
    auto compared = forget_others_run(store.runs, to.machine, **sent);
    if (!compared) return fail(compared.error());
  }
  if (*sent && (run == nullptr || is_later(**sent, *run, *runs))) {
    const auto& transfer = **sent;
    const bool is_over = transfer.state == storage::TransferState::Completed ||
                         (transfer.state == storage::TransferState::Aborted && to.are_aborts_told);
    if (is_over) return std::nullopt;
    auto broken = sent_program(transfer);
    broken.is_active = transfer.state == storage::TransferState::Active;
    return broken;
  }
  if (run == nullptr) return std::nullopt;
  const RunState state = run->state;
  if (state == RunState::Completed || (state == RunState::Aborted && to.are_aborts_told))
    return std::nullopt;
  return BrokenProgram{.id = run->id,
                       .what = fmt::format("run {} of program {}", run->id, run->program),
                       .is_active = state == RunState::Active || state == RunState::Ordered};
}

Result<std::vector<BrokenProgram>> ResetGate::open_of(const LineView& port,
                                                      const std::string& stored_port) const {
  const std::string& machine = port.names.machine;
  std::vector<BrokenProgram> all;
  auto stored = broken_program(store_, {.machine = machine, .port = stored_port});
  if (!stored) return fail(stored.error());
  if (*stored) all.push_back(**std::move(stored));
  const bool is_of_gateway = stored_port.empty() && port.transfer;
  if (is_of_gateway && port.transfer->at_most > 0 &&
      (port.transfer->state == line::TransferState::Aborted ||
       port.transfer->state == line::TransferState::Interrupted))
    all.push_back(sent_program(*port.transfer));
  const std::lock_guard lock(mutex_);
  if (const auto lost = lost_.find(machine); lost != lost_.end()) all.push_back(lost->second);
  const auto known = confirmed_.find(machine);
  if (known == confirmed_.end()) return all;
  std::erase_if(all, [&](const BrokenProgram& one) { return known->second.contains(one.id); });
  return all;
}

Result<void> ResetGate::check(const LineView& port, const std::string& stored_port) const {
  if (!line::sends_at_once(port.settings) || is_sending(port))
    return {};  // a busy line refuses itself
  const auto open = open_of(port, stored_port);
  if (!open) return fail(open.error());
  if (open->empty()) return {};
  const BrokenProgram& broken = open->front();
  if (broken.is_active) {
    return fail(Errc::Busy,
                "machine '{}': the end of {} is not stored yet: start again in a moment",
                port.names.machine, broken.what);
  }
  return fail(Errc::Conflict,
              "{} was broken off, and the control of machine '{}' would read the next program as "
              "its rest: reset the control, then confirm that (dnc port confirm-reset {})",
              broken.what, port.names.machine, port.names.name);
}

Result<std::string> ResetGate::confirm(const LineView& port, const std::string& stored_port) {
  const std::string& name = port.names.name;
  if (!line::sends_at_once(port.settings)) {
    return fail(Errc::Unsupported,
                "port {}: its control asks for each program by itself: no reset is to be confirmed",
                name);
  }
  if (is_sending(port))
    return fail(Errc::Busy, "port {} is busy: it is {}", name, line::what_it_does(port));
  const auto open = open_of(port, stored_port);
  if (!open) return fail(open.error());
  if (open->empty()) {
    return fail(Errc::Conflict, "port {}: no program was broken off: no reset is to be confirmed",
                name);
  }
  std::vector<std::string> words;
  for (const BrokenProgram& broken : *open) {
    // A run that begins at this moment is none of what was seen at the control.
    if (broken.is_active)
      return fail(Errc::Busy, "port {}: {} has not ended, or its end is not stored yet", name,
                  broken.what);
    words.push_back(broken.what);
  }
  const std::lock_guard lock(mutex_);
  auto& confirmed = confirmed_[port.names.machine];
  lost_.erase(port.names.machine);
  for (const BrokenProgram& broken : *open) confirmed.insert(broken.id);
  return fmt::format("{}", fmt::join(words, "; "));
}

void ResetGate::note_lost(const std::string& machine, BrokenProgram program) {
  const std::lock_guard lock(mutex_);
  lost_[machine] = std::move(program);
}

}  // namespace dripline::ports
