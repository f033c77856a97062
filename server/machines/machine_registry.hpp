#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "protocol/base/clock.hpp"
#include "protocol/dds/message.hpp"
#include "server/machines/command_dispatcher.hpp"
#include "server/machines/machine_control.hpp"
#include "server/machines/worker_pool.hpp"

namespace dripline::machines {

/// How the clocks of one gateway compare with the server's, from the statuses it writes at least
/// once a second. A status is delayed in transit, so each comparison shows the gateway's clock at
/// most as far ahead as it is; the largest of the last ones is the best. Not thread-safe.
class GatewayClocks {
 public:
  static constexpr std::chrono::microseconds kTolerance{1'000'000};

  /// Another gateway took over: nothing is known of its clocks.
  void reset() { *this = {}; }
  void compare(const dds::Status& status, UtcTime now, SteadyTime steady_now);

  /// How far its steady clock is ahead of the server's, never overestimated.
  std::optional<std::chrono::microseconds> steady_ahead() const { return steady_ahead_; }
  /// How far its time of day is ahead of the server's; negative: after. None before kSamples
  /// comparisons.
  std::optional<std::chrono::microseconds> time_ahead() const;

 private:
  static constexpr std::size_t kSamples = 4;
  std::array<std::chrono::microseconds, kSamples> time_ahead_{};
  std::size_t count_ = 0;
  std::optional<std::chrono::microseconds> steady_ahead_;
};

/// What is known of every machine now. Status lives in memory only; its counters go to the run at
/// most every kSaveInterval. A machine is added when it announces itself for the first time; it is
/// shown, and its listener called, from when it is stored: whatever refers to it can be stored
/// then.
class MachineRegistry {
 public:
  static constexpr std::chrono::seconds kSaveInterval{2};
  /// A machine stays contested this long after the last status of a second gateway; each writes one
  /// a second.
  static constexpr std::chrono::seconds kContested{3};
  /// A gateway writes a status each second; after this time without one what is shown is old.
  static constexpr std::chrono::seconds kStale{5};
  /// So often what keeps them from arriving is tried to be got around.
  static constexpr std::chrono::seconds kRenewal{10};
  /// What only moves on (positions, counters) is published in rounds, so often at most; what else
  /// changes goes out at once.
  static constexpr std::chrono::milliseconds kShortestRound{50}, kLongestRound{200};
  /// A round is a millisecond longer for so many machines: a thousand are published five times a
  /// second.
  static constexpr std::size_t kMachinesAMillisecond = 5;

  struct Parts {
    storage::MachineStore& machines;
    storage::RunStore& runs;
    const Clock& clock;
    WorkerPool& pool;
    std::function<void(const MachineView&)> on_change;  ///< on a worker, latest state only
  };
  explicit MachineRegistry(Parts parts) : parts_(std::move(parts)) {}

  /// Reads the stored machines; called first.
  Result<void> load();

  /// These come from DDS threads and return at once.
  void on_announce(const dds::Announce& announce);
  void on_status(dds::Status status);
  void on_lost(const std::string& machine);
  /// Another gateway of the same name waits for the present one to leave, or waits no longer.
  void on_rival(const std::string& machine, bool is_there);
  /// Whether a gateway may become the machine's, which has none. While a run may be in progress
  /// (the server `has_run` of it, or the last status shows one) only the same one may, by the epoch
  /// of its records; any other one when it is confirmed.
  bool may_serve(const dds::Announce& announce, bool has_run);
  /// Promises: MachineControl::confirm_gateway.
  Result<std::string> confirm_gateway(const std::string& machine);

  /// Those that are stored.
  std::vector<MachineView> views() const;
  std::vector<MachineView> views(const MachinePage& page) const;
  /// Errors: NotFound (also of a machine that is not stored yet).
  Result<MachineView> view(const std::string& name) const;
  /// Promises: MachineControl::remove.
  Result<void> remove(const std::string& name, const storage::Actor& who);
  /// The same without the store: every machine that has announced itself. For its records, and for
  /// commands, which stop a machine whatever the database does.
  std::vector<MachineView> announced() const;
  Result<MachineView> announced(const std::string& name) const;
  /// The present gateway of the machine, and its steady clock.
  CommandDispatcher::Options::Gateway gateway(const std::string& name) const;
  /// How far the gateway's time of day is ahead of the server's; zero while that is within the
  /// tolerance.
  std::chrono::microseconds clock_error(const std::string& name) const;
  /// Marks the machines whose status has become old, and publishes that. Returns those of which
  /// another try is due to get any.
  std::vector<std::string> note_silence();
  /// Saves what changed: counters of runs, and when a machine was seen last. From a worker.
  void save();

 private:
  struct Entry {
    MachineView view;
    std::deque<std::uint64_t> earlier_sessions;  ///< of gateways before, the newest kMaxSessions
    SteadyTime contested_until{};
    std::uint64_t unconfirmed_epoch = 0, confirmed_epoch = 0;  ///< of gateways; 0: none
    SteadyTime heard{};     ///< its last status, or its announcement if that was later
    SteadyTime renewal{};   ///< when it is tried next to get a status
    bool is_stale = false;  ///< and the log has it
    bool has_rival = false;
    GatewayClocks clocks;
    bool clock_is_off = false;  ///< and the log has it
    bool is_scheduled = false;  ///< a change is about to be published
    bool is_in_round = false;   ///< it waits for the next round
    bool is_telling = false;
    bool machine_is_dirty = false;  ///< the stored part changed
    bool is_stored = false;         ///< until it is removed
    bool is_saving = false;
    bool is_removed = false;  ///< until it announces itself
    bool counters_are_dirty = false;
  };
  static bool is_announced(const Entry& entry);
  static Result<void> check_removable(const Entry& entry);
  static bool is_shown(const Entry& entry);
  std::vector<MachineView> views_of(bool (*is_wanted)(const Entry&)) const;
  Result<MachineView> view_of(const std::string& name, bool (*is_wanted)(const Entry&)) const;
  static std::string still_switches(const dds::Status& status);
  static void note_lost_switches(MachineView& view);
  void hear(Entry& entry, std::uint64_t session);
  void contest(Entry& entry);
  static bool is_repeated(const Entry& entry, const dds::Status& status);
  /// True: none had arrived for long.
  bool note_status(Entry& entry);
  bool is_silent(const Entry& entry) const;
  void compare_clocks(Entry& entry, const dds::Status& status);
  MachineView shown(const Entry& entry) const;
  void publish(Entry& entry);
  void schedule(Entry& entry);
  void schedule_in_round(Entry& entry);
  void publish_round();
  std::chrono::milliseconds round() const;
  /// True: for the first time.
  bool save_machine(Entry& entry);

  Parts parts_;
  mutable std::mutex mutex_;
  std::map<std::string, Entry> entries_;  ///< what is removed keeps its entry
  std::vector<Entry*> round_;             ///< not empty: a round is due
};

/// Whether `now` differs from `before` in more than what moves on while a program runs: positions,
/// counters, speeds. Alarms, prompts and stops do.
bool is_news(const dds::Status& before, const dds::Status& now);

/// Faults between the server and this machine's gateway, in sentences for people; empty when there
/// is none. Without what the machine itself reports.
std::vector<std::string> notices_of(const MachineView& view);

/// "no status of the gateway has arrived since ..."; empty while they do.
std::string silence_notice(const MachineView& view);

/// That another gateway claims to be a machine with a run, and is not taken; empty: none does.
std::string stranger_notice(const MachineView& view);

/// That a restart of its gateway has switched off what kept the machine from moving; empty:
/// nothing.
std::string switch_notice(const MachineView& view);

/// Why a machine whose gateway has this protocol version takes no command but a stop; empty when
/// the version is the server's.
std::string protocol_notice(std::uint32_t protocol);

/// "the gateway's clock is 3600.0 s ahead of the server's"; empty while they agree.
std::string clock_notice(std::chrono::microseconds ahead);

}  // namespace dripline::machines
