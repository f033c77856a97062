#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/base/clock.hpp"
#include "protocol/base/result.hpp"
#include "storage/actor.hpp"
#include "storage/page.hpp"

namespace dripline::storage {

enum class JobState : std::uint8_t {
  Waiting,
  Active,  ///< a run of it has not ended
  Done,    ///< the quantity was made
  Removed,
};
std::string_view to_string(JobState state);

/// Which parts count up to a job's quantity.
enum class JobCount : std::uint8_t {
  Made,  ///< those of its completed runs, whatever they measure
  Good,  ///< of these, those that all report templates find good
};
std::string_view to_string(JobCount count);  ///< made, good
/// Errors: Syntax.
Result<JobCount> parse_job_count(std::string_view text);

/// A program that a machine is to run, until so many parts are made.
struct Job {
  std::uint64_t id = 0;  ///< the store gives it
  std::string machine, program;
  std::optional<std::uint64_t> revision;  ///< absent: the latest that may run when it is started
  std::uint64_t quantity = 1;             ///< parts that are wanted
  std::uint64_t parts_per_run = 1;
  JobCount counts = JobCount::Made;
  std::string comment, author;
  UtcTime created;
  JobState state = JobState::Waiting;  ///< the store determines it
  std::uint64_t completed = 0;         ///< parts: of its completed runs
  std::uint64_t runs = 0;              ///< all of it, refused ones left out
  std::uint64_t counted = 0;           ///< up to the quantity: completed, or good
  // By what was measured, archived parts too; of `list` and `find` alone.
  std::uint64_t good = 0;               ///< of the completed ones
  std::uint64_t unknown = 0;            ///< of the completed ones: not measured, or not known
  std::uint64_t rework = 0, scrap = 0;  ///< of all its runs, those that were cut off too
};

/// Why a machine's queue starts nothing.
struct JobHold {
  std::string machine, who, reason;
  UtcTime since;
};

/// The job queues of machines. A job's parts are counted from the runs that name it (Run::job), so
/// a part counts once, whatever is killed. Every change has its audit entry (job.add ...) in its
/// transaction. Promises of every store: storage/store.hpp.
class JobStore {
 public:
  virtual ~JobStore() = default;

  /// Open: those that wait or are active, in their order. Otherwise done and removed ones, newest
  /// first. None of a machine that is not known.
  virtual Result<std::vector<Job>> list(const std::string& machine, bool is_open, Page page) = 0;
  /// Errors: NotFound.
  virtual Result<Job> find(std::uint64_t id) = 0;
  /// At the end, or at `place` (1: the first). Errors: NotFound (machine, program, revision),
  /// LimitExceeded (more than kMaxJobs are open).
  virtual Result<Job> add(const Job& job, const Actor& who, std::optional<std::uint64_t> place) = 0;
  /// To `place` among the open ones; after the last one is at the end. Errors: NotFound, Conflict
  /// (it is done or removed).
  virtual Result<Job> move(std::uint64_t id, std::uint64_t place, const Actor& who,
                           UtcTime time) = 0;
  /// Errors: NotFound, Conflict (it is done or removed), Busy (a run of it has not ended).
  virtual Result<void> remove(std::uint64_t id, const Actor& who, UtcTime time) = 0;

  /// The first one that is open; absent: there is none.
  virtual Result<std::optional<Job>> next(const std::string& machine) = 0;

  /// From now on no run of the machine's jobs begins (RunStore::create). A later hold replaces the
  /// reason. Errors: NotFound (the machine).
  virtual Result<void> hold(const JobHold& hold, const Actor& who) = 0;
  /// Errors: NotFound (it is not held).
  virtual Result<void> release(const std::string& machine, const Actor& who, UtcTime time) = 0;
  virtual Result<std::optional<JobHold>> hold_of(const std::string& machine) = 0;
  /// Of all machines that are held.
  virtual Result<std::vector<JobHold>> holds() = 0;

  static constexpr std::uint64_t kMaxJobs = 1000;
};

}  // namespace dripline::storage
