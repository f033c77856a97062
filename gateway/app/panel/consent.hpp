#pragma once

#include <optional>
#include <string_view>

#include "gateway/machine/operator_panel.hpp"
#include "protocol/base/clock.hpp"
#include "protocol/dds/message.hpp"

namespace dripline::gateway {

/// Whether a command from the network can let the machine move, continue or move faster, with the
/// panel as it is. A stop or a lower speed needs no consent. A start needs none here: it is
/// accepted and waits (Consent::await).
bool needs_consent(const dds::Command& command, const machine::OperatorPanel& panel);

/// The consent of the operator at the machine. An unattended machine needs none; at any other the
/// remote enable must have been given at its panel, else a run waits there for cycle start.
class Consent {
 public:
  explicit Consent(bool is_unattended) : is_unattended_(is_unattended) {}

  bool is_unattended() const { return is_unattended_; }
  bool is_given() const { return is_unattended_ || is_enabled_; }
  /// The remote enable, at the panel.
  void set_enabled(bool is_enabled) { is_enabled_ = is_enabled; }

  /// A run was begun: without consent it waits for cycle start, until `deadline`.
  void await(SteadyTime deadline) {
    deadline_ = is_given() ? std::nullopt : std::optional(deadline);
  }
  /// A restart: even an unattended machine waits for it to be confirmed.
  void await_confirmation(SteadyTime deadline) { deadline_ = deadline; }
  bool is_awaited() const { return deadline_.has_value(); }
  bool is_overdue(SteadyTime now) const { return deadline_ && now >= *deadline_; }
  /// Cycle start was given, or the run is over.
  void end_wait() { deadline_.reset(); }

 private:
  bool is_unattended_;
  bool is_enabled_ = false;
  std::optional<SteadyTime> deadline_;
};

inline constexpr std::string_view kNoConsent =
    "the machine's operator has not given the remote enable: it is done at the machine's panel";
inline constexpr std::string_view kAwaitsCycleStart = "waiting for cycle start at the machine";

}  // namespace dripline::gateway
