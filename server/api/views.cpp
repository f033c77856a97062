#include "server/api/views.hpp"

#include <nlohmann/json.hpp>

#include "server/api/status_view.hpp"
#include "server/machines/machine_notices.hpp"

namespace dripline::api {

using nlohmann::json;

namespace {

json optional_text(const std::string& text) {
  return text.empty() ? json(nullptr) : json(text);
}

json optional_time(const std::optional<UtcTime>& time) {
  return time ? json(to_iso8601(*time)) : json(nullptr);
}

json sequence_number(std::int64_t sequence) {
  return sequence < 0 ? json(nullptr) : json(sequence);
}

}  // namespace

json upload_json(const storage::Upload& upload, std::uint64_t max_piece) {
  return {{"id", upload.id},
          {"program", upload.program},
          {"received", upload.received},
          {"max_piece", max_piece}};
}

json revision_json(const storage::Revision& revision, const std::string& title) {
  return {{"program", revision.program},
          {"revision", revision.number},
          {"size", revision.size},
          {"sha256", revision.content.hex()},
          {"title", optional_text(title)},
          {"control", optional_text(revision.control)},
          {"comment", optional_text(revision.comment)},
          {"author", optional_text(revision.author)},
          {"created", to_iso8601(revision.created)},
          {"held", revision.is_held},
          {"accepted", optional_time(revision.accepted)}};
}

json program_json(const storage::ProgramSummary& program, const std::string& title) {
  json view = revision_json(program.latest, title);
  view.erase("program");
  view["name"] = program.latest.program;
  view["revisions"] = program.revisions;
  view["held_revisions"] = program.held;
  return view;
}

json machine_json(const machines::MachineView& view) {
  const auto seconds = [](std::chrono::microseconds time) {
    return std::chrono::duration<double>(time).count();
  };
  return {
      {"name", view.machine.name},
      {"control", optional_text(view.machine.control)},
      {"description", optional_text(view.machine.description)},
      {"gateway_version", optional_text(view.machine.gateway_version)},
      {"connected", view.is_connected},
      {"clock_ahead_seconds", view.clock_ahead ? json(seconds(*view.clock_ahead)) : json(nullptr)},
      {"notices", machines::notices_of(view)},
      {"first_seen", to_iso8601(view.machine.first_seen)},
      {"last_seen", to_iso8601(view.machine.last_seen)},
      {"status", view.status ? status_json(*view.status) : json(nullptr)}};
}

json run_json(const storage::Run& run) {
  return {{"id", run.id},
          {"machine", run.machine},
          {"program", run.program},
          {"revision", run.revision},
          {"sha256", run.content.hex()},
          {"size", run.size},
          {"control", optional_text(run.control)},
          {"state", storage::to_string(run.state)},
          {"sent", run.counters.sent},
          {"accepted", run.counters.accepted},
          {"executed", run.counters.executed},
          {"line", run.line},
          {"sequence", sequence_number(run.sequence)},
          {"reason", optional_text(run.reason)},
          {"content_verified", run.content_verified ? json(*run.content_verified) : json(nullptr)},
          {"author", optional_text(run.author)},
          {"created", to_iso8601(run.created)},
          {"started", optional_time(run.started)},
          {"ended", optional_time(run.ended)},
          {"outputs", run.outputs},
          {"setup", run.setup ? json(*run.setup) : json(nullptr)}};
}

json setup_json(const storage::SetupRevision& setup) {
  return {{"machine", setup.machine},
          {"revision", setup.number},
          {"size", setup.size},
          {"sha256", setup.sha256.hex()},
          {"comment", optional_text(setup.comment)},
          {"author", optional_text(setup.author)},
          {"created", to_iso8601(setup.created)}};
}

json record_json(const storage::Record& record) {
  return {{"machine", record.machine},
          {"epoch", record.epoch},
          {"number", record.number},
          {"time", to_iso8601(record.time)},
          {"received", optional_time(record.received)},
          {"run", optional_text(record.run)},
          {"kind", record.kind},
          {"block", record.block},
          {"line", record.line},
          {"sequence", sequence_number(record.sequence)},
          {"device", optional_text(record.device)},
          {"text", record.text}};
}

json report_json(const storage::Run& run) {
  return {{"run", run.id},
          {"machine", run.machine},
          {"program", run.program},
          {"revision", run.revision},
          {"state", storage::to_string(run.state)},
          {"lines", run.outputs},
          {"started", optional_time(run.started)},
          {"ended", optional_time(run.ended)}};
}

json audit_json(const storage::AuditEntry& entry) {
  return {{"time", to_iso8601(entry.time)},
          {"who", entry.who},
          {"action", entry.action},
          {"subject", entry.subject},
          {"detail", entry.detail}};
}

}  // namespace dripline::api
