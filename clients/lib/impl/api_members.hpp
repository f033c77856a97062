#pragma once

#include <concepts>
#include <type_traits>

#include "clients/lib/api_types.hpp"

/// The members of every type of api_types.hpp, listed once, in the documented order. A visitor `v`
/// is called for each: `v(key, member)`; `v.flag` for one that is only present when true, `v.later`
/// for one that older servers do not send.
namespace dripline::client {

/// The type itself, to be read or to be written.
template <class P, class T>
concept Is = std::same_as<std::remove_const_t<P>, T>;

template <class V>
void members(V& v, Is<ServerInfo::Dds> auto& x) {
  v("domain", x.domain);
  v("rejected", x.rejected);
}

template <class V>
void members(V& v, Is<ServerInfo::Health::Reason> auto& x) {
  v("subject", x.subject);
  v("status", x.status);
  v("message", x.message);
  v("detail", x.detail);
}

template <class V>
void members(V& v, Is<ServerInfo::Health> auto& x) {
  v("status", x.status);
  v("reasons", x.reasons);
}

template <class V>
void members(V& v, Is<ServerInfo> auto& x) {
  v("name", x.name);
  v("version", x.version);
  v("started", x.started);
  v("uptime_s", x.uptime_s);
  v("data_dir", x.data_dir);
  v("machines", x.machines);
  v("machines_connected", x.machines_connected);
  v("programs", x.programs);
  v("runs_active", x.runs_active);
  v.later("health", x.health);
  v("dds", x.dds);
}

/// What programs and revisions share.
template <class V, class P>
void content_members(V& v, P& x) {
  v("size", x.size);
  v("sha256", x.sha256);
  v("title", x.title);
  v("control", x.control);
  v("comment", x.comment);
  v("author", x.author);
  v("created", x.created);
  v.later("held", x.held);
  v("accepted", x.accepted);
}

template <class V>
void members(V& v, Is<Program> auto& x) {
  v("name", x.name);
  v("revision", x.revision);
  v("revisions", x.revisions);
  v.later("held_revisions", x.held_revisions);
  content_members(v, x);
}

template <class V>
void members(V& v, Is<Revision> auto& x) {
  v("program", x.program);
  v("revision", x.revision);
  content_members(v, x);
  v.flag("unchanged", x.unchanged);
}

template <class V>
void members(V& v, Is<Upload> auto& x) {
  v("id", x.id);
  v("program", x.program);
  v("received", x.received);
  v("max_piece", x.max_piece);
}

template <class V>
void members(V& v, Is<ActiveModes> auto& x) {
  v("motion", x.motion);
  v("compensation", x.compensation);
  v("units", x.units);
  v("incremental", x.incremental);
  v("feed_unit", x.feed_unit);
  v("feed", x.feed);
  v("feed_limited", x.feed_limited);
  v("tool", x.tool);
  v("next_tool", x.next_tool);
  v("tool_offset", x.tool_offset);
  v("tool_length_x", x.tool_length_x);
  v("tool_length_z", x.tool_length_z);
  v("tool_radius", x.tool_radius);
  v("work_system", x.work_system);
  v("cycle", x.cycle);
  v("dwell_seconds", x.dwell_seconds);
  v("surface_speed", x.surface_speed);
  v("spindle_speed", x.spindle_speed);
  v("spindle_load", x.spindle_load);
  v("flood", x.flood);
  v("mist", x.mist);
  v("tool_axis", x.tool_axis);
  v("spindle", x.spindle);
}

template <class V>
void members(V& v, Is<ProgramFrame> auto& x) {
  v("position", x.position);
  v("target", x.target);
  v("datum", x.datum);
  v("shift", x.shift);
  v("rotation", x.rotation);
  v("basic_rotation", x.basic_rotation);
  v("scale", x.scale);
  v("mirrored", x.mirrored);
  v("pole", x.pole);
}

template <class V>
void members(V& v, Is<Coordinates> auto& x) {
  v("target", x.target);
  v("distance_to_go", x.distance_to_go);
  v("following_error", x.following_error);
  v("program", x.program);
}

template <class V>
void members(V& v, Is<MachineStatus> auto& x) {
  v("time", x.time);
  v("execution", x.execution);
  v("mode", x.mode);
  v("run", x.run);
  v("program", x.program);
  v("sent", x.sent);
  v("accepted", x.accepted);
  v("executed", x.executed);
  v("total_bytes", x.total_bytes);
  v("offset", x.offset);
  v("line", x.line);
  v("sequence", x.sequence);
  v("position", x.position);
  v("feed_mm_per_min", x.feed_mm_per_min);
  v("spindle_rpm", x.spindle_rpm);
  v("feed_override", x.feed_override);
  v("rapid_override", x.rapid_override);
  v("spindle_override", x.spindle_override);
  v("buffered_seconds", x.buffered_seconds);
  v("single_block", x.single_block);
  v("message", x.message);
  v("outbox", x.outbox);
  v("modes", x.modes);
  v("coordinates", x.coordinates);
  v.later("emergency_stop", x.emergency_stop);
  v("remote_enable", x.remote_enable);
  v("waits_for", x.waits_for);
}

template <class V>
void members(V& v, Is<Machine> auto& x) {
  v("name", x.name);
  v("control", x.control);
  v("description", x.description);
  v("gateway_version", x.gateway_version);
  v("connected", x.connected);
  v("clock_ahead_seconds", x.clock_ahead_seconds);
  v.later("notices", x.notices);
  v("first_seen", x.first_seen);
  v("last_seen", x.last_seen);
  v("status", x.status);
}

template <class V>
void members(V& v, Is<Run> auto& x) {
  v("id", x.id);
  v("machine", x.machine);
  v("program", x.program);
  v("revision", x.revision);
  v("sha256", x.sha256);
  v("size", x.size);
  v("control", x.control);
  v("state", x.state);
  v("sent", x.sent);
  v("accepted", x.accepted);
  v("executed", x.executed);
  v("line", x.line);
  v("sequence", x.sequence);
  v("reason", x.reason);
  v("content_verified", x.content_verified);
  v("author", x.author);
  v("created", x.created);
  v("started", x.started);
  v("ended", x.ended);
  v("outputs", x.outputs);
  v("setup", x.setup);
}

template <class V>
void members(V& v, Is<Setup> auto& x) {
  v("machine", x.machine);
  v("revision", x.revision);
  v("size", x.size);
  v("sha256", x.sha256);
  v("comment", x.comment);
  v("author", x.author);
  v("created", x.created);
  v("text", x.text);
  v.flag("unchanged", x.unchanged);
}

template <class V>
void members(V& v, Is<MemoryCell> auto& x) {
  v("name", x.name);
  v("value", x.value);
  v("setup", x.setup);
}

template <class V>
void members(V& v, Is<Memory> auto& x) {
  v("machine", x.machine);
  v("run", x.run);
  v("program", x.program);
  v("time", x.time);
  v("cells", x.cells);
}

template <class V>
void members(V& v, Is<Record> auto& x) {
  v("machine", x.machine);
  v("epoch", x.epoch);
  v("number", x.number);
  v("time", x.time);
  v("run", x.run);
  v("kind", x.kind);
  v("block", x.block);
  v("line", x.line);
  v("sequence", x.sequence);
  v("device", x.device);
  v("text", x.text);
}

template <class V>
void members(V& v, Is<Report> auto& x) {
  v("run", x.run);
  v("machine", x.machine);
  v("program", x.program);
  v("revision", x.revision);
  v("state", x.state);
  v("lines", x.lines);
  v("started", x.started);
  v("ended", x.ended);
}

template <class V>
void members(V& v, Is<MachineReport> auto& x) {
  v("machine", x.machine);
  v("lines", x.lines);
  v("first", x.first);
  v("last", x.last);
}

template <class V>
void members(V& v, Is<Transfer> auto& x) {
  v("id", x.id);
  v("programs", x.programs);
  v("size", x.size);
  v("sent", x.sent);
  v("state", x.state);
  v("reason", x.reason);
}

template <class V>
void members(V& v, Is<Port::Line> auto& x) {
  v("phase", x.phase);
  v("stopped", x.stopped);
  v("stopping", x.stopping);
  v("waiting_for", x.waiting_for);
  v("without_limit", x.without_limit);
}

template <class V>
void members(V& v, Is<Port::Request> auto& x) {
  v("since", x.since);
  v("program", x.program);
  v("answer", x.answer);
}

template <class V>
void members(V& v, Is<Port> auto& x) {
  v("name", x.name);
  v("machine", x.machine);
  v("address", x.address);
  v("template", x.line_template);
  v("settings", x.settings);
  v("rules", x.rules);
  v("enabled", x.enabled);
  v("effective", x.effective);
  v("open", x.open);
  v("fault", x.fault);
  v("line", x.line);
  v("run", x.run);
  v("transfer", x.transfer);
  v("sent", x.sent);
  v("received", x.received);
  v("waiting_since", x.waiting_since);
  v.later("request", x.request);
}

template <class V>
void members(V& v, Is<Traffic> auto& x) {
  v("port", x.port);
  v("time", x.time);
  v("what", x.what);
  v("bytes", x.bytes);
  v("text", x.text);
}

template <class V>
void members(V& v, Is<PortTest> auto& x) {
  v("passed", x.passed);
  v("findings", x.findings);
}

template <class V>
void members(V& v, Is<RuleVerdict> auto& x) {
  v("rule", x.rule);
  v("action", x.action);
  v("argument", x.argument);
  v("why", x.why);
}

template <class V>
void members(V& v, Is<PortTemplate> auto& x) {
  v("name", x.name);
  v("title", x.title);
  v("control", x.control);
  v("settings", x.settings);
}

template <class V>
void members(V& v, Is<PortSetting> auto& x) {
  v("key", x.key);
  v("type", x.type);
  v("text", x.text);
  v("default", x.preset);
}

template <class V>
void members(V& v, Is<PortTemplates> auto& x) {
  v("templates", x.templates);
  v("settings", x.settings);
}

}  // namespace dripline::client
