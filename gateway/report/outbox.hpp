#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "gateway/report/checkpoint_store.hpp"
#include "gateway/report/kept_memory.hpp"
#include "gateway/report/progress.hpp"
#include "protocol/base/result.hpp"
#include "protocol/dds/message.hpp"
#include "storage/sqlite/database.hpp"

namespace dripline::report {

struct OutboxOptions {
  std::uint64_t max_bytes = 4ULL << 30;  ///< of the file; more is refused as a full disk is
};

/// What this gateway must not lose: records that the server has not acknowledged, the active run,
/// the answers to commands, the control's memory and what restarts need. Changes are staged in
/// memory and written by `commit` in one transaction that survives a power cut; until then they are
/// not in force. A commit that fails changes nothing and keeps what was staged, so it can be tried
/// again. One thread.
class Outbox {
 public:
  /// Creates the file with a new epoch when there is none. Errors: Io, Corrupt, Unsupported.
  static Result<Outbox> open(const std::filesystem::path& file, const OutboxOptions& options = {});

  /// Random, 1 to 2^63 - 1; grows, and only when the numbers begin again.
  std::uint64_t epoch() const { return epoch_; }
  /// Of the last committed record.
  std::uint64_t last_number() const { return last_number_; }
  std::uint64_t acknowledged() const { return acknowledged_; }
  std::uint64_t unacknowledged() const { return last_number_ - acknowledged_; }

  /// Stages a record; its epoch and number are set here.
  void append(dds::Record record);
  /// Stages the beginning of a run, to be found by `active_run` after a restart.
  void begin_run(const ActiveRun& run);
  /// Stages its end. To be committed together with its RunEnded record: so a run ends once.
  void end_run();
  /// Stages the progress of the active run; the last one is written.
  void note_progress(const Progress& progress) { progress_ = progress; }
  void add_command_result(const std::string& id, bool is_accepted, const std::string& reason);

  /// What the control keeps; staged and committed together with the rest.
  KeptMemory& memory() { return memory_; }
  const KeptMemory& memory() const { return memory_; }
  /// What restarts need; likewise.
  CheckpointStore& checkpoints() { return checkpoints_; }
  /// For what the checkpoint store reads.
  storage::sqlite::Database& database() { return database_; }

  /// Drops what was staged since the last commit.
  void discard();

  /// Records, answers to the interpreter or a checkpoint that is awaited: the block that they
  /// belong to is not executed before they are committed.
  bool has_staged_records() const { return !staged_.empty() || checkpoints_.has_awaited(); }
  std::size_t staged_records() const { return staged_.size(); }
  /// Errors: Io ("disk full" among them), Busy, Corrupt.
  Result<void> commit();

  /// The run that was active at the last commit, and its progress then.
  const std::optional<ActiveRun>& active_run() const { return committed_run_; }
  const Progress& committed_progress() const { return committed_progress_; }

  /// Nothing: this command was never answered.
  struct Answer {
    bool is_accepted = false;
    std::string reason;
  };
  Result<std::optional<Answer>> command_result(const std::string& id);

  /// Committed records after `number`, in order.
  Result<std::vector<dds::Record>> read(const std::string& machine, std::uint64_t number,
                                        std::size_t limit);
  /// The server has everything up to `number` on disk. Deleted with the next commit or flush.
  void acknowledge(std::uint64_t number);
  /// Deletes what was acknowledged. Only saves space: a lost flush does no harm.
  Result<void> flush();
  /// The server's numbers and ours do not fit together any more (one side was restored from a
  /// copy): what is unacknowledged is renumbered in a new epoch.
  Result<void> begin_epoch();

  static constexpr std::uint64_t kKeptCommandResults = 10'000;

 private:
  explicit Outbox(storage::sqlite::Database database) : database_(std::move(database)) {}
  Result<void> load();
  Result<void> load_run();
  Result<void> create();
  Result<void> write_all();
  Result<void> write_records();
  Result<void> write_run();
  Result<void> write_command_results();
  Result<void> delete_acknowledged();

  struct StagedResult {
    std::string id;
    Answer answer;
  };
  enum class RunChange { None, Begins, Ends };

  storage::sqlite::Database database_;
  std::uint64_t epoch_ = 0, last_number_ = 0;
  std::uint64_t acknowledged_ = 0, deleted_ = 0;
  std::optional<ActiveRun> committed_run_;
  Progress committed_progress_;

  std::vector<dds::Record> staged_;
  std::vector<StagedResult> staged_results_;
  KeptMemory memory_;
  CheckpointStore checkpoints_;
  RunChange run_change_ = RunChange::None;
  ActiveRun staged_run_;
  Progress progress_;
};

}  // namespace dripline::report
