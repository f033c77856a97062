#pragma once

#include <optional>
#include <string>

#include "protocol/base/clock.hpp"
#include "server/ports/line_types.hpp"
#include "storage/audit_store.hpp"

namespace dripline::ports {

/// Whom the audit trail names for what an operator requests at a control.
inline constexpr const char* kRequestAuthor = "request from the control";

/// The program that this machine's control was offered last, where nothing shows that it got all of
/// it; nullopt: there is none. Errors: those of the store.
Result<std::optional<std::string>> broken_offer(storage::AuditStore& audit,
                                                const std::string& machine);

/// Programs that a machine's control is offered without a run. They are in the audit trail, with
/// their ends, so that the server that takes over or begins next knows what was broken off: a
/// control in the middle of it asks for the rest as it asks for any program. One thread.
class OfferTrail {
 public:
  OfferTrail(storage::AuditStore& audit, const Clock& clock, std::string machine)
      : audit_(&audit), clock_(&clock), machine_(std::move(machine)) {}

  /// Before anything of it leaves. Errors: those of the store.
  Result<void> begin(const std::string& job, const std::string& program);
  /// Of any job; nothing happens when it is not the one that was begun.
  void end(const SendEnd& end);
  /// As broken_offer, which is asked for what was before this object.
  Result<std::optional<std::string>> broken();
  /// The control knows that it was broken off, or has got another program since.
  void close(const std::string& why);

 private:
  Result<void> note(const char* action, const std::string& detail) const;

  storage::AuditStore* audit_;
  const Clock* clock_;
  std::string machine_;
  std::string job_, program_;  ///< on the line
  bool has_looked_ = false;
  std::optional<std::string> broken_;
};

}  // namespace dripline::ports
