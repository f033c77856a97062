#include "server/api/views.hpp"

#include <nlohmann/json.hpp>

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

constexpr std::string_view kAxes = "XYZABCUVW";

/// By axis letter, for the axes whose bit is set; bit 0 is X.
template <std::size_t N>
json axes_json(unsigned axes, const std::array<double, N>& values) {
  json object = json::object();
  for (std::size_t i = 0; i < N; ++i) {
    if ((axes >> i & 1) != 0) object[std::string(1, kAxes[i])] = values[i];
  }
  return object;
}

json axis_letters(unsigned axes) {
  json letters = json::array();
  for (std::size_t i = 0; i < kAxes.size(); ++i) {
    if ((axes >> i & 1) != 0) letters.push_back(std::string(1, kAxes[i]));
  }
  return letters;
}

json number_or_null(const std::optional<std::int32_t>& value) {
  return value ? json(*value) : json(nullptr);
}

json modes_json(const dds::ActiveModes& modes) {
  return {{"motion", dds::to_string(modes.motion)},
          {"compensation", dds::to_string(modes.compensation)},
          {"units", modes.is_inch ? "inch" : "mm"},
          {"incremental", modes.is_incremental},
          {"feed_unit", dds::to_string(modes.feed_unit)},
          {"feed", modes.feed},
          {"feed_limited", modes.is_feed_limited},
          {"tool", number_or_null(modes.tool)},
          {"next_tool", number_or_null(modes.next_tool)},
          {"tool_offset", number_or_null(modes.tool_offset)},
          {"tool_length_x", modes.tool_length_x},
          {"tool_length_z", modes.tool_length_z},
          {"tool_radius", modes.tool_radius},
          {"work_system", optional_text(modes.work_system)},
          {"cycle", optional_text(modes.cycle)},
          {"dwell_seconds", modes.dwell_seconds},
          {"surface_speed", modes.is_surface_speed},
          {"spindle_speed", modes.spindle_speed},
          {"spindle_load", modes.spindle_load ? json(*modes.spindle_load) : json(nullptr)},
          {"flood", modes.flood},
          {"mist", modes.mist},
          {"tool_axis",
           modes.tool_axis ? json(std::string(1, kAxes[*modes.tool_axis])) : json(nullptr)},
          {"spindle", modes.spindle == dds::SpindleState::NotTold
                          ? json(nullptr)
                          : json(dds::to_string(modes.spindle))}};
}

json frame_json(const dds::ProgramFrame& frame, unsigned axes) {
  constexpr unsigned kMainAxes = 7;
  return {{"position", axes_json(axes, frame.position)},
          {"target", axes_json(axes, frame.target)},
          {"datum", axes_json(axes, frame.datum)},
          {"shift", axes_json(axes, frame.shift)},
          {"rotation", frame.rotation},
          {"basic_rotation", frame.basic_rotation},
          {"scale", axes_json(axes & kMainAxes, frame.scale)},
          {"mirrored", axis_letters(frame.mirrored)},
          {"pole", frame.pole_axes != 0 ? axes_json(frame.pole_axes, frame.pole) : json(nullptr)}};
}

json coordinates_json(const dds::Status& status) {
  if (!status.coordinates) return nullptr;
  const dds::Coordinates& all = *status.coordinates;
  std::array<double, 9> distance{};
  for (std::size_t i = 0; i < distance.size(); ++i)
    distance[i] = all.target[i] - status.position[i];
  return {{"target", axes_json(status.axes, all.target)},
          {"distance_to_go", axes_json(status.axes, distance)},
          {"lag", all.lag ? axes_json(status.axes, *all.lag) : json(nullptr)},
          {"program", all.program ? frame_json(*all.program, status.axes) : json(nullptr)}};
}

json status_json(const dds::Status& status) {
  return {{"time", to_iso8601(status.time)},
          {"execution", dds::to_string(status.execution)},
          {"mode", dds::to_string(status.mode)},
          {"run", optional_text(status.run)},
          {"program", optional_text(status.program)},
          {"sent", status.sent},
          {"accepted", status.accepted},
          {"executed", status.executed},
          {"total_bytes", status.total_bytes},
          {"offset", status.offset},
          {"line", status.line},
          {"sequence", sequence_number(status.sequence)},
          {"position", axes_json(status.axes, status.position)},
          {"feed_mm_per_min", status.feed_mm_per_min},
          {"spindle_rpm", status.spindle_rpm},
          {"feed_override", status.feed_override},
          {"rapid_override", status.rapid_override},
          {"spindle_override", status.spindle_override},
          {"buffered_seconds", status.buffered_seconds},
          {"single_block", status.single_block},
          {"message", optional_text(status.message)},
          {"outbox", status.outbox},
          {"modes", status.modes ? modes_json(*status.modes) : json(nullptr)},
          {"coordinates", coordinates_json(status)},
          {"emergency_stop", status.emergency_stop},
          {"remote_enable", status.remote_enable == dds::RemoteEnable::NotTold
                                ? json(nullptr)
                                : json(dds::to_string(status.remote_enable))},
          {"waits_for", status.waits_for == dds::WaitsFor::NotTold
                            ? json(nullptr)
                            : json(dds::to_string(status.waits_for))}};
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
