#pragma once

#include "clients/lib/api_types.hpp"
#include "clients/lib/impl/port_members.hpp"
#include "clients/lib/impl/release_members.hpp"
#include "clients/lib/impl/server_members.hpp"
#include "clients/lib/value_types.hpp"

/// The members of every type of api_types.hpp, listed once, in the documented order. A visitor `v`
/// is called for each: `v(key, member)`; `v.flag` for one that is only present when true, `v.later`
/// for one that older servers do not send.
namespace dripline::client {

/// What programs and revisions share.
template <class V, class P>
void content_members(V& v, P& x) {
  DRIPLINE_MEMBERS(size, sha256, title, control, comment, author, created);
  v.later("held", x.held);
  DRIPLINE_MEMBERS(accepted);
  v.later("state", x.state);
  v.later("released", x.released);
  v.later("withdrawn", x.withdrawn);
  DRIPLINE_MEMBERS(cam_file);
}

template <class V>
void members(V& v, Is<Program> auto& x) {
  DRIPLINE_MEMBERS(name, revision, revisions);
  v.later("held_revisions", x.held_revisions);
  content_members(v, x);
  DRIPLINE_MEMBERS(part, operation, material, machine_group);
}

template <class V>
void members(V& v, Is<Revision> auto& x) {
  DRIPLINE_MEMBERS(program, revision);
  content_members(v, x);
  v.flag("unchanged", x.unchanged);
}

template <class V>
void members(V& v, Is<Attachment> auto& x) {
  DRIPLINE_MEMBERS(program, revision, name, size, sha256, comment, author, created);
}

template <class V>
void members(V& v, Is<SearchHit> auto& x) {
  members(v, x.revision);
  DRIPLINE_MEMBERS(part, operation, material, machine_group, line, text, partly_indexed);
}

template <class V>
void members(V& v, Is<SearchResult> auto& x) {
  DRIPLINE_MEMBERS(hits, next, to_be_indexed);
}

template <class V>
void members(V& v, Is<Upload> auto& x) {
  DRIPLINE_MEMBERS(id, program, received, max_piece);
}

template <class V>
void members(V& v, Is<ActiveModes> auto& x) {
  DRIPLINE_MEMBERS(motion, compensation, units, incremental, feed_unit, feed, feed_limited, tool,
                   next_tool, tool_offset, tool_length_x, tool_length_z, tool_radius, work_system,
                   cycle, dwell_seconds, surface_speed, spindle_speed, spindle_load, flood, mist,
                   tool_axis, spindle);
}

template <class V>
void members(V& v, Is<ProgramFrame> auto& x) {
  DRIPLINE_MEMBERS(position, target, datum, shift, rotation, basic_rotation, scale, mirrored, pole);
}

template <class V>
void members(V& v, Is<Coordinates> auto& x) {
  DRIPLINE_MEMBERS(target, distance_to_go, following_error, program);
}

template <class V>
void members(V& v, Is<Screen> auto& x) {
  DRIPLINE_MEMBERS(units, position, previous_block, block, next_block, further_block);
}

template <class V>
void members(V& v, Is<PanelSwitches> auto& x) {
  DRIPLINE_MEMBERS(optional_stop, block_skip, skip_levels, dry_run, machine_lock, handwheel,
                   test_run);
}

template <class V>
void members(V& v, Is<JogStatus> auto& x) {
  DRIPLINE_MEMBERS(step, feed, moving, refusal);
}

template <class V>
void members(V& v, Is<MachineStatus> auto& x) {
  DRIPLINE_MEMBERS(time, execution, mode, run, program, sent, accepted, executed, total_bytes,
                   offset, line, sequence, position, feed_mm_per_min, spindle_rpm, feed_override,
                   rapid_override, spindle_override, buffered_seconds, single_block, message,
                   outbox, modes, coordinates);
  v.later("emergency_stop", x.emergency_stop);
  DRIPLINE_MEMBERS(remote_enable, waits_for);
  v.later("screen", x.screen);
  v.later("switches", x.switches);
  v.later("jog", x.jog);
}

template <class V>
void members(V& v, Is<Display> auto& x) {
  DRIPLINE_MEMBERS(units, x);
  v.later("fields", x.fields);
}

template <class V>
void members(V& v, Is<Starts> auto& x) {
  DRIPLINE_MEMBERS(at, head, memory, pass);
  v.later("mdi", x.mdi);
}

template <class V>
void members(V& v, Is<Positions> auto& x) {
  DRIPLINE_MEMBERS(offsets, datum_axes, tool_axes, x_diameter, zero_only, playback);
}

template <class V>
void members(V& v, Is<PositionSet::Cell> auto& x) {
  DRIPLINE_MEMBERS(name, before, value, unit);
}

template <class V>
void members(V& v, Is<PositionSet> auto& x) {
  DRIPLINE_MEMBERS(machine, change, text);
  v.later("what", x.what);
  v.later("cells", x.cells);
  v.later("length", x.length);
  v.later("zero", x.zero);
}

template <class V>
void members(V& v, Is<JogDone> auto& x) {
  DRIPLINE_MEMBERS(machine, text, axis, position, moved, unit, reached);
}

template <class V>
void members(V& v, Is<PlaybackBlock> auto& x) {
  DRIPLINE_MEMBERS(machine, block);
}

template <class V>
void members(V& v, Is<Hold> auto& x) {
  DRIPLINE_MEMBERS(who, reason);
  v.later("run", x.run);
  DRIPLINE_MEMBERS(since);
}

template <class V>
void members(V& v, Is<Machine> auto& x) {
  DRIPLINE_MEMBERS(name, control, description, gateway_version, connected);
  v.later("stale", x.stale);
  v.later("unconfirmed_gateway", x.unconfirmed_gateway);
  DRIPLINE_MEMBERS(clock_ahead_seconds);
  v.later("notices", x.notices);
  DRIPLINE_MEMBERS(first_seen, last_seen);
  v.later("held", x.held);
  v.later("queue_hold", x.queue_hold);
  v.later("display", x.display);
  v.later("starts", x.starts);
  v.later("positions", x.positions);
  DRIPLINE_MEMBERS(status);
}

template <class V>
void members(V& v, Is<RunStatistics> auto& x) {
  DRIPLINE_MEMBERS(motion_seconds, distance_mm, average_feed_mm_per_min, average_block_seconds,
                   blocks_per_second);
}

template <class V>
void members(V& v, Is<Run> auto& x) {
  DRIPLINE_MEMBERS(id, machine, program, revision, sha256, size, control, state, sent, accepted,
                   executed, line, sequence, reason, content_verified, author, created, started,
                   ended, outputs, setup);
  v.later("allowed_as", x.allowed_as);
  v.later("approval", x.approval);
  v.later("job", x.job);
  v.later("statistics", x.statistics);
  v.later("test", x.test);
}

template <class V>
void members(V& v, Is<BegunRun> auto& x) {
  members(v, x.run);
  v.later("notice", x.notice);
}

template <class V>
void members(V& v, Is<ShownRun::Parts> auto& x) {
  DRIPLINE_MEMBERS(good, unknown, rework, scrap);
  v.later("archived", x.archived);
  v.later("archives", x.archives);
}

template <class V>
void members(V& v, Is<ShownRun> auto& x) {
  members(v, x.run);
  v.later("held", x.held);
  v.later("parts", x.parts);
}

template <class V>
void members(V& v, Is<Job> auto& x) {
  DRIPLINE_MEMBERS(id, machine, program, revision, quantity, parts_per_run, completed, runs, state,
                   comment, author, created);
  v.later("counts", x.counts);
  v.later("good", x.good);
  v.later("unknown", x.unknown);
  v.later("rework", x.rework);
  v.later("scrap", x.scrap);
}

template <class V>
void members(V& v, Is<JobList::Hold> auto& x) {
  DRIPLINE_MEMBERS(who, reason, since);
}

template <class V>
void members(V& v, Is<JobList> auto& x) {
  DRIPLINE_MEMBERS(jobs, hold);
}

template <class V>
void members(V& v, Is<Webhook> auto& x) {
  DRIPLINE_MEMBERS(name, url, kinds, author, created, delivered, delivered_at, waiting, lost,
                   failures, failing_since, fault);
  v.later("secret", x.secret);
}

template <class V>
void members(V& v, Is<WebhookTest> auto& x) {
  DRIPLINE_MEMBERS(delivered, fault);
}

template <class V>
void members(V& v, Is<Folder> auto& x) {
  DRIPLINE_MEMBERS(name, path, machine, control, fault, looked, waiting, stored, failed,
                   last_refused, last_reason);
}

template <class V>
void members(V& v, Is<FolderFile> auto& x) {
  DRIPLINE_MEMBERS(folder, name, size, sha256, state, program, revision, reason, target, taken,
                   moved);
}

template <class V>
void members(V& v, Is<Import::Target> auto& x) {
  DRIPLINE_MEMBERS(program, revision);
}

template <class V>
void members(V& v, Is<Import> auto& x) {
  DRIPLINE_MEMBERS(program, revision, machine, control, size, sha256, comment, received, state);
  v("class", x.edit);
  DRIPLINE_MEMBERS(base, fault, compared, decided, who, reason, at_once, accepted_as);
}

template <class V>
void members(V& v, Is<Setup> auto& x) {
  DRIPLINE_MEMBERS(machine, revision, size, sha256, comment, author, created, text);
  v.flag("unchanged", x.unchanged);
}

template <class V>
void members(V& v, Is<LoadedSetup> auto& x) {
  DRIPLINE_MEMBERS(machine, revision, who, time);
}

template <class V>
void members(V& v, Is<MemoryCell> auto& x) {
  DRIPLINE_MEMBERS(name, value, setup);
}

template <class V>
void members(V& v, Is<ControlValue> auto& x) {
  DRIPLINE_MEMBERS(name, value);
}

template <class V>
void members(V& v, Is<ControlOutput> auto& x) {
  DRIPLINE_MEMBERS(axis, output, on);
}

template <class V>
void members(V& v, Is<ControlAnalogOutput> auto& x) {
  DRIPLINE_MEMBERS(output, value);
}

template <class V>
void members(V& v, Is<ControlInput> auto& x) {
  DRIPLINE_MEMBERS(name, on);
}

template <class V>
void members(V& v, Is<ControlValues> auto& x) {
  DRIPLINE_MEMBERS(machine, values, next, outputs, analog, codes, functions, inputs);
}

template <class V>
void members(V& v, Is<MemoryChange> auto& x) {
  DRIPLINE_MEMBERS(what, who);
}

template <class V>
void members(V& v, Is<Memory> auto& x) {
  DRIPLINE_MEMBERS(machine, run, program, time, cells);
  v.later("change", x.change);
}

template <class V>
void members(V& v, Is<Record> auto& x) {
  DRIPLINE_MEMBERS(machine, epoch, number, time, run, kind, block, line, sequence, device, text);
}

template <class V>
void members(V& v, Is<Report> auto& x) {
  DRIPLINE_MEMBERS(run, machine, program, revision, state, lines, started, ended);
}

template <class V>
void members(V& v, Is<MachineReport> auto& x) {
  DRIPLINE_MEMBERS(machine, lines, first, last);
}

template <class V>
void members(V& v, Is<Session> auto& x) {
  DRIPLINE_MEMBERS(user, role, groups, credential, kind, expires, address);
  v.later("secret", x.secret);
}

template <class V>
void members(V& v, Is<User> auto& x) {
  DRIPLINE_MEMBERS(name, role, groups, locked, has_password, created, signed_in);
}

template <class V>
void members(V& v, Is<Token> auto& x) {
  DRIPLINE_MEMBERS(user, name, kind, role, groups, created, expires, used, used_from);
  v.later("secret", x.secret);
}

template <class V>
void members(V& v, Is<MachineGroup> auto& x) {
  DRIPLINE_MEMBERS(name, machines);
}

#undef DRIPLINE_MEMBER
#undef DRIPLINE_MEMBERS

}  // namespace dripline::client
