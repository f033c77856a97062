#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "gateway/report/progress.hpp"
#include "protocol/base/result.hpp"
#include "protocol/dds/message.hpp"
#include "storage/sqlite/database.hpp"

namespace dripline::report {

/// One thing that the machine's control keeps when a program is over; a vacant one is NaN.
struct KeptCell {
  double value = 0;
  double base = 0;        ///< what the setup gave it, under which the value came to be
  bool is_named = false;  ///< the setup gave it as a variable
  friend bool operator==(const KeptCell& a, const KeptCell& b);
};
using KeptCells = std::map<std::string, KeptCell>;
/// Two vacant ones are the same.
bool is_same_number(double a, double b);

struct OutboxOptions {
  std::uint64_t max_bytes = 4ULL << 30;  ///< of the file; more is refused as a full disk is
};

/// What this gateway must not forget: records that the server has not acknowledged, the run it is
/// busy with, and how it answered orders. Changes are staged in memory and written by `commit` in
/// one transaction that survives a power cut; until then nobody sees them. A commit that fails
/// changes nothing and keeps what was staged, so it can be tried again. One thread.
class Outbox {
 public:
  /// Creates the file with a new epoch when there is none. Errors: Io, Corrupt, Unsupported.
  static Result<Outbox> open(const std::filesystem::path& file, const OutboxOptions& options = {});

  /// Random, 1 to 2^63 - 1; grows, and only when the numbers begin anew.
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
  /// Stages how far the active run has come; what was staged last is written.
  void note_progress(const Progress& progress) { progress_ = progress; }
  void add_command_result(const std::string& id, bool is_accepted, const std::string& reason);

  /// Stages what the control keeps under a name; nullopt: no longer.
  void stage_cell(const std::string& name, const std::optional<KeptCell>& cell) {
    staged_cells_[name] = cell;
  }
  /// As it was at the last commit.
  const KeptCells& memory() const { return memory_; }

  /// The memory when a run of the revision began at its first block; the last one that did.
  struct Beginning {
    std::string revision;  ///< SHA-256; empty: none, or not known
    KeptCells cells;
    friend bool operator==(const Beginning&, const Beginning&) = default;
  };
  void stage_beginning(Beginning beginning) { staged_beginning_ = std::move(beginning); }
  const Beginning& beginning() const { return beginning_; }

  /// Why the memory cannot be used: its rows are not as they were written, or it is lost with a
  /// former file. Empty: it is sound. Stays until the memory is discarded.
  const std::string& memory_fault() const { return memory_fault_; }
  /// Stages a fault, or the end of one with nothing kept.
  void stage_memory_fault(const std::string& fault) { staged_fault_ = fault; }
  void stage_no_memory();

  /// Forgets what was staged since the last commit.
  void discard();

  bool has_staged_records() const { return !staged_.empty(); }
  std::size_t staged_records() const { return staged_.size(); }
  /// Errors: Io ("disk full" among them), Busy, Corrupt.
  Result<void> commit();

  /// The run that was active at the last commit, and how far it was then.
  const std::optional<ActiveRun>& active_run() const { return committed_run_; }
  const Progress& committed_progress() const { return committed_progress_; }

  /// Nothing: this order was never answered.
  struct Answer {
    bool is_accepted = false;
    std::string reason;
  };
  Result<std::optional<Answer>> command_result(const std::string& id);

  /// Committed records after `number`, in order.
  Result<std::vector<dds::Record>> read(const std::string& machine, std::uint64_t number,
                                        std::size_t limit);
  /// The server has everything up to `number` on disk. Forgotten with the next commit or flush.
  void acknowledge(std::uint64_t number);
  /// Deletes what was acknowledged. Only saves space: a lost flush does no harm.
  Result<void> flush();
  /// The server's numbers and ours do not fit together any more (one side was restored from a
  /// copy): what is unacknowledged is numbered anew in a new epoch.
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
  Result<void> write_cells();
  Result<void> write_beginning();
  Result<void> write_memory();
  Result<void> load_memory();
  Result<void> load_memory_state();
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
  KeptCells memory_;
  Beginning beginning_;
  std::string memory_fault_;
  std::map<std::string, std::optional<KeptCell>> staged_cells_;
  std::optional<Beginning> staged_beginning_;
  std::optional<std::string> staged_fault_;
  RunChange run_change_ = RunChange::None;
  ActiveRun staged_run_;
  Progress progress_;
};

}  // namespace dripline::report
