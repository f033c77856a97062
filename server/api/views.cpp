#include "server/api/views.hpp"

#include <nlohmann/json.hpp>

#include "gateway/interpreter/registry.hpp"
#include "protocol/dds/members.hpp"
#include "protocol/dds/message.hpp"
#include "server/api/nullable_json.hpp"
#include "server/library/control_catalog.hpp"
#include "server/machines/machine_registry.hpp"

namespace dripline::api {

using nlohmann::json;

namespace {

constexpr std::string_view kAxes = "XYZABCUVW";

json letter(std::size_t axis) {
  return std::string(1, kAxes[axis]);
}

/// By axis letter, for the axes whose bit is set; bit 0 is X.
template <std::size_t N>
json axes_json(unsigned axes, const std::array<double, N>& values) {
  json object = json::object();
  for (std::size_t i = 0; i < N; ++i) {
    if ((axes >> i & 1) != 0) object[letter(i)] = values[i];
  }
  return object;
}

json axis_letters(unsigned axes) {
  json letters = json::array();
  for (std::size_t i = 0; i < kAxes.size(); ++i) {
    if ((axes >> i & 1) != 0) letters.push_back(letter(i));
  }
  return letters;
}

/// Visits the members of a status and of what it contains.
class StatusWriter {
 public:
  /// `axes`: those that the machine has.
  explicit StatusWriter(unsigned axes) : axes_(axes) {}

  template <class T, class Field, class... Rules>
  void operator()(const dds::Member<T, Field>& member, const Rules&... rules) {
    if constexpr (!(std::same_as<Rules, dds::Internal> || ...)) {
      put(member.name, member.value, rules...);
    }
  }
  json take() { return std::move(object_); }

 private:
  template <class T>
  void put(std::string_view name, const T& value, const auto&...) {
    constexpr std::string_view kClaim = "is_";
    if (name.starts_with(kClaim)) name.remove_prefix(kClaim.size());
    object_[std::string(name)] = shown(value);
  }
  void put(std::string_view, bool is_inch, dds::InchOrMetric) {
    object_["units"] = is_inch ? "inch" : "mm";
  }
  void put(std::string_view name, std::int64_t number, dds::NoneIfNegative) {
    object_[std::string(name)] = number < 0 ? json(nullptr) : json(number);
  }
  void put(std::string_view name, const std::optional<std::uint8_t>& axis, dds::AxisNumber) {
    object_[std::string(name)] = axis ? letter(*axis) : json(nullptr);
  }
  void put(std::string_view name, std::uint8_t axes, dds::MainAxisSet) {
    object_[std::string(name)] = axis_letters(axes);
  }

  json shown(bool value) const { return value; }
  json shown(double value) const { return value; }
  template <std::integral T>
  json shown(T value) const {
    return value;
  }
  json shown(const std::string& text) const { return text.empty() ? json(nullptr) : json(text); }
  json shown(UtcTime time) const { return to_iso8601(time); }
  json shown(dds::Enumeration auto value) const {
    const std::string_view word = dds::to_string(value);
    return word == "unknown" ? json(nullptr) : json(word);
  }
  template <std::size_t N>
  json shown(const std::array<double, N>& values) const {
    return axes_json(axes_, values);
  }
  template <class T>
  json shown(const std::optional<T>& value) const {
    return value ? shown(*value) : json(nullptr);
  }
  template <class T>
  requires std::is_class_v<T> json shown(const T& message)
  const {
    StatusWriter writer(axes_);
    dds::members(writer, message);
    return writer.take();
  }
  json shown(const dds::ProgramFrame& frame) const {
    StatusWriter writer(axes_);
    dds::members(writer, frame);
    json view = writer.take();
    view["pole"] = frame.pole_axes != 0 ? axes_json(frame.pole_axes, frame.pole) : json(nullptr);
    return view;
  }

  unsigned axes_;
  json object_ = json::object();
};

/// What the API shows of a gateway's status: the members of protocol/dds/members.hpp under their
/// names, and `distance_to_go`. Axes are objects by letter, absent values null, times ISO 8601 UTC.
json status_json(const dds::Status& status) {
  StatusWriter writer(status.axes);
  dds::members(writer, status);
  json view = writer.take();
  if (status.coordinates) {
    std::array<double, 9> distance{};
    for (std::size_t i = 0; i < distance.size(); ++i) {
      distance[i] = status.coordinates->target[i] - status.position[i];
    }
    view["coordinates"]["distance_to_go"] = axes_json(status.axes, distance);
  }
  return view;
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

/// What the control's own position display shows: the units of the program while one is there, and
/// on a lathe X as its programs have it, as a diameter.
static json display_json(const machines::MachineView& view) {
  const auto dialect = interpreter::find_dialect(view.machine.control);
  if (!dialect) return nullptr;
  const bool has_program = view.status && !view.status->run.empty() && view.status->modes;
  const bool is_inch =
      has_program ? view.status->modes->is_inch : (*dialect)->units == interpreter::Units::Inch;
  const bool is_lathe = (*dialect)->machine == interpreter::MachineKind::Lathe;
  return {{"units", is_inch ? "inch" : "mm"}, {"x", is_lathe ? "diameter" : "radius"}};
}

namespace {

/// Where a run can begin, and what can be decided about it. A control at the end of a line gets the
/// rest of the text; one of a gateway looks through the program, as far as it can.
json starts_json(const machines::MachineView& view) {
  const bool has_line =
      view.machine.gateway_version.empty() || (view.status && view.status->serial_line);
  if (has_line)
    return {{"at", {"block", "line", "byte"}}, {"head", true}, {"memory", false}, {"pass", false}};
  const auto& search = library::start_search_of(view.machine.control);
  auto at = json::array();
  for (const auto place : search.at) at.push_back(place);
  return {{"at", std::move(at)},
          {"head", false},
          {"memory", search.has_memory},
          {"pass", search.has_pass}};
}

}  // namespace

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

json machine_json(const machines::MachineView& view) {
  const auto seconds = [](std::chrono::microseconds time) {
    return std::chrono::duration<double>(time).count();
  };
  return {
      {"name", view.machine.name},
      {"control", text_or_null(view.machine.control)},
      {"description", text_or_null(view.machine.description)},
      {"gateway_version", text_or_null(view.machine.gateway_version)},
      {"connected", view.is_connected},
      {"clock_ahead_seconds", view.clock_ahead ? json(seconds(*view.clock_ahead)) : json(nullptr)},
      {"notices", machines::notices_of(view)},
      {"first_seen", to_iso8601(view.machine.first_seen)},
      {"last_seen", to_iso8601(view.machine.last_seen)},
      {"held", hold_json(view.held)},
      {"queue_hold", hold_json(view.queue_hold)},
      {"starts", starts_json(view)},
      {"display", display_json(view)},
      {"status", view.status ? status_json(*view.status) : json(nullptr)}};
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
          {"job", number_or_null(run.job)}};
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
