#include "gateway/app/serial/serial_inbound.hpp"

#include <utility>

#include "gateway/interpreter/registry.hpp"
#include "gateway/line/inbound/comment_program.hpp"
#include "protocol/base/random.hpp"
#include "protocol/process/log.hpp"

namespace dripline::gateway {
namespace {

bool is_all_programs(const SerialInbound::Parts& parts) {
  const auto dialect = interpreter::find_dialect(parts.control);
  return parts.settings.control.kind == wire::ControlKind::ProtoTrak ||
         (dialect && (*dialect)->text.is_all_programs);
}

}  // namespace

SerialInbound::SerialInbound(Parts parts)
    : parts_(std::move(parts)),
      is_all_programs_(is_all_programs(parts_)),
      router_(parts_.rules, parts_.settings.extracts_programs, *this) {}

/// Until they are on disk the control is held, where it lets itself be held.
void SerialInbound::print(std::vector<line::PrintedLine> lines, std::function<void()> kept) {
  const std::string run = parts_.run();
  for (auto& printed : lines) {
    parts_.records.append(
        {.kind = printed.is_probe ? dds::RecordKind::Probe : dds::RecordKind::Output,
         .run = run,
         .device = parts_.device,
         .text = std::move(printed.text)});
  }
  parts_.records.call_when_kept(std::move(kept));
  if (parts_.records.fault().empty()) (void)parts_.records.commit();
}

void SerialInbound::begin_program() {
  const auto time = parts_.clock.now().time_since_epoch().count();
  parts_.uploads.begin(fmt::format("{:017}-{}", time, ++uploads_begun_));
}

void SerialInbound::store_program(const std::string& name) {
  const auto stored = parts_.uploads.finish(name);
  if (!stored) {
    process::log_error("program from the control not kept: {}", stored.error().what);
    return router_.report("program not stored: " + stored.error().what);
  }
  port_->note(fmt::format("a program of {} bytes waits for the server", stored->size));
}

void SerialInbound::answer(const std::string& words) {
  const std::string& name = parts_.rules->reply();
  if (name.empty()) return;
  const auto sent = send_answer(name, line::comment_program(name, line::comment_lines(words)));
  if (!sent) process::log_warning("answer not sent: {}", sent.error().what);
}

Result<void> SerialInbound::send_answer(std::string name, std::string text) {
  if (auto allowed = parts_.check_allowed(); !allowed) return allowed;
  line::SendJob job;
  job.kind = line::JobKind::Answer;
  job.id = fmt::format("answer-{}", random_hex(4));
  job.name = std::move(name);
  job.size = text.size();
  job.source = std::make_shared<line::KeptText>(std::move(text));
  port_->begin(std::move(job), [](const Result<void>& begun) {
    if (!begun) process::log_warning("answer not sent: {}", begun.error().what);
  });
  return {};
}

}  // namespace dripline::gateway
