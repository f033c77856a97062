#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/base/clock.hpp"
#include "protocol/base/digest.hpp"
#include "protocol/base/result.hpp"
#include "storage/page.hpp"
#include "storage/programs/revision_state.hpp"

namespace dripline::storage {

enum class RunState : std::uint8_t {
  Ordered,  ///< the gateway has not confirmed yet
  Active,   ///< also while held or waiting, which the machine's status shows
  Completed,
  Aborted,
  Alarmed,
  Interrupted,  ///< cut off; `executed` is the block executed last
  Refused,      ///< the gateway refused it, or did not answer in time
  Tested,       ///< a test run that found nothing: nothing moved, no part was made
};
std::string_view to_string(RunState state);
Result<RunState> parse_run_state(std::string_view text);
inline bool is_finished(RunState state) {
  return state != RunState::Ordered && state != RunState::Active;
}

/// Three counters, never one.
struct Counters {
  std::uint64_t sent = 0;      ///< bytes delivered to the gateway
  std::uint64_t accepted = 0;  ///< blocks interpreted
  std::uint64_t executed = 0;  ///< blocks finished by the machine
};

/// Of the blocks that a run has executed.
struct RunStatistics {
  double motion_seconds = 0;  ///< of moves and dwells, by the machine's time
  double path_mm = 0;
  friend bool operator==(const RunStatistics&, const RunStatistics&) = default;
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
  /// SHA-256 that the gateway reports of the bytes it received.
  std::optional<std::string> executed_content;
  std::optional<bool> content_verified;  ///< those bytes are the revision's; absent: not compared
  std::string author;
  UtcTime created;
  std::optional<UtcTime> started, ended;
  std::uint64_t outputs = 0;           ///< stored report lines
  std::optional<std::uint64_t> setup;  ///< the machine's setup it was started with
  RunAllowance allowed_as = RunAllowance::Open;
  std::optional<std::uint64_t> approval = {};  ///< the Decision that released its revision
  std::optional<std::uint64_t> job = {};       ///< of the machine's queue
  /// SHA-256 of the gateway's own setup file, as it reported at the start; absent: none, or
  /// unknown.
  std::optional<std::string> gateway_setup = {};
  std::optional<RunStatistics> statistics = {};  ///< absent: not ended, cut off, an older gateway
  std::uint64_t number = 0;  ///< in the order in which runs are stored; 0: it is not yet
  bool is_test = false;  ///< ordered as a test run, which moves nothing; false before version 23
};

/// A revision that a run's program called: its machine got text of it under this name.
struct RunCall {
  static constexpr std::size_t kMax = 128;  ///< of one run

  std::string name;  ///< as the program calls it
  std::string program;
  std::uint64_t revision = 0;
  Digest content;
  friend bool operator==(const RunCall&, const RunCall&) = default;
};

struct RunFilter {
  std::optional<std::string> machine, program;
  std::optional<RunState> state;
  std::optional<std::uint64_t> setup = {};  ///< only runs that were started with this setup
  bool with_outputs = false;                ///< only runs that have stored report lines
};

/// What a machine reports of an active run.
struct RunProgress {
  std::string machine, run;
  Counters counters;
  std::uint64_t line = 0;
  std::int64_t sequence = -1;
};

/// Promises of every store: storage/store.hpp.
class RunStore {
 public:
  virtual ~RunStore() = default;

  /// Errors: Busy (the machine has an unfinished run; named), NotFound (machine or revision),
  /// Conflict (the content is not the revision's, the revision is held, was withdrawn, or is not
  /// released although the run is allowed as one that is; what its approval pins was withdrawn; its
  /// job is another one's, done, removed or held; or the id was used before).
  virtual Result<void> create(const Run& run) = 0;
  /// Errors: NotFound.
  virtual Result<Run> find(const std::string& id) = 0;
  /// Newest first.
  virtual Result<std::vector<Run>> list(const RunFilter& filter, Page page) = 0;
  /// The number of runs that `list` names.
  virtual Result<std::uint64_t> count(const RunFilter& filter) = 0;
  /// Ordered to Active, or either to a final state; the state it has changes nothing. A final state
  /// is never left. Errors: NotFound, Conflict.
  virtual Result<void> set_state(const std::string& id, RunState state,
                                 const std::string& reason) = 0;
  /// Never goes backwards, never changes the state; ignored for runs that have ended. Survives a
  /// kill of the process; a power cut may take the last ones. Errors: NotFound, Conflict (the run
  /// is another machine's).
  virtual Result<void> update_counters(const RunProgress& progress) = 0;
  /// Each as by `update_counters`, with one result each, in one transaction.
  virtual std::vector<Result<void>> update_all_counters(
      const std::vector<RunProgress>& progresses) {
    std::vector<Result<void>> updated;
    for (const RunProgress& progress : progresses) updated.push_back(update_counters(progress));
    return updated;
  }
  /// On disk when it returns; the same call again changes nothing. Errors: NotFound, Conflict (the
  /// run has ended, or the name stands for another revision in it), LimitExceeded (RunCall::kMax).
  virtual Result<void> add_call(const std::string& run, const RunCall& call) = 0;
  /// By name. An unknown run has none.
  virtual Result<std::vector<RunCall>> calls(const std::string& run) = 0;
};

}  // namespace dripline::storage
