#pragma once

#include <concepts>
#include <type_traits>

#include "protocol/dds/message.hpp"

/// The members of every message, each listed once: encoding, decoding, the checks, the JSON of the
/// API (server/api/views.cpp) and the fuzz targets visit these lists, and tests compare them
/// with dripline.idl, with openapi.json and with the client library. A visitor `v` is called once
/// for each member, in the order of the IDL:
///
///     v(member, rules...)
///
/// where `member` is a Member and each rule is an object of one of the types below. Without a rule,
/// a number must be finite, an enumerator must have a word, a text must be UTF-8 and fit.
namespace dripline::dds {

/// `T`, to be read or to be written.
template <class P, class T>
concept Is = std::same_as<std::remove_const_t<P>, T>;

template <class T, class Field>
struct Member {
  std::string_view name;       ///< in the message and, without "is_", in JSON
  T& value;                    ///< in the message
  std::string_view wire_name;  ///< in dripline.idl
  Field field;                 ///< field(sample): its place in the generated struct
};
template <class T, class Field>
Member(std::string_view, T&, std::string_view, Field) -> Member<T, Field>;

// How a text is checked.
struct MachineName {};
struct ProgramName {};  ///< may be empty
struct Word {};         ///< printable ASCII without blanks; may be empty
struct Identifier {};   ///< a word that is not empty
struct Sha256 {};       ///< hexadecimal; may be empty
/// Bytes that cannot travel are written as \xNN; what is too long ends in "…".
struct FreeText {};
/// Like FreeText, but what is too long is refused: a record is never shortened.
struct RecordText {};
struct SetupText {};  ///< sent as bytes, at most kMaxCommandSetup

// What a number means beyond its type.
struct Epoch {};           ///< 1 to 2^63 - 1: both ends store it as a signed number
struct Positive {};        ///< 1 or more
struct RequestLength {};   ///< 1 to kMaxRequestBytes
struct NoneIfNegative {};  ///< -1: none
struct ExpiryTime {};      ///< on the wire 0: none; otherwise until the year 9999
struct AxisNumber {};      ///< on the wire 1 = X, 9 = W, 0: none
struct MainAxisSet {};     ///< bit 0 = X, bit 2 = Z
struct InchOrMetric {};    ///< in JSON "units": "inch" or "mm"

/// The API shows this member under no name, or only as part of another one.
struct Internal {};

/// flag(sample): the boolean that is set when the optional member is there.
template <class Field>
struct PresentIf {
  Field flag;
};
template <class Field>
PresentIf(Field) -> PresentIf<Field>;

/// crc(sample): the CRC-32 of the member.
template <class Field>
struct CheckedBy {
  Field crc;
};
template <class Field>
CheckedBy(Field) -> CheckedBy<Field>;

#define DRIPLINE_FIELD(path) [](auto& sample) -> decltype(auto) { return (sample.path); }
#define DRIPLINE_MEMBER(name) (Member{#name, m.name, #name, DRIPLINE_FIELD(name)})
#define DRIPLINE_MEMBER_AS(name, wire) (Member{#name, m.name, #wire, DRIPLINE_FIELD(wire)})

template <class V>
void members(V&& v, Is<Announce> auto& m) {
  v(DRIPLINE_MEMBER(machine), MachineName{});
  v(DRIPLINE_MEMBER(control), Word{});
  v(DRIPLINE_MEMBER(version));
  v(DRIPLINE_MEMBER(protocol));
  v(DRIPLINE_MEMBER(epoch), Epoch{});
  v(DRIPLINE_MEMBER(session));
  v(DRIPLINE_MEMBER(description), FreeText{});
  v(DRIPLINE_MEMBER_AS(certificate_expires, certificate_expires_us), ExpiryTime{});
  v(DRIPLINE_MEMBER(has_line));
  v(DRIPLINE_MEMBER(commands));
}

template <class V>
void members(V&& v, Is<ActiveModes> auto& m) {
  v(DRIPLINE_MEMBER(motion));
  v(DRIPLINE_MEMBER(compensation));
  v(DRIPLINE_MEMBER(is_inch), InchOrMetric{});
  v(DRIPLINE_MEMBER(is_incremental));
  v(DRIPLINE_MEMBER(feed_unit));
  v(DRIPLINE_MEMBER(feed));
  v(DRIPLINE_MEMBER(is_feed_limited));
  v(DRIPLINE_MEMBER(tool), NoneIfNegative{});
  v(DRIPLINE_MEMBER(next_tool), NoneIfNegative{});
  v(DRIPLINE_MEMBER(tool_offset), NoneIfNegative{});
  v(DRIPLINE_MEMBER(tool_length_x));
  v(DRIPLINE_MEMBER(tool_length_z));
  v(DRIPLINE_MEMBER(tool_radius));
  v(DRIPLINE_MEMBER(work_system));
  v(DRIPLINE_MEMBER(cycle));
  v(DRIPLINE_MEMBER(dwell_seconds));
  v(DRIPLINE_MEMBER(is_surface_speed));
  v(DRIPLINE_MEMBER(spindle_speed));
  v(DRIPLINE_MEMBER(spindle_load), NoneIfNegative{});
  v(DRIPLINE_MEMBER(flood));
  v(DRIPLINE_MEMBER(mist));
  v(DRIPLINE_MEMBER(tool_axis), AxisNumber{});
  v(DRIPLINE_MEMBER(spindle));
}

struct WholeSample {
  auto& operator()(auto& sample) const { return sample; }
};

/// Its members lie among those of the Coordinates in the IDL.
template <class V>
void members(V&& v, Is<ProgramFrame> auto& m) {
  v(DRIPLINE_MEMBER_AS(position, program_position));
  v(DRIPLINE_MEMBER_AS(target, program_target));
  v(DRIPLINE_MEMBER(datum));
  v(DRIPLINE_MEMBER(shift));
  v(DRIPLINE_MEMBER(rotation));
  v(DRIPLINE_MEMBER(basic_rotation));
  v(DRIPLINE_MEMBER(scale));
  v(DRIPLINE_MEMBER(mirrored), MainAxisSet{});
  v(DRIPLINE_MEMBER(pole_axes), MainAxisSet{}, Internal{});
  v(DRIPLINE_MEMBER(pole));
}

template <class V>
void members(V&& v, Is<Coordinates> auto& m) {
  v(DRIPLINE_MEMBER(target));
  v(DRIPLINE_MEMBER(following_error), PresentIf{DRIPLINE_FIELD(has_following_error)});
  v(Member{"program", m.program, "", WholeSample{}}, PresentIf{DRIPLINE_FIELD(has_program)});
}

/// Its members lie among those of the Status in the IDL.
template <class V>
void members(V&& v, Is<PanelSwitches> auto& m) {
  v(DRIPLINE_MEMBER_AS(optional_stop, switch_optional_stop));
  v(DRIPLINE_MEMBER_AS(block_skip, switch_block_skip));
  v(DRIPLINE_MEMBER(skip_levels), Word{});
  v(DRIPLINE_MEMBER_AS(dry_run, switch_dry_run));
  v(DRIPLINE_MEMBER_AS(machine_lock, switch_machine_lock));
  v(DRIPLINE_MEMBER_AS(handwheel, switch_handwheel));
  v(DRIPLINE_MEMBER_AS(test_run, switch_test_run));  // the last of the IDL
}

template <class V>
void members(V&& v, Is<LineUpload> auto& m) {
  v(DRIPLINE_MEMBER(id), Identifier{});
  v(DRIPLINE_MEMBER(name), FreeText{});
  v(DRIPLINE_MEMBER(size));
  v(DRIPLINE_MEMBER(content), Sha256{});
  v(DRIPLINE_MEMBER(damage), FreeText{});
}

template <class V>
void members(V&& v, Is<LineCall> auto& m) {
  v(DRIPLINE_MEMBER(number), Positive{});
  v(DRIPLINE_MEMBER(action));
  v(DRIPLINE_MEMBER(argument), FreeText{});
  v(DRIPLINE_MEMBER(reply), FreeText{});
}

template <class V>
void members(V&& v, Is<LineTransfer> auto& m) {
  v(DRIPLINE_MEMBER(id), Identifier{});
  v(DRIPLINE_MEMBER(programs), FreeText{});
  v(DRIPLINE_MEMBER(size));
  v(DRIPLINE_MEMBER(sent));
  v(DRIPLINE_MEMBER(state));
  v(DRIPLINE_MEMBER(reason), FreeText{});
}

template <class V>
void members(V&& v, Is<LineAsked> auto& m) {
  v(DRIPLINE_MEMBER_AS(since, since_us));
  v(DRIPLINE_MEMBER(program), FreeText{});
  v(DRIPLINE_MEMBER(answer), FreeText{});
}

template <class V>
void members(V&& v, Is<LineStatus> auto& m) {
  v(DRIPLINE_MEMBER(address));
  v(DRIPLINE_MEMBER_AS(line_template, template_name));
  v(DRIPLINE_MEMBER(settings), FreeText{});
  v(DRIPLINE_MEMBER(is_open));
  v(DRIPLINE_MEMBER(fault), FreeText{});
  v(DRIPLINE_MEMBER(phase));
  v(DRIPLINE_MEMBER(is_stopped));
  v(DRIPLINE_MEMBER(is_stopping));
  v(DRIPLINE_MEMBER(waits_without_limit));
  v(DRIPLINE_MEMBER(waiting_for), FreeText{});
  v(DRIPLINE_MEMBER(characters_sent));
  v(DRIPLINE_MEMBER(characters_received));
  v(DRIPLINE_MEMBER(buffered_bytes));
  v(DRIPLINE_MEMBER(upload), PresentIf{DRIPLINE_FIELD(has_upload)});
  v(DRIPLINE_MEMBER(call), PresentIf{DRIPLINE_FIELD(has_call)});
  v(DRIPLINE_MEMBER(transfer), PresentIf{DRIPLINE_FIELD(has_transfer)});
  v(DRIPLINE_MEMBER(asked), PresentIf{DRIPLINE_FIELD(has_asked)});
  v(DRIPLINE_MEMBER_AS(waiting_since, waiting_since_us), ExpiryTime{});
  v(DRIPLINE_MEMBER(recorded));
}

/// Its members lie among those of the Status in the IDL.
template <class V>
void members(V&& v, Is<Screen> auto& m) {
  v(DRIPLINE_MEMBER_AS(is_inch, screen_is_inch), InchOrMetric{});
  v(DRIPLINE_MEMBER_AS(position, screen_position));
  v(DRIPLINE_MEMBER(previous_block), FreeText{});
  v(DRIPLINE_MEMBER(block), FreeText{});
  v(DRIPLINE_MEMBER(next_block), FreeText{});
  v(DRIPLINE_MEMBER(further_block), FreeText{});
}

/// Likewise.
template <class V>
void members(V&& v, Is<JogStatus> auto& m) {
  v(DRIPLINE_MEMBER_AS(step, jog_step));
  v(DRIPLINE_MEMBER_AS(feed, jog_feed));
  v(DRIPLINE_MEMBER_AS(is_moving, jog_is_moving));
  v(DRIPLINE_MEMBER_AS(refusal, jog_refusal), FreeText{});
}

template <class V>
void members(V&& v, Is<Status> auto& m) {
  v(DRIPLINE_MEMBER(machine), MachineName{}, Internal{});
  v(DRIPLINE_MEMBER_AS(time, time_us));
  v(DRIPLINE_MEMBER(execution));
  v(DRIPLINE_MEMBER(mode));
  v(DRIPLINE_MEMBER(run), Word{});
  v(DRIPLINE_MEMBER(program));
  v(DRIPLINE_MEMBER(sent));
  v(DRIPLINE_MEMBER(accepted));
  v(DRIPLINE_MEMBER(executed));
  v(DRIPLINE_MEMBER(total_bytes));
  v(DRIPLINE_MEMBER(offset));
  v(DRIPLINE_MEMBER(line));
  v(DRIPLINE_MEMBER_AS(sequence, sequence_number), NoneIfNegative{});
  v(DRIPLINE_MEMBER(position));
  v(DRIPLINE_MEMBER(feed_mm_per_min));
  v(DRIPLINE_MEMBER(spindle_rpm));
  v(DRIPLINE_MEMBER(feed_override));
  v(DRIPLINE_MEMBER(rapid_override));
  v(DRIPLINE_MEMBER(spindle_override));
  v(DRIPLINE_MEMBER(buffered_seconds));
  v(DRIPLINE_MEMBER(single_block));
  v(DRIPLINE_MEMBER(message), FreeText{});
  v(DRIPLINE_MEMBER(outbox));
  v(DRIPLINE_MEMBER(axes), Internal{});
  v(DRIPLINE_MEMBER(session), Internal{});
  v(DRIPLINE_MEMBER(modes), PresentIf{DRIPLINE_FIELD(modes.is_present)});
  v(DRIPLINE_MEMBER(coordinates), PresentIf{DRIPLINE_FIELD(coordinates.is_present)});
  v(DRIPLINE_MEMBER(emergency_stop));
  v(DRIPLINE_MEMBER_AS(steady, steady_us), Internal{});
  v(DRIPLINE_MEMBER(remote_enable));
  v(DRIPLINE_MEMBER(waits_for));
  v(DRIPLINE_MEMBER(serial_line), PresentIf{DRIPLINE_FIELD(serial_line.is_present)}, Internal{});
  v(Member{"screen", m.screen, "", WholeSample{}}, PresentIf{DRIPLINE_FIELD(has_screen)});
  v(Member{"switches", m.switches, "", WholeSample{}}, PresentIf{DRIPLINE_FIELD(has_switches)});
  v(Member{"jog", m.jog, "", WholeSample{}}, PresentIf{DRIPLINE_FIELD(has_jog)});
}

template <class V>
void members(V&& v, Is<Record> auto& m) {
  v(DRIPLINE_MEMBER(machine), MachineName{});
  v(DRIPLINE_MEMBER(epoch), Epoch{});
  v(DRIPLINE_MEMBER(number), Positive{});
  v(DRIPLINE_MEMBER_AS(time, time_us));
  v(DRIPLINE_MEMBER(run), Word{});
  v(DRIPLINE_MEMBER(kind));
  v(DRIPLINE_MEMBER(block));
  v(DRIPLINE_MEMBER(line));
  v(DRIPLINE_MEMBER_AS(sequence, sequence_number), NoneIfNegative{});
  v(DRIPLINE_MEMBER(device), Word{});
  v(DRIPLINE_MEMBER(text), RecordText{});
}

template <class V>
void members(V&& v, Is<RecordAck> auto& m) {
  v(DRIPLINE_MEMBER(machine), MachineName{});
  v(DRIPLINE_MEMBER(epoch));
  v(DRIPLINE_MEMBER(number));
  v(DRIPLINE_MEMBER(term), Internal{});
}

template <class V>
void members(V&& v, Is<Command> auto& m) {
  v(DRIPLINE_MEMBER(machine), MachineName{});
  v(DRIPLINE_MEMBER(id), Identifier{});
  v(DRIPLINE_MEMBER_AS(expires, expires_us));
  v(DRIPLINE_MEMBER(action));
  v(DRIPLINE_MEMBER(run), Word{});
  v(DRIPLINE_MEMBER(program), ProgramName{});
  v(DRIPLINE_MEMBER(revision), Sha256{});
  v(DRIPLINE_MEMBER(size));
  v(DRIPLINE_MEMBER(control), Word{});
  v(DRIPLINE_MEMBER(argument));
  v(DRIPLINE_MEMBER(value));
  v(DRIPLINE_MEMBER(session));
  v(DRIPLINE_MEMBER(setup), SetupText{});
  v(DRIPLINE_MEMBER(server));
  v(DRIPLINE_MEMBER(number));
  v(DRIPLINE_MEMBER_AS(deadline, deadline_us));
  v(DRIPLINE_MEMBER(term), Internal{});
  v(DRIPLINE_MEMBER_AS(given, given_us));
}

template <class V>
void members(V&& v, Is<CommandResult> auto& m) {
  v(DRIPLINE_MEMBER(machine), MachineName{});
  v(DRIPLINE_MEMBER(id), Identifier{});
  v(DRIPLINE_MEMBER(accepted));
  v(DRIPLINE_MEMBER(reason), FreeText{});
  v(DRIPLINE_MEMBER(values), SetupText{});
}

template <class V>
void members(V&& v, Is<BlockRequest> auto& m) {
  v(DRIPLINE_MEMBER(machine), MachineName{});
  v(DRIPLINE_MEMBER(session));
  v(DRIPLINE_MEMBER(run), Identifier{});
  v(DRIPLINE_MEMBER(program), ProgramName{});
  v(DRIPLINE_MEMBER(offset));
  v(DRIPLINE_MEMBER(length), RequestLength{});
}

template <class V>
void members(V&& v, Is<BlockData> auto& m) {
  v(DRIPLINE_MEMBER(machine), MachineName{});
  v(DRIPLINE_MEMBER(session));
  v(DRIPLINE_MEMBER(run), Identifier{});
  v(DRIPLINE_MEMBER(program), ProgramName{});
  v(DRIPLINE_MEMBER(status));
  v(DRIPLINE_MEMBER(offset));
  v(DRIPLINE_MEMBER(total_bytes));
  v(DRIPLINE_MEMBER(ends));
  v(DRIPLINE_MEMBER(bytes), CheckedBy{DRIPLINE_FIELD(crc)});
  v(DRIPLINE_MEMBER(reason), FreeText{});
  v(DRIPLINE_MEMBER(content), Sha256{});
  v(DRIPLINE_MEMBER(term), Internal{});
}

template <class V>
void members(V&& v, Is<LineRequest> auto& m) {
  v(DRIPLINE_MEMBER(machine), MachineName{});
  v(DRIPLINE_MEMBER(session));
  v(DRIPLINE_MEMBER(id), Identifier{});
  v(DRIPLINE_MEMBER(action));
  v(DRIPLINE_MEMBER(name));
  v(DRIPLINE_MEMBER(number));
  v(DRIPLINE_MEMBER(text), SetupText{});
  v(DRIPLINE_MEMBER(bytes), CheckedBy{DRIPLINE_FIELD(crc)});
  v(DRIPLINE_MEMBER(term), Internal{});
}

template <class V>
void members(V&& v, Is<LineData> auto& m) {
  v(DRIPLINE_MEMBER(machine), MachineName{});
  v(DRIPLINE_MEMBER(session));
  v(DRIPLINE_MEMBER(id), Identifier{});
  v(DRIPLINE_MEMBER(status));
  v(DRIPLINE_MEMBER(next));
  v(DRIPLINE_MEMBER(ends));
  v(DRIPLINE_MEMBER(bytes), CheckedBy{DRIPLINE_FIELD(crc)});
  v(DRIPLINE_MEMBER(reason), FreeText{});
}

#undef DRIPLINE_FIELD
#undef DRIPLINE_MEMBER
#undef DRIPLINE_MEMBER_AS

}  // namespace dripline::dds
