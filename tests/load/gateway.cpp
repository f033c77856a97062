#include "tests/load/gateway.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "protocol/base/random.hpp"
#include "protocol/dds/record_text.hpp"

namespace dripline::load {
namespace {

using namespace std::chrono_literals;

constexpr std::uint16_t kXyz = 0b111;
constexpr std::uint64_t kAhead = 128 * 1024;  ///< bytes that a feeding machine keeps
constexpr std::uint32_t kPiece = 32 * 1024;   ///< of a request
constexpr auto kPatience = 1s;                ///< before it asks again

/// What a milling machine reports in the middle of a program.
dds::Status first_status(const std::string& machine) {
  dds::Status status;
  status.machine = machine;
  status.session = random_number() | 1;
  status.execution = dds::Execution::Ready;
  status.axes = kXyz;
  status.remote_enable = dds::RemoteEnable::Unattended;
  status.waits_for = dds::WaitsFor::Nothing;
  status.modes.emplace();
  status.modes->motion = dds::MotionKind::Line;
  status.modes->feed = 600;
  status.modes->tool = 3;
  status.modes->work_system = "G54";
  status.coordinates.emplace();
  status.coordinates->following_error.emplace();
  status.coordinates->program.emplace();
  return status;
}

}  // namespace

std::string program_text(std::uint64_t first_line, std::uint64_t lines) {
  std::string text;
  text.reserve(lines * kLineBytes);
  for (std::uint64_t line = first_line; line < first_line + lines; ++line) {
    text += fmt::format("N{:08} G1 X{:06}. Y{:07}.\n", line % 100'000'000, line % 99'991,
                        line % 999'983);
  }
  return text;
}

bool is_program_text(std::uint64_t offset, std::span<const std::byte> bytes) {
  const std::uint64_t first = offset / kLineBytes;
  const std::uint64_t last = (offset + bytes.size() + kLineBytes - 1) / kLineBytes;
  const std::string expected = program_text(first, last - first);
  const auto begin = expected.begin() + static_cast<std::ptrdiff_t>(offset % kLineBytes);
  return std::equal(bytes.begin(), bytes.end(), begin,
                    [](std::byte a, char b) { return static_cast<char>(a) == b; });
}

LoadGateway::LoadGateway(Options options)
    : options_(std::move(options)), status_(first_status(options_.machine)) {}

Result<std::unique_ptr<LoadGateway>> LoadGateway::open(const Options& options) {
  std::unique_ptr<LoadGateway> gateway(new LoadGateway(options));
  LoadGateway* const self = gateway.get();
  dds::GatewayHandlers handlers;
  handlers.on_command = [self](dds::Command command) { self->post(std::move(command)); };
  handlers.on_ack = [self](dds::RecordAck ack) { self->post(std::move(ack)); };
  handlers.on_block = [self](dds::BlockData block) { self->post(std::move(block)); };
  handlers.on_server = [self](bool is_connected) {
    self->is_connected_ = is_connected;
    self->post(is_connected);
  };
  auto endpoint = dds::GatewayEndpoint::open(options.network, options.machine, handlers);
  if (!endpoint) return fail(endpoint.error());
  gateway->endpoint_ = std::move(*endpoint);
  return gateway;
}

Result<void> LoadGateway::begin() {
  auto outbox = report::Outbox::open(":memory:");
  if (!outbox) return fail(outbox.error());
  outbox_.emplace(std::move(*outbox));
  sender_.emplace(
      options_.machine, *outbox_, report::SenderOptions{},
      [this](const dds::Record& record) { return endpoint_->write(record).has_value(); });
  dds::Announce announce;
  announce.machine = options_.machine;
  announce.control = "fanuc";
  announce.version = "load";
  announce.epoch = outbox_->epoch();
  announce.session = status_.session;
  return endpoint_->write(announce);
}

void LoadGateway::post(Mail mail) {
  const std::lock_guard lock(mutex_);
  mail_.push_back(std::move(mail));
  has_mail_ = true;
}

void LoadGateway::turn(SteadyTime now) {
  std::deque<Mail> mail;
  {
    const std::lock_guard lock(mutex_);
    mail.swap(mail_);
    has_mail_ = false;
  }
  for (const auto& one : mail) {
    std::visit([&](const auto& message) { handle(message, now); }, one);
  }
  if (auto sent = sender_->poll(now); !sent) ++damaged_;
  pull(now);
}

void LoadGateway::handle(bool is_connected, SteadyTime) {
  sender_->on_server(is_connected);
  if (is_connected) write_status();
}

void LoadGateway::handle(const dds::RecordAck& ack, SteadyTime now) {
  sender_->on_ack(ack, now);
}

void LoadGateway::handle(const dds::Command& command, SteadyTime now) {
  dds::CommandResult result;
  result.machine = options_.machine;
  result.id = command.id;
  result.accepted = command.action == dds::CommandAction::Start;
  if (!result.accepted) result.reason = "a machine of the load only starts";
  if (result.accepted && status_.run != command.run) {
    status_.run = command.run;
    status_.program = command.program;
    status_.total_bytes = command.size;
    status_.execution = dds::Execution::Active;
    status_.feed_mm_per_min = 600;
    status_.spindle_rpm = 4000;
    if (options_.text_rate > 0) fed_since_ = now;
    if (!fed_since_) status_.sent = command.size;
    append(dds::RecordKind::RunStarted,
           encode(dds::RunStartText{command.program, command.revision, command.control}));
    write_status();
  }
  (void)endpoint_->write(result);  // lost: the server repeats the command
}

void LoadGateway::handle(const dds::BlockData& block, SteadyTime) {
  if (block.run != status_.run || block.status != dds::BlockStatus::Ok) return;
  if (!is_program_text(block.offset, block.bytes)) ++damaged_;
  if (block.offset != status_.sent) return;  // after a loss: asked again
  status_.sent += block.bytes.size();
  text_bytes_ += block.bytes.size();
}

void LoadGateway::pull(SteadyTime now) {
  if (!fed_since_ || !is_connected_ || status_.sent == status_.total_bytes) return;
  const std::chrono::duration<double> passed = now - *fed_since_;
  const auto executed = static_cast<std::uint64_t>(passed.count() * options_.text_rate);
  const bool is_answered = status_.sent >= wanted_;
  if (!is_answered && now - asked_ < kPatience) return;
  if (is_answered && status_.sent > executed + kAhead) return;
  dds::BlockRequest request;
  request.machine = options_.machine;
  request.session = status_.session;
  request.run = status_.run;
  request.offset = status_.sent;
  request.length = static_cast<std::uint32_t>(
      std::min<std::uint64_t>(kPiece, status_.total_bytes - status_.sent));
  wanted_ = request.offset + request.length;
  asked_ = now;
  (void)endpoint_->write(request);
}

void LoadGateway::change(SteadyTime) {
  ++status_.executed;
  ++status_.line;
  ++status_.accepted;
  status_.sequence = static_cast<std::int64_t>(10 * status_.line);
  status_.offset += kLineBytes;
  const double angle = static_cast<double>(status_.executed) / 40;
  status_.position = {80 * std::cos(angle), 80 * std::sin(angle), -3.5};
  status_.coordinates->target = status_.position;
  status_.coordinates->program->position = status_.position;
  status_.buffered_seconds = 4 + std::sin(angle);
  status_.outbox = static_cast<std::uint32_t>(outbox_->unacknowledged());
  write_status();
}

void LoadGateway::write_status() {
  const SystemClock clock;
  status_.time = clock.now();
  status_.steady =
      std::chrono::duration_cast<std::chrono::microseconds>(clock.steady_now().time_since_epoch());
  if (!endpoint_->write(status_)) ++refused_;
}

void LoadGateway::report() {
  append(dds::RecordKind::Output, fmt::format("LOAD {} {}", options_.machine, records() + 1));
}

void LoadGateway::append(dds::RecordKind kind, std::string text) {
  dds::Record record;
  record.machine = options_.machine;
  record.time = SystemClock().now();
  record.run = status_.run;
  record.kind = kind;
  record.block = status_.executed;
  record.line = status_.line;
  record.sequence = status_.sequence;
  if (kind == dds::RecordKind::Output) record.device = "port1";
  record.text = std::move(text);
  outbox_->append(std::move(record));
  if (!outbox_->commit()) ++damaged_;
}

}  // namespace dripline::load
