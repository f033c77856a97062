#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gateway/report/progress.hpp"
#include "protocol/base/clock.hpp"
#include "protocol/base/result.hpp"
#include "storage/sqlite/database.hpp"

namespace dripline::report {

using Bytes = std::vector<std::byte>;

/// A state of the interpreter that a restart can begin with; its bytes are the application's.
struct StoredCheckpoint {
  std::uint64_t block = 0;     ///< interpreted, when it was taken
  std::uint64_t executed = 0;  ///< by the machine, at that time
  UtcTime time{};
  Bytes bytes;
};

/// A run that can be restarted.
struct StoredRun {
  ActiveRun run;
  Bytes conditions;  ///< what it is interpreted under
  Bytes ending;      ///< how far it came; empty: it has not ended
  /// The run that it continues, which is kept as long as it is; empty: none. Not read back.
  std::string restart_of = {};
};

/// Whose bytes are kept longer than others', when there is no room for all.
struct CheckpointSize {
  std::uint64_t block = 0;
  std::size_t bytes = 0;
};
/// The blocks of the checkpoints to drop, of one run's in ascending order, so that both limits are
/// kept: never the first or the newest, and first those that leave the smallest gap.
std::vector<std::uint64_t> checkpoints_to_drop(std::vector<CheckpointSize> kept,
                                               std::size_t max_count, std::size_t max_bytes);

/// What restarts need, in the tables `checkpoint_run`, `checkpoint` and `checkpoint_answer` of the
/// outbox's file: of the last kKeptRuns runs, of each at most kMaxCheckpoints states with
/// kMaxCheckpointBytes, and its last kMaxAnswers answers. Changes are staged; the outbox writes
/// them in its own transaction (`write`, then `discard` once that is committed). One thread.
class CheckpointStore {
 public:
  static constexpr std::size_t kKeptRuns = 4;
  static constexpr std::size_t kMaxCheckpoints = 48;
  static constexpr std::size_t kMaxCheckpointBytes = 16U << 20;
  static constexpr std::size_t kMaxAnswers = 4096;

  void stage_run(StoredRun run) { staged_run_ = std::move(run); }
  /// What a run that is on disk is interpreted under has changed.
  void stage_conditions(const std::string& run, Bytes conditions) {
    staged_conditions_ = {run, std::move(conditions)};
  }
  /// While a commit fails the newest few are kept, and the first. `is_awaited`: see
  /// `has_awaited`.
  void stage(const std::string& run, StoredCheckpoint checkpoint, bool is_awaited = false);
  /// What the interpreter was answered, the `number`th of its run from 1.
  void stage_answer(const std::string& run, std::uint64_t number, Bytes answer);
  void stage_ending(const std::string& run, Bytes ending) {
    staged_ending_ = {run, std::move(ending)};
  }

  bool is_staged() const {
    return staged_run_ || staged_conditions_ || staged_ending_ || !staged_.empty() ||
           !staged_answers_.empty();
  }
  /// Something of this must be on disk before the next block is executed: an answer, or a
  /// checkpoint that was staged so.
  bool has_awaited() const { return is_awaited_ || !staged_answers_.empty(); }
  /// Drops the staged checkpoints, unless one of them is awaited. The disk may have no room.
  void drop_checkpoints();
  Result<void> write(storage::sqlite::Database& database) const;
  void discard();

  // What is on disk. Errors: those of the database.
  /// Errors: also NotFound.
  static Result<StoredRun> find(storage::sqlite::Database& database, const std::string& run);
  /// In ascending order, without their bytes.
  static Result<std::vector<StoredCheckpoint>> list(storage::sqlite::Database& database,
                                                    const std::string& run);
  /// Errors: also NotFound.
  static Result<StoredCheckpoint> read(storage::sqlite::Database& database, const std::string& run,
                                       std::uint64_t block);
  struct Answer {
    std::uint64_t number = 0;
    Bytes bytes;
  };
  /// Those after `number`, in order.
  static Result<std::vector<Answer>> answers(storage::sqlite::Database& database,
                                             const std::string& run, std::uint64_t number);

 private:
  struct OfRun {
    std::string run;
    StoredCheckpoint checkpoint;
  };
  struct AnswerOfRun {
    std::string run;
    Answer answer;
  };
  struct BytesOfRun {
    std::string run;
    Bytes bytes;
  };
  Result<void> write_run(storage::sqlite::Database& database) const;
  Result<void> write_checkpoints(storage::sqlite::Database& database) const;
  Result<void> write_answers(storage::sqlite::Database& database) const;

  std::optional<StoredRun> staged_run_;
  std::vector<OfRun> staged_;
  bool is_awaited_ = false;
  std::vector<AnswerOfRun> staged_answers_;
  std::optional<BytesOfRun> staged_conditions_, staged_ending_;
};

}  // namespace dripline::report
