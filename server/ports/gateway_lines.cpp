#include "server/ports/gateway_lines.hpp"

#include <fmt/ranges.h>
#include <atomic>
#include <utility>

#include "gateway/line/line_words.hpp"
#include "protocol/process/log.hpp"
#include "server/ports/gateways/gateway_view.hpp"
#include "server/ports/line_transfer.hpp"
#include "server/ports/programs/uploaded_program.hpp"
#include "server/ports/requests/remote_request_handler.hpp"

namespace dripline::ports {
namespace {

using dds::LineAction;
using std::chrono::milliseconds;

}  // namespace

/// What is known of one machine's line.
struct GatewayLines::Line {
  Line(std::string machine, Strand its) : name(std::move(machine)), strand(std::move(its)) {}
  const std::string name;
  const Strand strand;
  // Under the mutex of GatewayLines.
  std::string upload;  ///< being fetched, or fetched last
  std::uint64_t session = 0, call = 0;
  std::optional<PortTransfer> sent;     ///< by this server, to this session; its state as reported
  bool is_sent_shown = false;           ///< the gateway has reported it
  std::optional<BrokenProgram> answer;  ///< that its control is reading
  // On the strand.
  std::shared_ptr<GatewayAtControl> at_control;
  std::unique_ptr<RemoteRequestHandler> requests;
  wire::Offer offer = wire::Offer::None;
  std::string reply;
  std::atomic<bool> waits_for_end = false;  ///< a request, for the end of its run
};

GatewayLines::GatewayLines(Parts parts)
    : parts_(std::move(parts)), monitor_(parts_.ask, parts_.clock, pool_), pool_(parts_.workers) {
  monitor_.begin();
}

GatewayLines::~GatewayLines() {
  end();
}

void GatewayLines::end() {
  pool_.stop();
}

std::shared_ptr<GatewayLines::Line> GatewayLines::line_of(const std::string& machine) {
  const std::lock_guard lock(mutex_);
  auto& line = lines_[machine];
  if (!line) line = std::make_shared<Line>(machine, Strand(pool_));
  return line;
}

void GatewayLines::on_status(const dds::Status& status) {
  if (!status.serial_line) return;
  monitor_.note(status.machine, status.session, status.serial_line->recorded);
  const auto line = line_of(status.machine);
  const auto& upload = status.serial_line->upload;
  const auto& call = status.serial_line->call;
  bool has_upload = false, has_call = false;
  {
    const std::lock_guard lock(mutex_);
    if (line->session != status.session) {
      if (line->sent && line->sent->state != TransferState::Completed)
        parts_.resets.note_lost(line->name,
                                {.id = line->sent->id,
                                 .what = fmt::format("{}", fmt::join(line->sent->programs, ", "))});
      if (line->answer) parts_.resets.note_lost(line->name, *std::exchange(line->answer, {}));
      line->session = status.session;
      line->upload.clear();
      line->call = 0;
      line->sent.reset();
    }
    const auto& transfer = status.serial_line->transfer;
    const bool is_sending = transfer && transfer->state == dds::LineTransferState::Sending;
    line->answer.reset();
    if (is_sending && !(line->sent && line->sent->id == transfer->id))
      line->answer = BrokenProgram{.id = transfer->id, .what = transfer->programs};
    if (transfer && line->sent && transfer->id == line->sent->id) {
      line->is_sent_shown = true;
      line->sent->state = static_cast<TransferState>(transfer->state);
    }
    has_upload = upload && line->upload.empty();
    if (has_upload) line->upload = upload->id;
    has_call = call && call->number > line->call;
    if (has_call) line->call = call->number;
  }
  if (has_upload) line->strand.post([this, line, upload = *upload] { fetch_upload(line, upload); });
  if (has_call) {
    line->strand.post([this, line, call = *call, asked = parts_.clock.steady_now()] {
      handle_call(line, call, asked);
    });
  }
  if (!line->waits_for_end) return;
  line->strand.post([line] {
    if (!line->requests) return;
    line->requests->on_run_stored();
    line->waits_for_end = line->requests->waits_for_end();
  });
}

void GatewayLines::fetch_upload(const std::shared_ptr<Line>& line, const dds::LineUpload& upload) {
  const auto words = store_upload(line->name, upload);
  if (words) {
    dds::LineRequest stored;
    stored.machine = line->name;
    stored.action = LineAction::Stored;
    stored.name = upload.id;
    stored.text = *words;
    if (auto answer = parts_.ask(std::move(stored), kAnswerLimit); !answer)
      process::log_warning("upload not confirmed machine={}: {}", line->name, answer.error().what);
  } else {
    process::log_error("program from the control not stored machine={}: {}", line->name,
                       words.error().what);
  }
  // The next status shows whether it still waits: then it is fetched again, and stored once.
  const auto again = [this, line] {
    const std::lock_guard lock(mutex_);
    line->upload.clear();
  };
  if (words) return again();
  constexpr milliseconds kRetry{2000};
  line->strand.post_after(kRetry, again);
}

/// What the gateway has is pulled, compared with its digest and stored. What can never be stored is
/// reported and dropped.
Result<std::string> GatewayLines::store_upload(const std::string& machine,
                                               const dds::LineUpload& upload) {
  UploadedProgram program(parts_.programs, {.machine = machine, .control = control_of(machine)});
  if (!upload.damage.empty()) program.damage(upload.damage);
  Sha256 hash;
  std::uint64_t at = 0;
  while (at < upload.size) {
    dds::LineRequest request;
    request.machine = machine;
    request.action = LineAction::Upload;
    request.name = upload.id;
    request.number = at;
    const auto data = parts_.ask(std::move(request), kAnswerLimit);
    if (!data) return fail(data.error());
    const std::string piece = text_of(*data);
    if (piece.empty()) return fail(Errc::Corrupt, "upload {} is short", upload.id);
    hash.update(piece);
    at += piece.size();
    // Its error comes again with the end.
    (void)program.append(piece).has_value();
  }
  if (hash.digest().hex() != upload.content)
    return fail(Errc::Corrupt, "upload {} is not what the gateway states", upload.id);
  const auto stored = program.store(upload.name);
  if (stored) {
    const auto& revision = stored->revision;
    return fmt::format("program {} is revision {}{}", revision.program, revision.number,
                       revision.is_held ? ", held for acceptance" : "");
  }
  const bool may_pass = stored.error().code == Errc::Io || stored.error().code == Errc::Busy;
  if (may_pass) return fail(stored.error());
  return "program not stored: " + stored.error().what;
}

std::string GatewayLines::control_of(const std::string& machine) const {
  const auto known = parts_.store.machines.find(machine);
  return known ? known->control : std::string();
}

Result<void> GatewayLines::check_reset(const std::string& name) const {
  const auto view = port(name);
  return view ? parts_.resets.check(*view, "") : fail(view.error());
}

void GatewayLines::handle_call(const std::shared_ptr<Line>& line, const dds::LineCall& call,
                               SteadyTime asked) {
  const auto view = port(line->name);
  if (!view) return;
  const bool is_known =
      line->requests && line->offer == view->settings.offer && line->reply == call.reply;
  if (!is_known) {
    const auto flow = view->settings.flow;
    line->offer = view->settings.offer;
    line->reply = call.reply;
    line->at_control =
        std::make_shared<GatewayAtControl>(line->name, parts_.ask, parts_.machines, line->strand,
                                           [this, name = line->name] { return check_reset(name); });
    line->requests = std::make_unique<RemoteRequestHandler>(RemoteRequestHandler::Parts{
        .store = parts_.store,
        .releases = parts_.releases,
        .line = line->at_control,
        .clock = parts_.clock,
        .machine = line->name,
        .reply = call.reply,
        .offer = line->offer,
        .refuses = flow == wire::Flow::HeidenhainBcc,
        .tells_aborts = flow == wire::Flow::Heidenhain || flow == wire::Flow::HeidenhainBcc ||
                        flow == wire::Flow::Xmodem});
  }
  line->at_control->begin(call.number);
  switch (call.action) {
    case dds::LineCallAction::Send:
      return line->requests->carry_out(line::RuleAction::Send, call.argument, asked);
    case dds::LineCallAction::Directory:
      return line->requests->carry_out(line::RuleAction::Directory, call.argument, asked);
    case dds::LineCallAction::Restart:
      return line->requests->carry_out(line::RuleAction::Restart, call.argument, asked);
    case dds::LineCallAction::NextJob:
      return line->requests->carry_out(line::RuleAction::NextJob, call.argument, asked);
    case dds::LineCallAction::Program:
      line->requests->answer(
          {.kind = wire::TransferRequest::Kind::SendProgram, .name = call.argument});
      line->waits_for_end = line->requests->waits_for_end();
      return;
    case dds::LineCallAction::List:
      return line->requests->answer(
          {.kind = wire::TransferRequest::Kind::Directory, .name = call.argument});
  }
}

/// What this server has just sent is shown at once, and with all its names.
PortView GatewayLines::show(const machines::MachineView& machine,
                            const dds::LineStatus& status) const {
  PortView view = view_of(machine, status);
  const std::lock_guard lock(mutex_);
  const auto line = lines_.find(view.port.name);
  if (line == lines_.end() || !line->second->sent) return view;
  const PortTransfer& sent = *line->second->sent;
  if (view.transfer && view.transfer->id == sent.id) {
    view.transfer->programs = sent.programs;
  } else if (!line->second->is_sent_shown) {
    view.transfer = sent;
  }
  return view;
}

std::vector<PortView> GatewayLines::ports() const {
  std::vector<PortView> views;
  for (const auto& machine : parts_.machines.machines()) {
    if (machine.has_gateway_line()) views.push_back(show(machine, *machine.status->serial_line));
  }
  return views;
}

Result<PortView> GatewayLines::port(const std::string& name) const {
  const auto machine = parts_.machines.machine(name);
  if (machine && machine->has_gateway_line()) return show(*machine, *machine->status->serial_line);
  return fail(Errc::NotFound, "port '{}' is not known", name);
}

Result<PortTest> GatewayLines::test(const std::string& name) {
  return test_gateway(parts_.ask, name);
}

/// A text is pushed to a gateway only if its line can take it.
Result<PortTransfer> GatewayLines::send(const std::string& name,
                                        const std::vector<ProgramChoice>& programs) {
  const SteadyTime asked = parts_.clock.steady_now();
  const auto view = port(name);
  if (!view) return fail(view.error());
  if (!view->is_open) {
    return fail(Errc::Timeout, "port {} is not open: {}", name,
                view->fault.empty() ? "not yet" : view->fault);
  }
  const bool is_sending = view->transfer && view->transfer->state == TransferState::Sending;
  if (!view->run.empty() || is_sending)
    return fail(Errc::Busy, "port {} is busy: it is {}", name, line::what_it_does(*view));
  if (auto ready = parts_.resets.check(*view, ""); !ready) return fail(ready.error());
  const auto job = make_transfer(
      {.store = parts_.store, .releases = parts_.releases, .clock = parts_.clock}, *view, programs);
  if (!job) return fail(job.error());
  if (parts_.clock.steady_now() - asked > kAnswerLimit)
    return fail(Errc::Busy, "port {}: reading {} took too long: nothing was sent", name, job->id);
  if (auto begun = send_at_gateway(parts_.ask, name, *job); !begun) return fail(begun.error());
  const PortTransfer sent{.id = job->id, .programs = job->programs, .size = job->size};
  const auto line = line_of(name);
  {
    const std::lock_guard lock(mutex_);
    line->sent = sent;
    line->is_sent_shown = false;
  }
  process::log_info("programs sent without a run by the gateway port={} id={} {}", name, job->id,
                    fmt::join(job->programs, ", "));
  return sent;
}

Result<std::string> GatewayLines::confirm_reset(const std::string& name) {
  const auto view = port(name);
  return view ? parts_.resets.confirm(*view, "") : fail(view.error());
}

Result<void> GatewayLines::receive(const std::string& name) {
  return receive_at_gateway(parts_.ask, name);
}

Result<void> GatewayLines::stop_transfer(const std::string& name, const std::string& reason) {
  return stop_at_gateway(parts_.ask, name, reason);
}

Result<RuleVerdict> GatewayLines::test_rules(const std::string& name,
                                             const std::string& text) const {
  return judge_at_gateway(parts_.ask, name, text);
}

Result<std::vector<PortTraffic>> GatewayLines::recording(const std::string& name) const {
  std::vector<PortTraffic> entries;
  std::uint64_t number = 0;
  const auto read = read_recording(parts_.ask, name, number, [&](const RecordingPart& part) {
    entries.insert(entries.end(), part.entries.begin(), part.entries.end());
  });
  if (!read) return fail(read.error());
  return entries;
}

void GatewayLines::on_traffic(std::function<void(const PortTraffic&)> listener,
                              std::function<bool(const std::string& port)> has_listeners) {
  monitor_.listen(std::move(listener), std::move(has_listeners));
}

}  // namespace dripline::ports
