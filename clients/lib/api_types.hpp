#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "clients/lib/account_types.hpp"
#include "clients/lib/intake_types.hpp"
#include "clients/lib/machine_types.hpp"
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

/// Of the blocks that a run has executed, as controls show it of a program that is fed.
struct RunStatistics {
  double motion_seconds = 0;  ///< of moves and dwells, by the machine's time
  double distance_mm = 0;
  /// Absent where they would divide by nothing.
  std::optional<double> average_feed_mm_per_min = {}, average_block_seconds = {},
                        blocks_per_second = {};
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
  std::optional<std::uint64_t> setup;            ///< the machine's setup it was started with
  std::string allowed_as;                        ///< open, released, prove_out
  std::optional<std::uint64_t> approval;         ///< the Decision that released its revision
  std::optional<std::uint64_t> job;              ///< of the machine's queue
  std::optional<RunStatistics> statistics = {};  ///< absent: not ended, not known, an older server
  bool test = false;                             ///< nothing of it moves
};

/// A run that has just begun.
struct BegunRun {
  Run run;
  /// That it is a test run; of what was keyed in, that it has begun without the modes and the tool
  /// before. Empty: nothing.
  std::string notice;
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
/// Set by an operator from the machine's position.
struct MemoryChange {
  std::string what, who;
};

struct Memory {
  std::string machine, run;
  std::optional<MemoryChange> change;  ///< none: `run` has left it
  std::string program;                 ///< empty: the run was started at the machine
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
  std::uint64_t at_most = 0;  ///< bytes that may have passed the line
  std::string state;          ///< sending, receiving, completed, aborted, interrupted
  std::string reason;
  std::string began, ended;
};

struct Port {
  std::string name, machine, address, line_template;
  Settings settings;  ///< its own; they override those of its template
  std::string rules;
  bool enabled = true;
  Settings effective;
  bool sends_at_once = false;  ///< the control does not ask for its programs
  bool open = false;
  std::string fault;
  struct Line {
    std::string phase;
    bool stopped = false, stopping = false;
    std::string waiting_for;
    bool without_limit = false;
  } line;
  std::string run;
  std::optional<Transfer> transfer;   ///< the latest
  std::optional<Transfer> reception;  ///< the latest program that came
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
