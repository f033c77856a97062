#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <thread>

#include "server/app/impl/cut_off_rule.hpp"
#include "server/library/audit_trail.hpp"
#include "server/library/health.hpp"

namespace dripline::app {

/// Looks some times a second whether this server is cut off from its gateways, on a thread of its
/// own, and hands the library over when the rule says so. What it decides is in the log and in the
/// audit trail, and why it stays in /health.
class CutOffWatch {
 public:
  struct Parts {
    storage::OpenedStore& store;
    library::Health& health;
    library::AuditTrail& audit;
    const Clock& clock;
    std::string server;                        ///< its name, for the audit trail
    std::function<std::size_t()> heard;        ///< gateways
    std::function<bool()> is_machine_known;    ///< one with a gateway
    std::function<Result<void>()> check_free;  ///< nothing would be ended or cut off
    std::function<void()> leave;               ///< hands over, soon after it has returned
  };
  CutOffWatch(Parts parts, const CutOffRule::Options& options)
      : parts_(std::move(parts)), rule_(options) {}
  /// Ends the thread.
  ~CutOffWatch() = default;
  CutOffWatch(const CutOffWatch&) = delete;
  CutOffWatch& operator=(const CutOffWatch&) = delete;

  void begin();
  /// Once, without the thread.
  void look();

  static constexpr std::chrono::milliseconds kEvery{250}, kWaitingEvery{1000};
  static constexpr const char* kSubject = "gateways";  ///< in /health

 private:
  void look_at_standbys(std::size_t heard, SteadyTime now);
  void report(const CutOffRule::Judgment& judgment);
  void note_reason();
  /// Errors: those of check_free and of the store; then it stays.
  Result<void> hand_over(const CutOffRule::Judgment& judgment);

  const Parts parts_;
  CutOffRule rule_;
  std::optional<SteadyTime> looked_at_standbys_;
  std::string finding_, reason_;             ///< as reported last
  std::map<std::string, SteadyTime> noted_;  ///< reasons, which are few
  bool has_left_ = false;
  std::jthread thread_;  // last: it uses the others
};

}  // namespace dripline::app
