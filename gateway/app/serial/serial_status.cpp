#include "gateway/app/serial/serial_status.hpp"

#include <algorithm>

#include "gateway/app/run/run_texts.hpp"
#include "gateway/line/heads/head_scan.hpp"
#include "gateway/line/line_words.hpp"

namespace dripline::gateway {
namespace {

using dds::Execution;

/// "45 s", "10 min 3 s".
std::string duration_words(double seconds) {
  constexpr std::uint64_t kMinute = 60;
  const auto whole = static_cast<std::uint64_t>(seconds);
  if (whole < 2 * kMinute) return fmt::format("{} s", whole);
  return fmt::format("{} min {} s", whole / kMinute, whole % kMinute);
}

/// How long the line does without the network, known before that is needed.
std::string buffer_text(const SerialState& state) {
  const std::string buffer = fmt::format("{} bytes, {} of the line", state.buffered_bytes,
                                         duration_words(state.buffered_seconds));
  if (state.has_all_text) return "the rest of the program is buffered: " + buffer;
  return fmt::format("buffered: {}{}", buffer, state.server.is_connected() ? "" : "; no server");
}

Execution execution_of(const SerialState& state) {
  if (state.is_emergency_stopped) return Execution::Stopped;
  if (!state.run.is_active() || state.run.is_ending()) return state.run.last_execution();
  if (state.run.is_held_before_line()) return Execution::FeedHold;
  if (!state.run.is_on_line()) return Execution::Waiting;
  switch (line::activity_of(state.view, state.progress)) {
    case line::LineActivity::Held:
      return Execution::FeedHold;
    case line::LineActivity::Waiting:
      return Execution::Waiting;
    default:
      break;
  }
  return state.is_starved() || state.view.line.awaits_start ? Execution::Waiting
                                                            : Execution::Active;
}

std::string message_of(const SerialState& state) {
  if (state.is_emergency_stopped) return "EMERGENCY STOP";
  if (!state.records.fault().empty()) return "reports cannot be kept: " + state.records.fault();
  if (!state.server.refused().empty())
    return "the server does not command this gateway: " + state.server.refused();
  if (!state.run.is_active()) {
    if (!state.run.last_message().empty()) return state.run.last_message();
    return line::message_of(state.view, state.progress);
  }
  if (state.run.is_looking()) {
    return fmt::format("{}looking through the program for where it begins, byte {}{}",
                       state.run.is_held_before_line() ? "held; " : "", state.run.looked_at(),
                       state.server.is_connected() ? "" : ": no server");
  }
  std::string words = state.consent.is_awaited() ? std::string(kAwaitsCycleStart)
                                                 : line::message_of(state.view, state.progress);
  if (!words.empty()) words += "; ";
  if (const std::string head = state.run.head(); !head.empty())
    words += fmt::format("sent first: {}; ", line::head_in_one_line(head));
  return words + buffer_text(state);
}

dds::WaitsFor waits_for(const SerialState& state, Execution execution) {
  if (!state.records.fault().empty()) return dds::WaitsFor::Disk;
  if (!state.run.is_active() || state.is_emergency_stopped) return dds::WaitsFor::Nothing;
  if (state.consent.is_awaited() || execution == Execution::FeedHold ||
      state.view.line.awaits_start)
    return dds::WaitsFor::CycleStart;
  return state.is_starved() ? dds::WaitsFor::Text : dds::WaitsFor::Nothing;
}

static_assert(static_cast<int>(dds::LinePhase::Requesting) ==
              static_cast<int>(wire::Phase::Requesting));
static_assert(static_cast<int>(dds::LineTransferState::Interrupted) ==
              static_cast<int>(line::TransferState::Interrupted));

/// As many of the names as fit.
std::string names_text(const std::vector<std::string>& programs) {
  constexpr std::size_t kMaxNames = 1024, kMaxRest = 32;
  std::string text;
  std::size_t shown = 0;
  for (const std::string& name : programs) {
    if (text.size() + name.size() + kMaxRest > kMaxNames) break;
    text += (text.empty() ? "" : "\n") + name;
    ++shown;
  }
  if (shown < programs.size()) text += fmt::format("\nand {} more", programs.size() - shown);
  return text;
}

dds::LineTransfer transfer_of(const line::PortTransfer& transfer) {
  return {.id = transfer.id,
          .programs = names_text(transfer.programs),
          .size = transfer.size,
          .sent = transfer.sent,
          .state = static_cast<dds::LineTransferState>(transfer.state),
          .reason = transfer.reason};
}

dds::LineAsked asked_of(const line::PortRequest& request) {
  constexpr std::size_t kMaxProgram = 128;
  return {.since = request.since,
          .program = valid_text(request.program, kMaxProgram),
          .answer = request.answer};
}

/// What is changed of the template, as the options have it.
std::string settings_text(std::string changes) {
  std::ranges::replace(changes, ',', '\n');
  return changes;
}

dds::LineStatus line_status(const SerialState& state) {
  const line::LineView& view = state.view;
  dds::LineStatus status;
  status.address = state.options.line->address;
  status.line_template = state.options.line->template_name;
  status.settings = settings_text(state.options.line->changes);
  status.is_open = view.is_open;
  status.fault = view.fault;
  status.phase = static_cast<dds::LinePhase>(view.line.phase);
  status.is_stopped = view.line.is_stopped;
  status.is_stopping = view.line.is_stopping;
  status.waits_without_limit = view.line.may_wait_without_limit;
  status.waiting_for = view.line.waiting_for;
  status.characters_sent = view.sent;
  status.characters_received = view.received;
  status.buffered_bytes = state.buffered_bytes;
  status.call = state.calls.call();
  if (view.transfer) status.transfer = transfer_of(*view.transfer);
  if (view.request) status.asked = asked_of(*view.request);
  status.waiting_since = view.waiting_since;
  status.recorded = state.recorded;
  if (state.uploads.waiting().empty()) return status;
  const Upload& upload = state.uploads.waiting().front();
  status.upload =
      dds::LineUpload{upload.id, upload.name, upload.size, upload.content, upload.damage};
  return status;
}

}  // namespace

dds::Status make_status(const SerialState& state) {
  dds::Status status;
  status.machine = state.options.machine;
  status.session = state.session;
  status.time = state.clock.now();
  status.steady = std::chrono::duration_cast<std::chrono::microseconds>(
      state.clock.steady_now().time_since_epoch());
  status.outbox = static_cast<std::uint32_t>(
      std::min<std::uint64_t>(state.outbox.unacknowledged(), UINT32_MAX));
  if (state.run.is_active()) {
    const report::ActiveRun& run = state.run.run();
    const report::Progress progress = LineJournal::progress_of(state.run.progress());
    status.run = run.run;
    status.program = run.program;
    status.total_bytes = run.size;
    status.sent = progress.sent;
    status.accepted = progress.accepted;
    status.offset = progress.sent;
    status.line = progress.line;
    status.sequence = progress.sequence;
    status.buffered_seconds = state.buffered_seconds;
  }
  status.emergency_stop = state.is_emergency_stopped;
  status.execution = execution_of(state);
  status.message = valid_text(message_of(state), kMaxReason);
  status.remote_enable = state.consent.is_unattended() ? dds::RemoteEnable::Unattended
                         : state.consent.is_given()    ? dds::RemoteEnable::Given
                                                       : dds::RemoteEnable::NotGiven;
  status.waits_for = waits_for(state, status.execution);
  status.serial_line = line_status(state);
  return status;
}

}  // namespace dripline::gateway
