#include "server/ports/requests/gateway_at_control.hpp"

#include <utility>

#include "protocol/base/random.hpp"
#include "protocol/process/log.hpp"
#include "server/ports/gateways/gateway_requests.hpp"

namespace dripline::ports {

void GatewayAtControl::note(const std::string& words) {
  process::log_info("machine={}: {}", machine_, words);
}

bool GatewayAtControl::is_asked() const {
  const auto view = machines_.machine(machine_);
  const bool has_line = view && view->status && view->status->serial_line;
  return has_line && view->status->serial_line->asked.has_value();
}

void GatewayAtControl::send(SendJob job) {
  if (job.text) {
    job.size = job.text->size();
    job.source = std::make_shared<line::KeptText>(*std::exchange(job.text, std::nullopt));
  }
  job.id = fmt::format("answer-{}", random_hex(4));
  const auto order = push_text(ask_, machine_, job);
  if (!order) return refuse(order.error().what);
  tell(dds::LineAction::Answer, job.id, *order);
}

/// The gateway needs the call no more: the run takes its place.
void GatewayAtControl::start_later(const machines::StartRequest& request, Started started,
                                   const std::string&) {
  tell(dds::LineAction::Done, "", "");
  strand_.post([self = shared_from_this(), request, started = std::move(started)] {
    const auto ready = self->check_reset();
    started(ready ? self->machines_.start(request) : fail(ready.error()));
  });
}

void GatewayAtControl::tell(dds::LineAction action, const std::string& name,
                            const std::string& text) {
  dds::LineRequest request;
  request.machine = machine_;
  request.action = action;
  request.name = name;
  request.number = std::exchange(call_, 0);
  request.text = text;
  const auto answer = ask_(std::move(request), kAnswerLimit);
  if (!answer)
    process::log_warning("control not answered machine={}: {}", machine_, answer.error().what);
}

}  // namespace dripline::ports
