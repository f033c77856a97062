#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "server/library/releases.hpp"
#include "storage/store.hpp"

namespace dripline::library {

/// What has happened to the queue of a machine. A run of a job is the run's event.
struct JobChange {
  enum class Kind : std::uint8_t { Added, Moved, Removed, Held, Released };
  Kind kind = Kind::Added;
  std::string machine;
  std::optional<storage::Job> job = {};       ///< added, moved, removed: as it is now
  std::optional<storage::JobHold> hold = {};  ///< held
};
std::string_view to_string(JobChange::Kind kind);  ///< added, moved, removed, held, released

/// The job queues of machines. Nothing here starts a run: an operator takes a job, with his rights
/// and by a usual start. Any thread.
class JobQueue {
 public:
  struct Parts {
    const storage::Store& store;
    Releases& releases;
    const Clock& clock;
    /// Called after the commit, must return soon.
    std::function<void(const JobChange&)> on_change = {};
  };
  explicit JobQueue(Parts parts) : parts_(std::move(parts)) {}

  struct Queue {
    std::vector<storage::Job> jobs;
    std::optional<storage::JobHold> hold;
  };
  /// Open jobs in their order; otherwise what is done or removed, newest first. Errors: NotFound
  /// (the machine).
  Result<Queue> list(const std::string& machine, bool is_open, storage::Page page) const;

  struct Addition {
    storage::Job job;
    std::optional<std::uint64_t> place = {};  ///< 1: the first; absent: at the end
    storage::Role role = storage::Role::Viewer;
  };
  /// Only what the machine may run now. Errors: those of Releases::admit and JobStore::add,
  /// Unsupported (it is for another control), LimitExceeded (numbers, the comment).
  Result<storage::Job> add(Addition addition, const storage::Actor& who);
  /// Errors: those of JobStore, NotFound (it is another machine's).
  Result<storage::Job> move(const std::string& machine, std::uint64_t job, std::uint64_t place,
                            const storage::Actor& who);
  Result<void> remove(const std::string& machine, std::uint64_t job, const storage::Actor& who);
  /// Stops the queue of a machine: no run of its jobs begins until it is released. What runs goes
  /// on. By anyone with a reason: an operator, a measurement out of its tolerance. Errors:
  /// NotFound (the machine), Syntax (no reason), LimitExceeded (its length), those of the store.
  Result<void> hold(const std::string& machine, const std::string& reason,
                    const storage::Actor& who);
  Result<void> release(const std::string& machine, const storage::Actor& who);

  /// What is to be started: that job, or the next one. Errors: NotFound (none waits, or it is
  /// another machine's), Conflict (the queue is held; it is done or removed).
  Result<storage::Job> take(const std::string& machine, std::optional<std::uint64_t> job) const;

  static constexpr std::uint64_t kMaxQuantity = 1'000'000;
  static constexpr std::uint64_t kMaxPartsPerRun = 10'000;
  static constexpr std::size_t kMaxText = 1024;  ///< a comment, a reason

 private:
  Result<storage::Job> own(const std::string& machine, std::uint64_t job) const;
  Result<void> check_fits(const Addition& addition) const;
  void notify(JobChange change) const;

  const Parts parts_;
};

/// What an operator gets who asks for the next job: for the API and for requests from controls.
Result<storage::Job> take_job(storage::JobStore& jobs, const std::string& machine,
                              std::optional<std::uint64_t> job);

}  // namespace dripline::library
