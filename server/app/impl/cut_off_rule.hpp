#pragma once

#include <chrono>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "protocol/base/clock.hpp"
#include "storage/opened_store.hpp"

namespace dripline::app {

/// Whether the active server hands its library over because it hears no gateway any more and a
/// server that waits does. Only steady time counts. Not again before some time has passed, which
/// doubles each time, and not at all where the last such hand-over has helped nothing: two servers
/// do not swap for ever. One thread; pure but for what it was given before.
class CutOffRule {
 public:
  struct Options {
    std::chrono::milliseconds silence{4000};  ///< of all gateways; 0: only people hand over
    std::chrono::milliseconds lease{2000};    ///< after which a gateway is not heard any more
    storage::OwnHandOvers before = {};        ///< as kept, when this server took the library
    SteadyTime began{};                       ///< that time
  };
  /// What this server sees.
  struct Look {
    SteadyTime now;
    std::size_t heard = 0;         ///< gateways
    bool is_machine_known = true;  ///< the library has a machine with a gateway
  };
  enum class Step {
    Nothing,
    Keep,      ///< `kept` has changed
    HandOver,  ///< now
  };
  struct Judgment {
    Step step = Step::Nothing;
    std::string finding = {};  ///< for any client; empty: all is well
    std::string reason = {};   ///< why it stays, the same text as long as it does
  };

  explicit CutOffRule(const Options& options) : options_(options), kept_(options.before) {}
  /// Those that wait, as the store has them now.
  void note(const std::vector<storage::WaitingServer>& waiting, SteadyTime now);
  Judgment judge(const Look& look);
  /// To be kept for all servers.
  const storage::OwnHandOvers& kept() const { return kept_; }
  storage::OwnHandOvers after_hand_over() const { return {kept_.count + 1, false}; }

  static constexpr std::chrono::seconds kFirstPause{60}, kMaxPause{3600};
  /// A server that has just begun has heard no gateway yet; those of a shop are there by then.
  static constexpr std::chrono::seconds kFirstSilence{10};
  /// A row that has not changed for so long is of a server that does not look any more.
  static constexpr std::chrono::milliseconds kFresh{5000};
  /// Nothing is handed over to one whose row, written each second, has not changed for so long.
  static constexpr std::chrono::milliseconds kAwake{1500};
  /// More gateways at a server that waits for so long are no matter of a moment.
  static constexpr std::chrono::seconds kPartialFor{10};

 private:
  struct Standby {
    UtcTime seen;
    std::optional<SteadyTime> changed;  ///< nullopt: seen once
    std::size_t gateways = 0;
  };
  std::size_t heard_elsewhere(SteadyTime now, std::chrono::milliseconds within) const;
  std::chrono::seconds pause() const;
  bool is_silent_for_long(SteadyTime now) const;
  Judgment judge_hearing(const Look& look, std::size_t elsewhere);
  Judgment judge_silence(const Look& look, std::size_t elsewhere);
  std::string reason_to_stay(const Look& look) const;

  const Options options_;
  storage::OwnHandOvers kept_;
  std::map<std::string, Standby> standbys_;  ///< by description
  std::optional<SteadyTime> heard_since_;    ///< without a pause
  std::optional<SteadyTime> silent_since_;   ///< likewise
  std::optional<SteadyTime> partial_since_;  ///< likewise
  bool has_heard_ = false;
};

}  // namespace dripline::app
