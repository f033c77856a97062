#include "server/api/views.hpp"

#include <nlohmann/json.hpp>

#include "server/api/nullable_json.hpp"
#include "server/library/history/test_runs.hpp"

namespace dripline::api {

using nlohmann::json;

namespace {

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
          {"title", text_or_null(title)},
          {"control", text_or_null(revision.control)},
          {"comment", text_or_null(revision.comment)},
          {"author", text_or_null(revision.author)},
          {"created", to_iso8601(revision.created)},
          {"held", revision.is_held},
          {"accepted", time_or_null(revision.accepted)},
          {"state", storage::to_string(revision.state)},
          {"released", time_or_null(revision.released)},
          {"withdrawn", time_or_null(revision.withdrawn)},
          {"cam_file", text_or_null(revision.cam_file)}};
}

json fields_json(const storage::ProgramFields& fields) {
  return {{"part", text_or_null(fields.part)},
          {"operation", text_or_null(fields.operation)},
          {"material", text_or_null(fields.material)},
          {"machine_group", text_or_null(fields.machine_group)}};
}

json program_json(const storage::ProgramSummary& program, const std::string& title) {
  json view = revision_json(program.latest, title);
  view.erase("program");
  view["name"] = program.latest.program;
  view["revisions"] = program.revisions;
  view["held_revisions"] = program.held;
  view.update(fields_json(program.fields));
  return view;
}

json hold_json(const std::optional<storage::MachineHold>& hold) {
  if (!hold) return nullptr;
  return {{"who", hold->who},
          {"reason", text_or_null(hold->reason)},
          {"run", text_or_null(hold->run)},
          {"since", to_iso8601(hold->since)}};
}

json hold_json(const std::optional<storage::JobHold>& hold) {
  if (!hold) return nullptr;
  return {{"who", hold->who}, {"reason", hold->reason}, {"since", to_iso8601(hold->since)}};
}

json statistics_json(const storage::Run& run) {
  if (!run.statistics) return nullptr;
  const auto& [seconds, path] = *run.statistics;
  const auto blocks = static_cast<double>(run.counters.executed);
  const auto quotient = [](double dividend, double divisor) {
    return divisor > 0 ? json(dividend / divisor) : json(nullptr);
  };
  return {{"motion_seconds", seconds},
          {"distance_mm", path},
          {"average_feed_mm_per_min", quotient(path, seconds / 60)},
          {"average_block_seconds", quotient(seconds, blocks)},
          {"blocks_per_second", quotient(blocks, seconds)}};
}

json run_json(const storage::Run& run) {
  return {{"id", run.id},
          {"machine", run.machine},
          {"program", run.program},
          {"revision", run.revision},
          {"sha256", run.content.hex()},
          {"size", run.size},
          {"control", text_or_null(run.control)},
          {"state", storage::to_string(run.state)},
          {"sent", run.counters.sent},
          {"accepted", run.counters.accepted},
          {"executed", run.counters.executed},
          {"line", run.line},
          {"sequence", sequence_number(run.sequence)},
          {"reason", text_or_null(run.reason)},
          {"content_verified", run.content_verified ? json(*run.content_verified) : json(nullptr)},
          {"author", text_or_null(run.author)},
          {"created", to_iso8601(run.created)},
          {"started", time_or_null(run.started)},
          {"ended", time_or_null(run.ended)},
          {"outputs", run.outputs},
          {"setup", number_or_null(run.setup)},
          {"allowed_as", storage::to_string(run.allowed_as)},
          {"approval", number_or_null(run.approval)},
          {"job", number_or_null(run.job)},
          {"statistics", statistics_json(run)},
          {"test", library::is_test_run(run)}};
}

json begun_json(const storage::Run& run, std::string_view notice) {
  json view = run_json(run);
  view["notice"] = text_or_null(notice);
  return view;
}

json loaded_setup_json(const storage::LoadedSetup& loaded) {
  return {{"machine", loaded.machine},
          {"revision", number_or_null(loaded.number)},
          {"who", text_or_null(loaded.who)},
          {"time", to_iso8601(loaded.time)}};
}

json setup_json(const storage::SetupRevision& setup) {
  return {{"machine", setup.machine},
          {"revision", setup.number},
          {"size", setup.size},
          {"sha256", setup.sha256.hex()},
          {"comment", text_or_null(setup.comment)},
          {"author", text_or_null(setup.author)},
          {"created", to_iso8601(setup.created)}};
}

json record_json(const storage::Record& record) {
  return {{"machine", record.machine},
          {"epoch", record.epoch},
          {"number", record.number},
          {"time", to_iso8601(record.time)},
          {"received", time_or_null(record.received)},
          {"run", text_or_null(record.run)},
          {"kind", record.kind},
          {"block", record.block},
          {"line", record.line},
          {"sequence", sequence_number(record.sequence)},
          {"device", text_or_null(record.device)},
          {"text", record.text}};
}

json report_json(const storage::Run& run) {
  return {{"run", run.id},
          {"machine", run.machine},
          {"program", run.program},
          {"revision", run.revision},
          {"state", storage::to_string(run.state)},
          {"lines", run.outputs},
          {"started", time_or_null(run.started)},
          {"ended", time_or_null(run.ended)}};
}

json audit_json(const storage::AuditEntry& entry) {
  return {{"time", to_iso8601(entry.time)},
          {"who", entry.who.name},
          {"credential", entry.who.credential},
          {"address", entry.who.address},
          {"action", entry.action},
          {"subject", entry.subject},
          {"detail", entry.detail}};
}

}  // namespace dripline::api
