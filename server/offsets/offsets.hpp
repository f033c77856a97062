#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <set>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "server/library/setups.hpp"
#include "server/offsets/offset_history.hpp"
#include "server/offsets/proposal.hpp"
#include "server/offsets/setup_value.hpp"
#include "storage/store.hpp"

namespace dripline::offsets {

/// What a rule gives now.
struct Evaluation {
  OffsetRule rule;
  std::string unit;         ///< mm or in: the setup's
  double value = 0;         ///< in force
  std::uint64_t since = 0;  ///< the first setup under which it counts; 0: there is no setup
  Outcome outcome;
  std::vector<Deviation> measured;                  ///< under it
  std::optional<storage::OffsetProposal> proposal;  ///< pending, or applied at once
};

/// Turns measurements into corrections of setups: proposed with their reasons, decided by a person
/// or within the policy of the rule, applied as the setup's next version. Any thread; all of it
/// must outlive the object.
class Offsets {
 public:
  struct Parts {
    const storage::Store& store;
    library::Setups& setups;
    const Clock& clock;
    std::function<void(const storage::OffsetProposal&)> on_change = {};  ///< proposed or decided
  };
  explicit Offsets(Parts parts) : parts_(std::move(parts)) {}
  ~Offsets();
  Offsets(const Offsets&) = delete;
  Offsets& operator=(const Offsets&) = delete;

  /// Looks at all machines with rules once, then at those that are noted.
  void begin();
  /// Looks at nothing more.
  void end();
  /// Something was measured on the machine. Never waits.
  void note(const std::string& machine);

  /// Pending proposals of rules that are gone are withdrawn. Errors: those of parse_offset_rules
  /// and the store; NotFound (the machine), Unsupported (the machine's control has no such value),
  /// Conflict (the machine's setup has not what a rule corrects; two rules would correct the same
  /// by one characteristic).
  Result<storage::OffsetRules> save_rules(const std::string& machine, const std::string& text,
                                          const storage::Actor& who);
  /// Evaluates all rules of the machine and keeps what follows. Errors: those of the store; a
  /// machine without rules has none.
  Result<std::vector<Evaluation>> look(const std::string& machine);

  /// As it is then, with the setup that it became. Errors: NotFound, Conflict (decided already;
  /// another setup is the newest; its rule is gone or allows it no more; its measurements are not
  /// the current ones, then it is superseded; the control's memory is not the setup's, or a run is
  /// changing it), Unsupported (the setup's layout), those of the
  /// control, LimitExceeded (the comment).
  Result<storage::OffsetProposal> approve(const storage::OffsetDecision& decision);
  /// Errors: NotFound, Conflict, Syntax (no reason), LimitExceeded (the comment).
  Result<storage::OffsetProposal> reject(storage::OffsetDecision decision);

  OffsetHistory history() const { return OffsetHistory(parts_.store); }
  storage::OffsetStore& stored() { return parts_.store.offsets; }

  static constexpr std::size_t kMaxComment = 512;

 private:
  struct Current;
  Result<Current> current_of(const std::string& machine);
  Result<OffsetRule> rule_of(const storage::OffsetProposal& proposal);
  Result<void> check_measured(const Current& now, const OffsetRule& rule,
                              const storage::OffsetProposal& proposal);
  Result<Evaluation> measured(const Current& now, const OffsetRule& rule);
  Result<void> withdraw_of_gone(const std::string& machine, const std::vector<OffsetRule>& rules);
  Result<std::string> doubt_of(const Current& now, const OffsetRule& rule, double value);
  static Result<std::string> what_form_lacks(const Current& now, const std::string& text);
  static std::string what_is_not_loaded(const Current& now);
  static Result<void> check_rules(const Current& now, const std::vector<OffsetRule>& rules);
  Result<Evaluation> evaluate(const Current& now, const OffsetRule& rule);
  Result<void> keep(const Current& now, Evaluation& evaluation);
  void publish(const storage::OffsetProposal& proposal);
  void work(const std::stop_token& stop);

  Parts parts_;
  std::mutex look_mutex_;  ///< one evaluation at a time
  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::set<std::string> noted_;
  std::jthread worker_;  // last: it uses the others
};

}  // namespace dripline::offsets
