#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "protocol/base/clock.hpp"
#include "protocol/base/digest.hpp"
#include "protocol/base/result.hpp"

/// What the server keeps, in domain words. One interface, because a second implementation will
/// come; the first is SQLite (storage/sqlite_store.hpp). Every function may be called from any
/// thread; each is one transaction. When it has returned success, what it wrote is on disk. Errors
/// everywhere: Io, Busy, Corrupt (stored bytes fail their check).
namespace dripline::storage {

struct Revision {
  std::string program;       ///< name
  std::uint64_t number = 0;  ///< 1, 2, 3 ... per program
  Digest content;            ///< SHA-256 of the bytes
  std::uint64_t size = 0;
  std::string control;  ///< dialect name, or empty when not known
  std::string comment;
  std::string author;
  UtcTime created;
  bool is_held = false;             ///< came from a machine, runs nowhere until it is accepted
  std::optional<UtcTime> accepted;  ///< of one that was held

  /// Since when it may run; of a held one only when it came.
  UtcTime in_force_since() const { return accepted.value_or(created); }
};

struct ProgramSummary {
  Revision latest;              ///< of a program that has nothing but held revisions, one of these
  std::uint64_t revisions = 0;  ///< held ones included
  bool is_removed = false;
  std::uint64_t held = 0;  ///< revisions that wait for acceptance
};

/// A program that gets another name, or a copy of one.
struct ProgramMove {
  std::string from, to;
  std::string who;
};

/// An upload in progress. Survives a restart of the server; abandoned ones are dropped after a day.
struct Upload {
  std::string id;
  std::string program;
  std::string control, comment, author;
  std::uint64_t received = 0;  ///< bytes; the next piece begins here
  UtcTime created;
  bool is_held = false;  ///< it came from a machine: becomes a held revision
};

struct Machine {
  std::string name;
  std::string control;
  std::string description;
  std::string gateway_version;
  std::uint64_t epoch = 0;
  std::uint64_t last_record = 0;  ///< of this epoch, stored without a gap
  UtcTime first_seen, last_seen;
};

enum class RunState : std::uint8_t {
  Ordered,  ///< the gateway has not confirmed yet
  Active,   ///< includes held and waiting; the machine's status tells
  Completed,
  Aborted,
  Alarmed,
  Interrupted,  ///< cut off; `executed` is the block executed last
  Refused,      ///< the gateway said no, or did not answer in time
};
std::string_view to_string(RunState state);
Result<RunState> parse_run_state(std::string_view text);

/// Three counters, never one.
struct Counters {
  std::uint64_t sent = 0;      ///< bytes delivered to the gateway
  std::uint64_t accepted = 0;  ///< blocks interpreted
  std::uint64_t executed = 0;  ///< blocks finished by the machine
};

struct Run {
  std::string id;
  std::string machine;
  std::string program;
  std::uint64_t revision = 0;
  Digest content;
  std::uint64_t size = 0;
  std::string control;
  RunState state = RunState::Ordered;
  Counters counters;
  std::uint64_t line = 0;      ///< of the block executed last
  std::int64_t sequence = -1;  ///< its N number
  std::string reason;          ///< why it ended, for people
  std::optional<std::string>
      executed_content;  ///< SHA-256 the gateway reports of the bytes it really received
  std::optional<bool> content_verified;  ///< those bytes are the revision's; absent: not compared
  std::string author;
  UtcTime created;
  std::optional<UtcTime> started, ended;
  std::uint64_t outputs = 0;           ///< stored report lines
  std::optional<std::uint64_t> setup;  ///< the machine's setup it was started with
};

/// One thing a machine reported, identified for ever by (machine, epoch, number). `kind` is the
/// wire's name of it.
struct Record {
  std::string machine;
  std::uint64_t epoch = 0, number = 0;
  UtcTime time;      ///< at the gateway
  std::string run;   ///< may be empty
  std::string kind;  ///< run_started, run_ended, output, probe, message, stop, warning, alarm,
                     ///< device_opened, device_closed
  std::uint64_t block = 0, line = 0;
  std::int64_t sequence = -1;
  std::string device, text;
  std::optional<UtcTime> received =
      {};  ///< by the server; absent: now, or stored by an older version
};

/// How much a machine printed outside any run, and when.
struct MachineReport {
  std::string machine;
  std::uint64_t lines = 0;
  UtcTime first, last;
};

/// What a machine's control kept when a run was over, as its gateway reported it: records of kind
/// message from the device "memory".
struct MemoryReport {
  std::string run;  ///< ours, or one that was begun at the machine
  UtcTime time;     ///< at the gateway
  std::vector<std::string> texts;
};

/// What a record that ends a run says of it; stored in the same transaction as the record.
struct RunEnding {
  std::string run;
  RunState state = RunState::Completed;
  Counters counters;
  std::uint64_t line = 0;
  std::int64_t sequence = -1;
  std::string reason;
  std::optional<std::string> executed_content;
  std::optional<bool> content_verified;
  UtcTime ended;
};
struct RunBeginning {
  std::string run;
  UtcTime started;
};

struct RecordBatch {
  std::string machine;
  std::uint64_t epoch = 0;
  std::vector<Record> records;  ///< ascending numbers
  std::vector<RunBeginning> beginnings;
  std::vector<RunEnding> endings;
};

/// A serial line to a machine's control, as configured.
struct Port {
  std::string name;
  std::string machine;        ///< the machine at its end
  std::string address;        ///< /dev/ttyUSB0, tcp://host:port, rfc2217://host:port
  std::string line_template;  ///< a control's usual line, may be empty
  std::vector<std::pair<std::string, std::string>> settings;  ///< key, value; over the template's
  std::string rules;  ///< what a text from the control means (TOML), may be empty
  bool is_enabled = true;
};
inline constexpr std::size_t kMaxPortSettings = 64;
inline constexpr std::size_t kMaxPortRules = 32 * 1024;

/// What a machine's control knows before a program starts: tools, offsets, variables, parameters.
struct SetupRevision {
  std::string machine;
  std::uint64_t number = 0;  ///< 1, 2, 3 ... per machine
  std::string text;          ///< TOML
  Digest sha256;             ///< of the text
  std::uint64_t size = 0;    ///< of the text, bytes
  std::string comment, author;
  UtcTime created;
};
inline constexpr std::size_t kMaxSetup = 64 * 1024;

struct AuditEntry {
  UtcTime time;
  std::string who, action, subject, detail;
};

struct Page {
  std::uint64_t limit = 100;
  std::uint64_t offset = 0;
};
struct RunFilter {
  std::optional<std::string> machine, program;
  std::optional<RunState> state;
  bool with_outputs = false;  ///< only runs that have stored report lines
};

class Store {
 public:
  virtual ~Store() = default;

  // Programs: names with immutable revisions; content is addressed by its SHA-256 and stored in
  // chunks.
  /// Errors: Syntax and LimitExceeded for the name. Begins an upload.
  virtual Result<Upload> begin_upload(const Upload& upload) = 0;
  virtual Result<Upload> upload(const std::string& id) = 0;
  /// Appends at `offset`. Sending a piece again that is already there is no error. Errors:
  /// NotFound, Conflict (a gap, an overlap, or other bytes than before), LimitExceeded (a
  /// piece of more than 16 MiB).
  virtual Result<Upload> append_upload(const std::string& id, std::uint64_t offset,
                                       std::span<const std::byte> bytes) = 0;
  /// Bytes received so far, from `offset`, at most `length`; empty after the end. Errors:
  /// NotFound.
  virtual Result<std::vector<std::byte>> read_upload(const std::string& id, std::uint64_t offset,
                                                     std::uint64_t length) = 0;
  /// For uploads begun without a control, once it was detected from the text. Errors: NotFound.
  virtual Result<void> set_upload_control(const std::string& id, const std::string& control) = 0;
  /// Makes the upload a new revision of its program, or returns the latest one when it has the very
  /// same content; a held upload also the newest held one that has it. Errors: NotFound, Corrupt
  /// (the content's SHA-256 is not `expected`), Syntax (empty).
  virtual Result<Revision> commit_upload(const std::string& id,
                                         const std::optional<Digest>& expected) = 0;
  virtual Result<void> abandon_upload(const std::string& id) = 0;
  /// `passed` more time has gone by (by a steady clock; the time of day may jump). Drops those that
  /// got no piece for longer than `life` of such time; returns how many.
  virtual Result<std::uint64_t> drop_idle_uploads(std::chrono::seconds passed,
                                                  std::chrono::seconds life) = 0;

  /// In order of their names.
  virtual Result<std::vector<ProgramSummary>> programs(Page page) = 0;
  /// Newest first, held ones among them. Errors: NotFound.
  virtual Result<std::vector<Revision>> revisions(const std::string& program) = 0;
  /// The latest that is not held, or the one with that number, held or not. Errors: NotFound (also
  /// when the program was removed), Conflict (nothing but held ones), Corrupt (its row names
  /// another content than it was stored with).
  virtual Result<Revision> revision(const std::string& program,
                                    std::optional<std::uint64_t> number) = 0;
  /// Puts a held revision in force; the latest is still the one with the highest number. One in
  /// force already: nothing to do. The audit entry (program.accept, program.reject) is part of the
  /// transaction. Errors: NotFound.
  virtual Result<Revision> accept_revision(const std::string& program, std::uint64_t number,
                                           const std::string& who) = 0;
  /// Hides a held revision for ever. Errors: NotFound, Conflict (it is not held).
  virtual Result<void> reject_revision(const std::string& program, std::uint64_t number,
                                       const std::string& who) = 0;
  /// Makes a new program of the latest revision, or of the one with that number; the audit entry
  /// (program.copy) is part of the transaction. Errors: NotFound, Syntax and LimitExceeded (the new
  /// name), Conflict (it exists, or is the same; the revision is held).
  virtual Result<Revision> copy_program(const ProgramMove& move,
                                        std::optional<std::uint64_t> number) = 0;
  /// Gives a program with all its revisions, and its runs, another name; the audit entry
  /// (program.rename) is part of the transaction. Errors: as copy_program's, Busy (an unfinished
  /// run uses it, named).
  virtual Result<void> rename_program(const ProgramMove& move) = 0;
  /// Hides the program from listings and starts; runs keep their revision. A program pushed again
  /// under the name shows only its new revisions, numbered on. Errors: NotFound, Busy (an
  /// unfinished run uses it).
  virtual Result<void> remove_program(const std::string& program) = 0;
  /// Bytes of stored content from `offset`, at most `length`, never crossing more than needed of
  /// its chunks; every chunk is checked against its own SHA-256, and that it is this content's at
  /// this place, before a byte is returned. Errors: NotFound, Corrupt (the chunk is named).
  virtual Result<std::vector<std::byte>> read_content(const Digest& content, std::uint64_t offset,
                                                      std::uint64_t length) = 0;
  /// Whether the stored list of chunks is the one whose bytes were compared with `content`. Reads
  /// no bytes, but of a content that an older version stored: all, once. Errors: NotFound, Corrupt
  /// (the chunk is named).
  virtual Result<void> verify_content(const Digest& content) = 0;

  // Machines
  /// Adds or updates. `last_record` is the store's own and ignored, `first_seen` is kept. Errors:
  /// Syntax and LimitExceeded for the name.
  virtual Result<void> save_machine(const Machine& machine) = 0;
  virtual Result<Machine> machine(const std::string& name) = 0;
  virtual Result<std::vector<Machine>> machines() = 0;

  // Runs
  /// Errors: Busy (the machine has an unfinished run; named), NotFound (machine or revision),
  /// Conflict (the content is not the revision's, the revision is held, or the id was used
  /// before).
  virtual Result<void> create_run(const Run& run) = 0;
  virtual Result<Run> run(const std::string& id) = 0;
  /// Newest first.
  virtual Result<std::vector<Run>> runs(const RunFilter& filter, Page page) = 0;
  /// Ordered to Active, or either to a final state; to the state it has: nothing to do. A final
  /// state is never left. Errors: NotFound, Conflict.
  virtual Result<void> set_run_state(const std::string& id, RunState state,
                                     const std::string& reason) = 0;
  /// Progress of `machine`'s run, as that machine reports it: never goes backwards, never changes
  /// the state; ignored for runs that have ended. Survives a kill of the process; a power cut may
  /// take the last ones. Errors: NotFound, Conflict (the run is another machine's).
  virtual Result<void> update_counters(const std::string& machine, const std::string& id,
                                       const Counters& counters, std::uint64_t line,
                                       std::int64_t sequence) = 0;

  // Records
  /// Stores what is new and contiguous, in one transaction; returns the highest number stored
  /// without a gap in this epoch. Records already stored are skipped; those after a gap are left
  /// out (the gateway sends them again), and so is a beginning or ending whose record (run_started,
  /// run_ended) is left out. An ending never changes a run that has ended, and no run ends before
  /// it began. A machine not known yet is added; a run not known is no error. A record that names
  /// another machine's run is kept, changes nothing of that run and is not among its records.
  /// Errors: Syntax, LimitExceeded (epoch over 2^63).
  virtual Result<std::uint64_t> store_records(const RecordBatch& batch) = 0;
  /// In order of (epoch, number). `kind` empty: all.
  virtual Result<std::vector<Record>> records(const std::string& run, const std::string& kind,
                                              Page page) = 0;
  /// What machines printed (kinds output and probe) while no run of the server was theirs: from
  /// their controls' own memory, for instance. In order of their names; those that printed nothing
  /// are left out.
  virtual Result<std::vector<MachineReport>> machine_reports() = 0;
  /// Its lines, in order of (epoch, number). A machine not known has none.
  virtual Result<std::vector<Record>> machine_report(const std::string& machine, Page page) = 0;
  /// What its control kept after its runs, newest first; with `run` after this one alone.
  virtual Result<std::vector<MemoryReport>> memory_reports(const std::string& machine,
                                                           const std::optional<std::string>& run,
                                                           Page page) = 0;

  // Serial ports
  /// Adds or changes one. Errors: Syntax and LimitExceeded (names, settings, rules), Busy (the
  /// address is another port's, named).
  virtual Result<void> save_port(const Port& port) = 0;
  /// In order of their names.
  virtual Result<std::vector<Port>> ports() = 0;
  /// Errors: NotFound.
  virtual Result<void> remove_port(const std::string& name) = 0;

  // Setups of machines
  /// Makes `text` the machine's newest setup, or returns the newest when it has that text already.
  /// `number`, `sha256`, `size` and `created` are the store's own. `base`: the number that must
  /// still be the newest for a new text to be kept, 0 for none at all. Errors: Syntax and
  /// LimitExceeded (the machine's name, kMaxSetup), Conflict (another is the newest by now).
  virtual Result<SetupRevision> save_setup(const SetupRevision& setup,
                                           std::optional<std::uint64_t> base) = 0;
  /// Newest first, their texts left out.
  virtual Result<std::vector<SetupRevision>> setups(const std::string& machine, Page page) = 0;
  /// The newest, or the one with that number. Errors: NotFound.
  virtual Result<SetupRevision> setup(const std::string& machine,
                                      std::optional<std::uint64_t> number) = 0;

  // Audit
  virtual Result<void> audit(const AuditEntry& entry) = 0;
  /// Newest first.
  virtual Result<std::vector<AuditEntry>> audit_entries(Page page) = 0;
};

}  // namespace dripline::storage
