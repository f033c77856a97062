#include "tests/unit/gateway/app/gateway_fixture.hpp"

#include <gtest/gtest.h>
#include <cstring>
#include <fstream>
#include <stdexcept>

#include "tests/unit/gateway/app/toy_control.hpp"

namespace dripline::gateway {

using std::chrono::milliseconds;

struct GatewayFixture::Process {
  Process(const std::filesystem::path& folder, std::uint64_t outbox_bytes)
      : outbox(report::Outbox::open(folder / "outbox.sqlite", {.max_bytes = outbox_bytes}).value()),
        journal(report::RunJournal::open(folder / "run.journal").value()),
        motion_journal(report::MotionJournal::open(folder / "motion.journal").value()),
        execution_probe(ExecutionProbe::open(folder / "execution_probe").value()) {}
  report::Outbox outbox;
  report::RunJournal journal;
  report::MotionJournal motion_journal;
  ExecutionProbe execution_probe;
};

interpreter::Setup setup_from(const std::string& toml) {
  auto setup = interpreter::parse_setup(toml);
  EXPECT_TRUE(setup) << setup.error().what;
  return *setup;
}

GatewayFixture::GatewayFixture(const std::string& speed)
    : GatewayFixture(toy_control(), {}, speed) {}

GatewayFixture::GatewayFixture(const interpreter::Dialect& control, interpreter::Setup its_setup,
                               const std::string& speed)
    : setup(std::move(its_setup)), control_(control) {
  options_.machine = "lathe-1";
  options_.control = control.name;
  options_.speed = parse_speed(speed).value();
  restart_gateway();
}

GatewayFixture::~GatewayFixture() = default;

void GatewayFixture::close_gateway() {
  gateway.reset();
  process_.reset();
}

void GatewayFixture::set_checkpoint_interval(std::chrono::milliseconds interval) {
  options_.checkpoint_interval = interval;
}

void GatewayFixture::restart_gateway() {
  close_gateway();
  process_ = std::make_unique<Process>(folder_.path(), outbox_bytes);
  requests_.clear();
  Gateway::Parts parts{
      .options = options_,
      .dialect = control_,
      .setup = setup,
      .setup_digest = setup_digest,
      .endpoint = *this,
      .outbox = process_->outbox,
      .journal = process_->journal,
      .motion_journal = motion ? &process_->motion_journal : nullptr,
      .execution_probe = process_->execution_probe,
      .clock = clock,
      .make_motion =
          motion ? motion
                 : make_motion("simulated", control_, {.workpiece = setup.workpiece}).value(),
      .session = static_cast<std::uint64_t>(++sessions_),
      .kept_emergency_stop = folder() / "emergency-stop"};
  if (take_panel) parts.take_panel = take_panel;
  gateway = std::make_unique<Gateway>(std::move(parts));
  if (const auto done = gateway->recover(); !done) throw std::runtime_error(done.error().what);
  gateway->receive(ServerSeen{is_up}, clock.steady);
}

void GatewayFixture::connect(bool up) {
  is_up = up;
  gateway->receive(ServerSeen{up}, clock.steady);
}

void GatewayFixture::make_attended() {
  options_.is_unattended = false;
  restart_gateway();
}

void GatewayFixture::allow_jogs(double step, double feed) {
  options_.jog_step = step;
  options_.jog_feed = feed;
  restart_gateway();
}

std::string GatewayFixture::panel(const std::string& line) {
  std::string answer;
  gateway->receive(PanelRequest{parse_panel_command(line).value(),
                                [&](std::string text) { answer = std::move(text); }},
                   clock.steady);
  return answer;
}

bool GatewayFixture::run_until(const std::function<bool()>& done, milliseconds step) {
  const SteadyTime limit = clock.steady + std::chrono::minutes(1);
  while (clock.steady < limit) {
    gateway->turn(clock.steady);
    if (each_turn) each_turn();
    serve();
    if (done()) return true;
    clock.steady += step;
  }
  return false;
}

std::chrono::microseconds GatewayFixture::steady_time() const {
  return std::chrono::duration_cast<std::chrono::microseconds>(clock.steady.time_since_epoch());
}

dds::Command GatewayFixture::command(dds::CommandAction action) {
  dds::Command command;
  command.machine = "lathe-1";
  command.id = "order-" + std::to_string(++commands_);
  command.session = static_cast<std::uint64_t>(sessions_);
  command.server = 1;
  command.number = static_cast<std::uint64_t>(commands_);
  command.deadline = steady_time() + std::chrono::seconds(5);
  command.action = action;
  return command;
}

dds::Command GatewayFixture::start_command(const std::string& program) {
  dds::Command start = command(dds::CommandAction::Start);
  start.run = "run-" + std::to_string(++runs_);
  start.program = program;
  start.revision = sha256(programs.at(program)).hex();
  start.size = programs.at(program).size();
  start.control = options_.control;
  program_ = program;
  return start;
}

dds::CommandResult GatewayFixture::send(const dds::Command& command) {
  results.erase(command.id);
  gateway->receive(command, clock.steady);
  run_until([&] { return results.count(command.id) > 0; }, milliseconds(1));
  return results.at(command.id);
}

dds::RunEndText GatewayFixture::ended() {
  const std::size_t before = count(dds::RecordKind::RunEnded);
  const bool has =
      run_until([&] { return count(dds::RecordKind::RunEnded) > before; }) || !records.empty();
  if (!has) throw std::runtime_error("no record at all");
  return dds::decode_run_end(records.back().text).value();
}

std::vector<std::string> GatewayFixture::lines() const {
  std::vector<std::string> all;
  for (const dds::Record& record : records) {
    if (record.kind == dds::RecordKind::Output) all.push_back(record.text);
  }
  return all;
}

std::size_t GatewayFixture::count(dds::RecordKind kind) const {
  std::size_t found = 0;
  for (const dds::Record& record : records) found += record.kind == kind ? 1 : 0;
  return found;
}

ExecutionProbe::Counts GatewayFixture::execution_probe() const {
  std::ifstream file(folder() / "execution_probe", std::ios::binary);
  ExecutionProbe::Counts counts;
  file.read(reinterpret_cast<char*>(&counts), sizeof counts);
  return counts;
}

Result<void> GatewayFixture::write(const dds::Announce& message) {
  announced.push_back(message);
  return {};
}
Result<void> GatewayFixture::write(const dds::Status& message) {
  status = message;
  return {};
}
Result<void> GatewayFixture::write(const dds::Record& message) {
  if (is_up && message.number == records.size() + 1) records.push_back(message);
  return {};
}
Result<void> GatewayFixture::write(const dds::CommandResult& message) {
  results[message.id] = message;
  return {};
}
Result<void> GatewayFixture::write(const dds::BlockRequest& message) {
  if (is_up && serves_text) requests_.push_back(message);
  return {};
}

std::optional<std::string> GatewayFixture::text_of(const dds::BlockRequest& request) const {
  const auto found = programs.find(request.program.empty() ? program_ : request.program);
  if (found != programs.end()) return found->second;
  return loader ? loader(request.program) : std::nullopt;
}

void GatewayFixture::serve() {
  if (!is_up) return;
  for (const dds::BlockRequest& request : std::exchange(requests_, {})) {
    const auto found = text_of(request);
    if (!found) {
      dds::BlockData none;
      none.machine = request.machine;
      none.session = request.session;
      none.run = request.run;
      none.program = request.program;
      none.status = dds::BlockStatus::NoSuchProgram;
      gateway->receive(none, clock.steady);
      continue;
    }
    const std::string& text = *found;
    std::size_t at = request.offset;
    const std::size_t end = std::min<std::size_t>(text.size(), at + request.length);
    while (at < end) {
      dds::BlockData data;
      data.machine = request.machine;
      data.session = request.session;
      data.run = request.run;
      data.program = request.program;
      data.offset = at;
      data.total_bytes = text.size();
      if (!request.program.empty()) data.content = sha256(text).hex();
      const std::size_t length = std::min(dds::kMaxBlockBytes, end - at);
      const auto* bytes = reinterpret_cast<const std::byte*>(text.data()) + at;
      data.bytes.assign(bytes, bytes + length);
      at += length;
      data.ends = at == text.size();
      gateway->receive(data, clock.steady);
    }
  }
  if (acknowledges && !records.empty())
    gateway->receive(dds::RecordAck{"lathe-1", records.back().epoch, records.back().number},
                     clock.steady);
}

std::string with_reports(int lines, int moves) {
  std::string text;
  for (int i = 0; i < lines; ++i) {
    for (int m = 0; m < moves; ++m) text += "X" + std::to_string((i + m) % 9) + "\n";
    text += "OUT LINE " + std::to_string(i) + "\n";
  }
  return text + "END\n";
}

}  // namespace dripline::gateway
