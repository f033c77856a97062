#include "server/ports/gateway_lines.hpp"

#include <sstream>
#include <utility>

#include "gateway/line/recording/recording_file.hpp"
#include "protocol/process/log.hpp"
#include "server/ports/port_settings.hpp"
#include "server/ports/programs/uploaded_program.hpp"
#include "server/ports/requests/remote_request_handler.hpp"

namespace dripline::ports {
namespace {

using dds::LineAction;
using std::chrono::milliseconds;

constexpr milliseconds kTestLimit{15'000};

std::string text_of(const dds::LineData& data) {
  return {reinterpret_cast<const char*>(data.bytes.data()), data.bytes.size()};
}

}  // namespace

/// What is known of one machine's line.
struct GatewayLines::Line {
  Line(std::string machine, Strand its) : name(std::move(machine)), strand(std::move(its)) {}
  const std::string name;
  const Strand strand;
  // Under the mutex of GatewayLines.
  std::string upload;  ///< being fetched, or fetched last
  std::uint64_t session = 0, call = 0;
  // On the strand.
  std::shared_ptr<GatewayAtControl> at_control;
  std::unique_ptr<RemoteRequestHandler> requests;
  wire::Offer offer = wire::Offer::None;
  std::string reply;
  std::uint64_t monitored = 0, monitored_session = 0;  ///< the next entry of the recording
};

GatewayLines::GatewayLines(Parts parts) : parts_(std::move(parts)), pool_(parts_.workers) {
  pool_.post_after(kMonitorInterval, [this] { monitor(); });
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
  const auto line = line_of(status.machine);
  const auto& upload = status.serial_line->upload;
  const auto& call = status.serial_line->call;
  bool has_upload = false, has_call = false;
  {
    const std::lock_guard lock(mutex_);
    if (line->session != status.session) {
      line->session = status.session;
      line->upload.clear();
      line->call = 0;
    }
    has_upload = upload && line->upload.empty();
    if (has_upload) line->upload = upload->id;
    has_call = call && call->number > line->call;
    if (has_call) line->call = call->number;
  }
  if (has_upload) line->strand.post([this, line, upload = *upload] { fetch_upload(line, upload); });
  if (has_call) line->strand.post([this, line, call = *call] { handle_call(line, call); });
}

void GatewayLines::fetch_upload(const std::shared_ptr<Line>& line, const dds::LineUpload& upload) {
  const auto words = store_upload(line->name, upload);
  if (words) {
    dds::LineRequest stored;
    stored.machine = line->name;
    stored.action = LineAction::Stored;
    stored.name = upload.id;
    stored.text = *words;
    if (auto told = parts_.ask(std::move(stored), kAnswerLimit); !told)
      process::log_warning("upload not confirmed machine={}: {}", line->name, told.error().what);
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

void GatewayLines::handle_call(const std::shared_ptr<Line>& line, const dds::LineCall& call) {
  const auto view = port(line->name);
  if (!view) return;
  const bool is_known =
      line->requests && line->offer == view->settings.offer && line->reply == call.reply;
  if (!is_known) {
    const auto flow = view->settings.flow;
    line->offer = view->settings.offer;
    line->reply = call.reply;
    line->at_control =
        std::make_shared<GatewayAtControl>(line->name, parts_.ask, parts_.machines, line->strand);
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
      return line->requests->carry_out(line::RuleAction::Send, call.argument);
    case dds::LineCallAction::Directory:
      return line->requests->carry_out(line::RuleAction::Directory, call.argument);
    case dds::LineCallAction::Restart:
      return line->requests->carry_out(line::RuleAction::Restart, call.argument);
    case dds::LineCallAction::NextJob:
      return line->requests->carry_out(line::RuleAction::NextJob, call.argument);
    case dds::LineCallAction::Program:
      return line->requests->answer(
          {.kind = wire::TransferRequest::Kind::SendProgram, .name = call.argument});
    case dds::LineCallAction::List:
      return line->requests->answer(
          {.kind = wire::TransferRequest::Kind::Directory, .name = call.argument});
  }
}

namespace {

/// As the gateway reports it, in the form of a port.
PortView view_of(const machines::MachineView& machine, const dds::LineStatus& line) {
  PortView view;
  view.names = {machine.machine.name, machine.machine.name, line.address};
  view.port.name = view.port.machine = machine.machine.name;
  view.port.address = line.address;
  view.port.line_template = line.line_template;
  std::istringstream settings(line.settings);
  for (std::string word; std::getline(settings, word);) {
    const auto equals = word.find('=');
    if (word.empty()) continue;
    if (equals == std::string::npos) {
      view.port.settings.emplace_back("line", word);
    } else {
      view.port.settings.emplace_back(word.substr(0, equals), word.substr(equals + 1));
    }
  }
  if (auto known = effective_settings(view.port)) view.settings = *std::move(known);
  view.is_open = machine.is_connected && line.is_open;
  view.fault = machine.is_connected ? line.fault : "its gateway is not connected";
  view.line.phase = static_cast<wire::Phase>(line.phase);
  view.line.is_stopped = line.is_stopped;
  view.line.is_stopping = line.is_stopping;
  view.line.may_wait_without_limit = line.waits_without_limit;
  view.sent = line.characters_sent;
  view.received = line.characters_received;
  if (machine.status) view.run = machine.status->run;
  return view;
}

}  // namespace

std::vector<PortView> GatewayLines::ports() const {
  std::vector<PortView> views;
  for (const auto& machine : parts_.machines.machines()) {
    if (machine.status && machine.status->serial_line)
      views.push_back(view_of(machine, *machine.status->serial_line));
  }
  return views;
}

Result<PortView> GatewayLines::port(const std::string& name) const {
  const auto machine = parts_.machines.machine(name);
  if (machine && machine->status && machine->status->serial_line)
    return view_of(*machine, *machine->status->serial_line);
  return fail(Errc::NotFound, "port '{}' is not known", name);
}

Result<PortTest> GatewayLines::test(const std::string& name) {
  dds::LineRequest request;
  request.machine = name;
  request.action = LineAction::Test;
  const auto data = parts_.ask(std::move(request), kTestLimit);
  if (!data) return fail(data.error());
  PortTest test;
  std::istringstream lines(text_of(*data));
  std::string verdict;
  std::getline(lines, verdict);
  test.is_passed = verdict == "passed";
  for (std::string finding; std::getline(lines, finding);) test.findings.push_back(finding);
  return test;
}

Result<void> GatewayLines::receive(const std::string& name) {
  dds::LineRequest request;
  request.machine = name;
  request.action = LineAction::Receive;
  const auto done = parts_.ask(std::move(request), kAnswerLimit);
  if (!done) return fail(done.error());
  return {};
}

Result<void> GatewayLines::read_recording(const std::string& machine, std::uint64_t& number,
                                          const std::function<void(const PortTraffic&)>& on_entry) {
  for (bool ends = false; !ends;) {
    dds::LineRequest request;
    request.machine = machine;
    request.action = LineAction::Recording;
    request.number = number;
    const auto data = parts_.ask(std::move(request), kAnswerLimit);
    if (!data) return fail(data.error());
    std::istringstream lines(text_of(*data));
    for (std::string text; std::getline(lines, text);) {
      auto entry = line::parse_recording_line(text);
      if (!entry) return fail(entry.error());
      entry->port = machine;
      on_entry(*entry);
    }
    ends = data->ends || data->next == number;
    number = data->next;
  }
  return {};
}

Result<std::vector<PortTraffic>> GatewayLines::recording(const std::string& name) {
  std::vector<PortTraffic> entries;
  std::uint64_t number = 0;
  const auto read = read_recording(
      name, number, [&entries](const PortTraffic& entry) { entries.push_back(entry); });
  if (!read) return fail(read.error());
  return entries;
}

void GatewayLines::on_traffic(std::function<void(const PortTraffic&)> listener,
                              std::function<bool(const std::string& port)> has_listeners) {
  const std::lock_guard lock(mutex_);
  on_traffic_ = std::move(listener);
  has_listeners_ = std::move(has_listeners);
}

/// Lines that are watched are asked for what is new; others cost nothing.
void GatewayLines::monitor() {
  std::vector<std::shared_ptr<Line>> watched;
  {
    const std::lock_guard lock(mutex_);
    if (has_listeners_) {
      for (const auto& [name, line] : lines_) {
        if (has_listeners_(name)) {
          watched.push_back(line);
        } else {
          line->monitored_session = 0;
        }
      }
    }
  }
  for (const auto& line : watched) {
    std::uint64_t session = 0;
    std::function<void(const PortTraffic&)> publish;
    {
      const std::lock_guard lock(mutex_);
      session = line->session;
      publish = on_traffic_;
    }
    // What was before is in the recording; a monitor begins now.
    const bool begins = std::exchange(line->monitored_session, session) != session;
    if (begins) line->monitored = 0;
    const auto read = read_recording(line->name, line->monitored, [&](const PortTraffic& entry) {
      if (!begins) publish(entry);
    });
    if (!read) line->monitored_session = 0;
  }
  pool_.post_after(kMonitorInterval, [this] { monitor(); });
}

}  // namespace dripline::ports
