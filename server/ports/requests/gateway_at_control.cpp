#include "server/ports/requests/gateway_at_control.hpp"

#include <utility>

#include "protocol/process/log.hpp"
#include "server/ports/programs/program_stream.hpp"

namespace dripline::ports {
namespace {

Result<std::string> read_all(const SendJob& job) {
  if (job.size > dds::kMaxCommandSetup) {
    return fail(Errc::LimitExceeded,
                "{} bytes: a gateway's control is offered programs of at most {}; start a run",
                job.size, dds::kMaxCommandSetup);
  }
  std::string text;
  while (text.size() < job.size) {
    const auto piece = job.source->read(text.size(), job.size - text.size());
    if (!piece) return fail(piece.error());
    text += *piece;
  }
  return text;
}

}  // namespace

void GatewayAtControl::note(const std::string& words) {
  process::log_info("machine={}: {}", machine_, words);
}

void GatewayAtControl::send(SendJob job) {
  auto text = job.text ? Result<std::string>(*std::move(job.text)) : read_all(job);
  if (!text) return refuse(text.error().what);
  tell(dds::LineAction::Answer, job.name, *text);
}

/// The gateway needs the call no more: the run takes its place.
void GatewayAtControl::start_later(const machines::StartRequest& request, Started started,
                                   const std::string&) {
  tell(dds::LineAction::Done, "", "");
  strand_.post([self = shared_from_this(), request, started = std::move(started)] {
    started(self->machines_.start(request));
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
