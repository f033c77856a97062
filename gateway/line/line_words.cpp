#include "gateway/line/line_words.hpp"

#include <fmt/ranges.h>

namespace dripline::line {

LineActivity activity_of(const LineView& port, const std::optional<SendProgress>& progress) {
  if (!progress) return LineActivity::Ready;
  if (progress->is_held) return LineActivity::Held;
  const bool waits = !port.is_open || port.waiting_since || port.line.is_stopped;
  return waits ? LineActivity::Waiting : LineActivity::Active;
}

std::string message_of(const LineView& port, const std::optional<SendProgress>& progress) {
  if (!port.is_open) return fmt::format("port {} is not open: {}", port.names.name, port.fault);
  if (progress && progress->is_waiting_for_line) return "waits for its line";
  if (progress && progress->is_held) return "held by the operator";
  if (progress && port.line.awaits_start) {
    return fmt::format("waits for the operator to start it at the control ({})",
                       port.line.waiting_for);
  }
  if (progress && port.line.is_stopped) return "the control holds the line";
  if (progress && port.transfer && progress->id == port.transfer->id) return what_it_does(port);
  if (port.request) return request_words(*port.request);
  if (port.line.is_stopped && !port.line.waiting_for.empty()) return "the control holds the line";
  if (!port.line.waiting_for.empty()) return fmt::format("waits for {}", port.line.waiting_for);
  return port.fault;
}

std::string place_words(std::uint64_t line, std::int64_t sequence, std::string_view done) {
  if (line == 0) return fmt::format("no whole block was {}", done);
  if (sequence < 0) return fmt::format("the last block {} is line {}", done, line);
  return fmt::format("the last block {} is line {}, N{}", done, line, sequence);
}

std::string request_words(const PortRequest& request) {
  return fmt::format("the control asked for {}; {}",
                     request.program.empty() ? "a program" : "program " + request.program,
                     request.answer.empty() ? "no run waits" : "refused: " + request.answer);
}

std::string what_it_does(const LineView& port) {
  if (!port.run.empty()) return "sending run " + port.run;
  if (port.transfer && port.transfer->state == TransferState::Sending) {
    return fmt::format("sending {}", fmt::join(port.transfer->programs, ", "));
  }
  return "receiving";
}

std::vector<std::string> programs_of(const SendJob& job) {
  if (job.kind != JobKind::Answer) return job.programs;
  return {job.name.empty() ? "an answer to the control" : "the answer " + job.name};
}

bool is_cut_off(const SendEnd& end) {
  const bool has_left = end.progress.offered > 0 || end.progress.sent.bytes > 0;
  return has_left && end.outcome != SendOutcome::Completed;
}

}  // namespace dripline::line
