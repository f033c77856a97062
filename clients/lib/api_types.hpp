#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "clients/lib/account_types.hpp"
#include "clients/lib/intake_types.hpp"
#include "clients/lib/server_types.hpp"

/// The server's answers (server/api/README.md) as plain values. Words and times stay the text that
/// the server sent, so that an older client shows the words of a newer server; times are ISO 8601
/// UTC, lengths millimeters. An absent text is empty; other absent values are nullopt. Each type's
/// members are listed in impl/api_members.hpp; a test compares the lists with openapi.json.
namespace dripline::client {

/// A program's latest revision, as listings give it. Held: no revision of it is approved yet.
struct Program {
  std::string name;
  std::uint64_t revision = 0, revisions = 0, size = 0;
  std::string sha256;
  std::string title;  ///< the name in its first block
  std::string control, comment, author, created;
  bool held = false;
  std::string accepted;
  std::string state, released, withdrawn;  ///< as of a Revision
  std::uint64_t held_revisions = 0;
  std::string part, operation, material, machine_group;  ///< empty: not stated
  std::string cam_file;                                  ///< of the revision
};

struct Revision {
  std::string program;
  std::uint64_t revision = 0, size = 0;
  std::string sha256;
  std::string title;  ///< the name in its first block
  std::string control, comment, author, created;
  bool held = false;                ///< came from a machine and is pending approval
  std::string accepted;             ///< when it was approved
  std::string state;                ///< draft, in_review, approved, released, withdrawn
  std::string released, withdrawn;  ///< when; empty: never
  std::string cam_file;             ///< where its bytes come from
  bool unchanged = false;  ///< answer to a commit: the latest revision already had this content
};

/// A file beside a program.
struct Attachment {
  std::string program;
  std::optional<std::uint64_t> revision;  ///< absent: it belongs to the program
  std::string name;
  std::uint64_t size = 0;
  std::string sha256, comment, author, created;
};

/// A revision that a search found.
struct SearchHit {
  Revision revision;
  std::string part, operation, material, machine_group;
  std::optional<std::uint64_t> line;  ///< with most of the words; absent: they are in its fields
  std::string text;                   ///< of that line
  bool partly_indexed = false;        ///< only the beginning of its text is found
};
struct SearchResult {
  std::vector<SearchHit> hits;
  std::optional<std::uint64_t> next;  ///< `before` of the next page
  std::uint64_t to_be_indexed = 0;    ///< programs that are not found yet, or as they were
};

/// A revision that a release pins.
struct Pin {
  std::string program;
  std::uint64_t revision = 0;
  std::string sha256;
};

/// What was decided about a revision.
struct Decision {
  std::uint64_t id = 0;
  std::string step, state, time, who, comment;
  std::optional<std::vector<Pin>> closure;  ///< of a release: all that its program may call
  std::string text, signature;              ///< what is signed, and by whom: Ed25519
};
struct RevisionStates {
  std::string state;
  std::vector<Decision> steps;
  std::string public_key;
};

/// A program with all that it calls.
struct Closure {
  struct Site {
    std::string program;
    std::uint64_t revision = 0, line = 0;
  };
  struct Call {
    std::string name;  ///< as the control names it
    std::string program;
    std::uint64_t revision = 0;
    std::string sha256, state;
    std::optional<Site> site;  ///< absent: it was named in the request
  };
  struct Missing {
    std::string name;
    Site site;
  };
  std::string program;
  std::uint64_t revision = 0;
  std::vector<Call> calls;
  std::vector<Missing> missing;
  std::vector<Site> computed;  ///< calls whose program a run computes
};

/// What a machine sent, and what became of it.
struct Import {
  struct Target {
    std::string program;
    std::uint64_t revision = 0;
  };
  std::string program;
  std::uint64_t revision = 0;
  std::string machine, control;
  std::uint64_t size = 0;
  std::string sha256, comment, received, state;
  std::string edit;  ///< class of the edit; empty: not known
  std::optional<std::uint64_t> base;
  std::string fault, compared, decided, who, reason;
  bool at_once = false;
  std::optional<Target> accepted_as;  ///< absent: under its own name, or not
};

struct ProgramHistory {
  Program program;
  std::vector<Revision> revisions;
};

struct Upload {
  std::string id, program;
  std::uint64_t received = 0;
  std::uint64_t max_piece = 0;
};

/// The modal state that a control's status window shows; millimeters.
struct ActiveModes {
  std::string motion, compensation, units;
  bool incremental = false;
  std::string feed_unit;
  double feed = 0;  ///< programmed, in its unit
  bool feed_limited = false;
  std::optional<std::int64_t> tool, next_tool, tool_offset;
  double tool_length_x = 0, tool_length_z = 0, tool_radius = 0;
  std::string work_system, cycle;
  double dwell_seconds = 0;
  bool surface_speed = false;
  double spindle_speed = 0;  ///< programmed: 1/min, or mm per minute
  std::optional<double> spindle_load;
  bool flood = false, mist = false;
  std::string tool_axis;  ///< its letter; empty: programs do not choose it
  std::string spindle;    ///< "off", "clockwise", ...; empty: unknown
};

/// How program coordinates lie on the machine; by axis letter, millimeters and degrees.
struct ProgramFrame {
  std::map<std::string, double> position, target;  ///< program coordinates
  std::map<std::string, double> datum, shift;
  double rotation = 0, basic_rotation = 0;
  std::map<std::string, double> scale;
  std::vector<std::string> mirrored;
  std::optional<std::map<std::string, double>> pole;
};

/// The values of a control's position display, along the machine's axes.
struct Coordinates {
  std::map<std::string, double> target;  ///< the end of the current move
  std::map<std::string, double> distance_to_go;
  /// The following error; absent: not measured.
  std::optional<std::map<std::string, double>> following_error = {};
  /// Absent without a run, or when its control reports none.
  std::optional<ProgramFrame> program = {};
};

struct MachineStatus {
  std::string time, execution, mode, run, program;
  std::uint64_t sent = 0, accepted = 0, executed = 0, total_bytes = 0, offset = 0;
  std::optional<std::uint64_t> line;
  std::optional<std::int64_t> sequence;
  std::map<std::string, double> position;  ///< by axis letter
  double feed_mm_per_min = 0, spindle_rpm = 0;
  double feed_override = 1, rapid_override = 1, spindle_override = 1;  ///< 1 = 100 %
  double buffered_seconds = 0;
  bool single_block = false;
  std::string message;
  std::uint64_t outbox = 0;
  std::optional<ActiveModes> modes;
  std::optional<Coordinates> coordinates;
  bool emergency_stop = false;  ///< pressed
  std::string remote_enable, waits_for;
};

/// What a control's own position display shows. Values of the API are millimeters and radii.
struct Display {
  std::string units = "mm";  ///< or inch
  std::string x = "radius";  ///< or diameter
};

/// How a run can begin on a machine's control.
struct Starts {
  std::vector<std::string> at;  ///< what a start can name: block, line, byte, tool, count
  bool head = false, memory = false, pass = false;
};

/// Who holds a machine or its job queue, and why.
struct Hold {
  std::string who, reason;  ///< reason empty: none was given
  std::string run;          ///< of a machine; empty: of none
  std::string since;
};

struct Machine {
  std::string name, control, description, gateway_version;
  bool connected = false;
  /// How far the gateway's clock is ahead of the server's; negative: it is late.
  std::optional<double> clock_ahead_seconds;
  /// What is wrong between server and gateway.
  std::vector<std::string> notices;
  std::string first_seen, last_seen;
  std::optional<Hold> held = {};        ///< absent: nothing is known to hold it
  std::optional<Hold> queue_hold = {};  ///< absent: its queue is not held
  std::optional<Display> display = {};  ///< absent: the control is not known
  std::optional<Starts> starts = {};    ///< absent: an older server
  std::optional<MachineStatus> status;
};

struct Run {
  std::string id, machine, program;
  std::uint64_t revision = 0;
  std::string sha256;
  std::uint64_t size = 0;
  std::string control, state;
  std::uint64_t sent = 0, accepted = 0, executed = 0;
  std::optional<std::uint64_t> line;
  std::optional<std::int64_t> sequence;
  std::string reason;
  std::optional<bool> content_verified;
  std::string author, created, started, ended;
  std::uint64_t outputs = 0;
  std::optional<std::uint64_t> setup;     ///< the machine's setup it was started with
  std::string allowed_as;                 ///< open, released, prove_out
  std::optional<std::uint64_t> approval;  ///< the Decision that released its revision
  std::optional<std::uint64_t> job;       ///< of the machine's queue
};

/// A run that is asked for by itself.
struct ShownRun {
  Run run;
  std::optional<Hold> held = {};  ///< absent: nothing is known to hold it
  /// Its measured parts by verdict.
  struct Parts {
    std::uint64_t good = 0, unknown = 0, rework = 0, scrap = 0;
    std::uint64_t archived = 0;         ///< of them, those in archives alone
    std::vector<std::string> archives;  ///< their files
    std::uint64_t all() const { return good + unknown + rework + scrap; }
  };
  std::optional<Parts> parts = {};  ///< absent: a server that measures nothing
};

/// The tools, offsets and parameters that a machine's control has before a program starts.
struct Setup {
  std::string machine;
  std::uint64_t revision = 0, size = 0;
  std::string sha256, comment, author, created;
  std::string text;        ///< TOML; empty in listings
  bool unchanged = false;  ///< answer to saving: the newest setup already had this text
};

/// Which setup is in a control at the end of a line, by the word of who loaded it.
struct LoadedSetup {
  std::string machine;
  std::optional<std::uint64_t> revision;  ///< absent: not known
  std::string who, time;
};

/// One value that a control retains after the end of a program.
struct MemoryCell {
  std::string name;
  std::optional<double> value;  ///< nullopt: vacant
  std::optional<double> setup;  ///< its value in the setup
};
struct Memory {
  std::string machine, run;
  std::string program;  ///< empty: the run was started at the machine
  std::string time;
  std::vector<MemoryCell> cells;
};

struct Record {
  std::string machine;
  std::uint64_t epoch = 0, number = 0;
  std::string time, run, kind;
  std::optional<std::uint64_t> block, line;
  std::optional<std::int64_t> sequence;
  std::string device, text;
};

struct Report {
  std::string run, machine, program;
  std::uint64_t revision = 0;
  std::string state;
  std::uint64_t lines = 0;
  std::string started, ended;
};

/// The lines that a machine printed outside any run.
struct MachineReport {
  std::string machine;
  std::uint64_t lines = 0;
  std::string first, last;
};

/// Key and value as text.
using Settings = std::map<std::string, std::string>;

/// Programs sent without a run.
struct Transfer {
  std::string id;
  std::vector<std::string> programs;
  std::uint64_t size = 0, sent = 0;
  std::string state;  ///< sending, completed, aborted, interrupted
  std::string reason;
};

struct Port {
  std::string name, machine, address, line_template;
  Settings settings;  ///< its own; they override those of its template
  std::string rules;
  bool enabled = true;
  Settings effective;
  bool open = false;
  std::string fault;
  struct Line {
    std::string phase;
    bool stopped = false, stopping = false;
    std::string waiting_for;
    bool without_limit = false;
  } line;
  std::string run;
  std::optional<Transfer> transfer;  ///< the latest
  std::uint64_t sent = 0, received = 0;
  std::string waiting_since;
  /// The control's latest request that came while no run waited.
  struct Request {
    std::string since, program, answer;
  };
  std::optional<Request> request;
};

/// One event of a line: `sent` and `received` have bytes, the other kinds have text.
struct Traffic {
  std::string port, time, what;
  std::string bytes;  ///< hexadecimal
  std::string text;
};

struct PortTest {
  bool passed = false;
  std::vector<std::string> findings;
};

struct RuleVerdict {
  std::string rule, action, argument;
  std::vector<std::string> why;
};

struct PortTemplate {
  std::string name, title, control;
  Settings settings;
};
struct PortSetting {
  std::string key, type, text, preset;
};
struct PortTemplates {
  std::vector<PortTemplate> templates;
  std::vector<PortSetting> settings;  ///< all settings of a port
};

}  // namespace dripline::client
