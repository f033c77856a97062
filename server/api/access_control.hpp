#pragma once

#include <optional>

#include "server/api/response.hpp"
#include "server/api/route_permissions.hpp"
#include "server/api/router.hpp"
#include "server/identity/accounts.hpp"
#include "server/library/history/run_history.hpp"
#include "server/machines/machine_control.hpp"
#include "server/ports/port_control.hpp"

namespace dripline::api {

/// Judges requests by the table of route_permissions. Any thread.
class AccessControl {
 public:
  struct Parts {
    identity::Accounts& accounts;
    library::RunHistory& runs;
    const machines::MachineControl& machines;
    ports::PortControl* ports = nullptr;
    bool has_tls = false;
  };
  explicit AccessControl(const Parts& parts) : parts_(parts) {}

  /// By the head alone, without waiting: credential, role, and the machine that the path names.
  /// `route` null: there is none, which only callers learn. nullopt: it may continue, and the
  /// caller is set in the request. Else 401, 403, or 413 (a sign-in with a large body).
  std::optional<Response> judge(Request& head, const Router::Route* route) const;
  /// When the body is there: the machine that the request acts on, also one that the store has to
  /// be asked for. nullopt: the handler may run.
  std::optional<Response> judge_machine(const Request& request, const RoutePermission& row) const;

  /// The header field that a changing request with a cookie must have, any value: a form or a
  /// script of another site cannot send it.
  static constexpr const char* kPageHeader = "x-dripline";
  static constexpr std::uint64_t kMaxSignIn = 4096;  ///< bytes of a body, before anybody is known

 private:
  std::optional<Response> judge_stranger(const Request& head) const;
  Response refuse(const Request& request, std::string_view route, std::string reason) const;
  std::optional<Response> judge_caller(const Request& head, const RoutePermission& row) const;
  std::optional<std::string> machine_of(const Request& request, MachineIn where) const;

  Parts parts_;
};

/// 403, for a caller who is known and may not.
Response forbidden(std::string reason);

/// The machine that reports the run as its own now, else the one that the store has for it: a stop
/// need not wait for the store. nullopt: there is no such run.
std::optional<std::string> machine_of_run(const machines::MachineControl& machines,
                                          library::RunHistory& runs, const std::string& id);

}  // namespace dripline::api
