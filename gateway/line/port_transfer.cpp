#include "gateway/line/port_transfer.hpp"

#include <utility>

#include "gateway/line/line_words.hpp"

namespace dripline::line {

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

Result<void> check_ready(PortLine& line) {
  const LineView port = line.view();
  if (!port.is_open) {
    return fail(Errc::Timeout, "port {} is not open: {}", port.names.name,
                port.fault.empty() ? "not yet" : port.fault);
  }
  if (auto free = line.drop_answer(); !free) return free;
  if (!line.is_busy()) return {};
  return fail(Errc::Busy, "port {} is busy: it is {}", port.names.name, what_it_does(port));
}

void send_programs(PortLine& line, SendJob job, const PortLine::Answer& answer) {
  if (auto ready = check_ready(line); !ready) return answer(ready);
  line.begin(std::move(job), answer);
}

void receive_program(PortLine& line, const PortLine::Answer& answer) {
  const LineView port = line.view();
  if (port.settings.flow != wire::Flow::Xmodem) {
    return answer(fail(Errc::Unsupported,
                       "port {} takes what its control sends at any time; only over XMODEM the "
                       "receiver begins",
                       port.names.name));
  }
  if (auto ready = check_ready(line); !ready) return answer(ready);
  line.begin_receive(answer);
}

void stop_transfer(PortLine& line, const std::string& reason, const PortLine::Answer& answer) {
  const LineView port = line.view();
  if (!port.run.empty()) {
    return answer(fail(Errc::Conflict, "port {} sends run {}; dnc run abort ends it",
                       port.names.name, port.run));
  }
  const bool is_sending = port.transfer && port.transfer->state == TransferState::Sending;
  if (is_sending) return line.abort(port.transfer->id, reason, answer);
  const auto progress = line.progress();
  if (progress && progress->kind == JobKind::Answer)
    return line.abort(progress->id, reason, answer);
  line.stop_receiving(reason, answer);
}

std::string transfer_words(const SendEnd& end) {
  return fmt::format("the transfer of programs {}: {} of {} bytes sent{}{}", to_string(end.outcome),
                     end.progress.sent.bytes, end.progress.size, end.reason.empty() ? "" : ": ",
                     end.reason);
}

bool has_numbered_programs(wire::Flow flow) {
  return flow == wire::Flow::Heidenhain || flow == wire::Flow::HeidenhainBcc;
}

}  // namespace dripline::line
