#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "storage/run_store.hpp"

namespace dripline::storage {

/// One thing a machine reported, identified forever by (machine, epoch, number). `kind` is its name
/// in the protocol.
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
  /// By the server; absent: now, or stored by an older version.
  std::optional<UtcTime> received = {};
};

/// The record after which the next piece begins.
struct RecordPlace {
  std::uint64_t epoch = 0, number = 0;
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
  std::string run;  ///< the server's, or one that was begun at the machine
  UtcTime time;     ///< at the gateway
  std::vector<std::string> texts;
};

struct RunBeginning {
  std::string run;
  UtcTime started;
  std::optional<std::string> gateway_setup = {};  ///< Run::gateway_setup
};
/// The end of a run as its record reports it; stored in the same transaction as the record.
struct RunEnding {
  std::string run;
  RunState state = RunState::Completed;
  Counters counters;
  std::uint64_t line = 0;
  std::int64_t sequence = -1;
  std::string reason;
  std::optional<std::string> executed_content;
  std::optional<bool> content_verified;
  std::optional<RunStatistics> statistics = {};
  UtcTime ended;
};

struct RecordBatch {
  std::string machine;
  std::uint64_t epoch = 0;
  std::vector<Record> records;  ///< ascending numbers
  std::vector<RunBeginning> beginnings;
  std::vector<RunEnding> endings;
};

/// Promises of every store: storage/store.hpp.
class RecordStore {
 public:
  virtual ~RecordStore() = default;

  /// Stores what is new and contiguous, in one transaction; returns the highest number stored
  /// without a gap in this epoch. Records already stored are skipped; those after a gap are left
  /// out (the gateway sends them again), and so is a beginning or ending whose record (run_started,
  /// run_ended) is left out. An ending never changes a run that has ended, and no run ends before
  /// it began. An unknown machine is added; an unknown run is no error. A record that names another
  /// machine's run is kept, changes nothing of that run and is not among its records. Errors:
  /// Syntax, LimitExceeded (epoch over 2^63).
  virtual Result<std::uint64_t> store(const RecordBatch& batch) = 0;
  /// Each as by `store`, with one result each; in one transaction where all can be stored.
  virtual std::vector<Result<std::uint64_t>> store_all(const std::vector<RecordBatch>& batches) {
    std::vector<Result<std::uint64_t>> stored;
    for (const RecordBatch& batch : batches) stored.push_back(store(batch));
    return stored;
  }
  /// In order of (epoch, number). `kind` empty: all.
  virtual Result<std::vector<Record>> of_run(const std::string& run, const std::string& kind,
                                             Page page) = 0;
  /// The same from a place on, in time that does not depend on what is before it.
  virtual Result<std::vector<Record>> of_run_after(const std::string& run, const std::string& kind,
                                                   RecordPlace after, std::uint64_t limit) = 0;
  /// All that one journal of a machine holds, from a number on.
  virtual Result<std::vector<Record>> of_machine_after(const std::string& machine,
                                                       RecordPlace after, std::uint64_t limit) = 0;
  /// What machines printed (kinds output and probe) while no run of the server was theirs, for
  /// instance from their controls' own memory. In order of their names, without those that printed
  /// nothing.
  virtual Result<std::vector<MachineReport>> machine_reports() = 0;
  /// The lines of one of them after a place, in order of (epoch, number); none of an unknown
  /// machine.
  virtual Result<std::vector<Record>> machine_report(const std::string& machine, RecordPlace after,
                                                     std::uint64_t limit) = 0;
  /// What its control kept after its runs, newest first; with `run` after this one alone.
  virtual Result<std::vector<MemoryReport>> memory_reports(const std::string& machine,
                                                           const std::optional<std::string>& run,
                                                           Page page) = 0;
  /// Of these, those of changes that an operator has set at the machine: `run` begins with
  /// `prefix`.
  virtual Result<std::vector<MemoryReport>> memory_changes(const std::string& machine,
                                                           const std::string& prefix,
                                                           Page page) = 0;
};

}  // namespace dripline::storage
