#include "server/api/access_control.hpp"

#include <algorithm>

#include "server/api/bodies/run_bodies.hpp"

namespace dripline::api {
namespace {

constexpr int kForbidden = 403;
constexpr int kTooLarge = 413;

bool is_changing(const Request& request) {
  return request.method != "GET" && request.method != "HEAD";
}

/// Both distinguish it from another site's page that sends our cookie along.
bool is_from_our_page(const Request& request) {
  const std::string site = request.header("sec-fetch-site");
  return !request.header(AccessControl::kPageHeader).empty() &&
         (site.empty() || site == "same-origin" || site == "none");
}

/// A browser adds a certificate to the requests of any site's page. Browsers say where a request
/// comes from, programs do not.
bool is_from_other_page(const Request& request) {
  const bool is_browser =
      !request.header("sec-fetch-site").empty() || !request.header("origin").empty();
  return is_browser && !is_from_our_page(request);
}

Response unauthorized() {
  Response response = error_response(
      {Errc::Denied, "send a token that is valid here (Authorization: Bearer TOKEN), or sign in"});
  response.headers.emplace_back("WWW-Authenticate", "Bearer");
  return response;
}

}  // namespace

Response forbidden(std::string reason) {
  return error_response(kForbidden, {Errc::Denied, std::move(reason)});
}

Response AccessControl::refuse(const Request& request, std::string_view route,
                               std::string reason) const {
  parts_.accounts.refusals().note({.who = request.who,
                                   .action = "access.refused",
                                   .subject = fmt::format("{} {}", request.method, route),
                                   .detail = reason});
  return forbidden(std::move(reason));
}

/// Of a request that may come from anybody and has a body: that is small, and of stated size.
std::optional<Response> AccessControl::judge_stranger(const Request& head) const {
  if (!is_changing(head)) return std::nullopt;
  const auto length = parse_unsigned(head.header("content-length"));
  if (length && *length <= kMaxSignIn) return std::nullopt;
  return error_response(
      kTooLarge, {Errc::LimitExceeded,
                  fmt::format("a request without a token states the length of its body, at most {} "
                              "bytes",
                              kMaxSignIn)});
}

std::optional<Response> AccessControl::judge(Request& head, const Router::Route* route) const {
  const RoutePermission* const row = route == nullptr ? nullptr : route->permission;
  if (row != nullptr && row->permission == identity::Permission::Open) return judge_stranger(head);
  const auto presented = identity::read_presented(
      head.header("authorization"), head.header("cookie"), identity::cookie_name(parts_.has_tls));
  using From = identity::PresentedSecret::From;
  // A secret that is sent is what is to be judged.
  const bool is_by_certificate = presented.from == From::Nothing && head.certificate;
  auto caller = is_by_certificate ? parts_.accounts.find(*head.certificate, head.address)
                                  : parts_.accounts.find(presented, head.address);
  if (!caller && is_by_certificate) {
    parts_.accounts.refusals().note(
        {.who = {"", "certificate " + head.certificate->serial, head.address},
         .action = "access.refused",
         .subject = "a certificate that is not valid",
         .detail = row == nullptr ? "" : fmt::format("{} {}", row->method, row->pattern)});
    return unauthorized();
  }
  if (!caller) {
    parts_.accounts.refusals().note(
        {.who = {"", "", head.address},
         .action = "access.refused",
         .subject = presented.from == From::Nothing ? "no token" : "a token that is not valid",
         .detail = row == nullptr ? "" : fmt::format("{} {}", row->method, row->pattern)});
    return unauthorized();
  }
  head.who = caller->actor();
  head.caller = std::move(caller);
  if (row == nullptr) return std::nullopt;
  return judge_caller(head, *row);
}

std::optional<Response> AccessControl::judge_caller(const Request& head,
                                                    const RoutePermission& row) const {
  const identity::Caller& caller = *head.caller;
  if (caller.kind == identity::CredentialKind::Page && is_changing(head) &&
      !is_from_our_page(head)) {
    return refuse(
        head, row.pattern,
        "a request with a cookie that changes something comes from this server's page and "
        "has the header field X-Dripline");
  }
  if (!caller.certificate.empty() && is_changing(head) && is_from_other_page(head)) {
    return refuse(head, row.pattern,
                  "a browser's request with a certificate that changes something comes from this "
                  "server's page and has the header field X-Dripline");
  }
  const auto lowest = identity::lowest_role(row.permission);
  if (lowest && caller.role < *lowest) {
    return refuse(head, row.pattern,
                  fmt::format("{} has the role {}: this needs {}", caller.user,
                              storage::to_string(caller.role), storage::to_string(*lowest)));
  }
  return std::nullopt;
}

std::optional<std::string> machine_of_run(const machines::MachineControl& machines,
                                          library::RunHistory& runs, const std::string& id) {
  if (auto reporting = machines.machine_of_run(id)) return reporting;
  const auto run = runs.run(id);
  return run ? std::optional(run->machine) : std::nullopt;
}

/// nullopt: the request names none that exists, and the handler refuses it.
std::optional<std::string> AccessControl::machine_of(const Request& request,
                                                     MachineIn where) const {
  switch (where) {
    case MachineIn::Nowhere:
      return std::nullopt;
    case MachineIn::Name:
      return request.parameter("name");
    case MachineIn::Run:
      return machine_of_run(parts_.machines, parts_.runs, request.parameter("id"));
    case MachineIn::Start: {
      const auto start = decode_start(request.body);
      return start ? std::optional(start->machine) : std::nullopt;
    }
    case MachineIn::Port: {
      if (parts_.ports == nullptr) return std::nullopt;
      const auto port = parts_.ports->port(request.parameter("name"));
      return port ? std::optional(port->port.machine) : std::nullopt;
    }
    case MachineIn::Subject:
      if (request.parameter("scope") != "machine") return std::nullopt;
      return request.parameter("subject");
  }
  return std::nullopt;
}

std::optional<Response> AccessControl::judge_machine(const Request& request,
                                                     const RoutePermission& row) const {
  const auto machine = machine_of(request, row.machine);
  if (!machine || parts_.accounts.may_act_on(*request.caller, *machine)) return std::nullopt;
  return refuse(request, row.pattern,
                fmt::format("{} has no group with machine {}", request.caller->user, *machine));
}

}  // namespace dripline::api
