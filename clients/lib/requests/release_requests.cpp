// The calls of Client for the states of revisions.
#include <nlohmann/json.hpp>

#include "clients/lib/api_json.hpp"
#include "clients/lib/client.hpp"
#include "clients/lib/impl/request.hpp"

namespace dripline::client {

using impl::dumped;
using impl::get;
using impl::path_of;
using impl::with_method;

namespace {

std::string revision_path(std::string_view program, std::uint64_t revision, std::string_view rest) {
  return fmt::format("{}/revisions/{}/{}", path_of("programs", program), revision, rest);
}

std::string decision_body(const Client::DecisionRequest& request) {
  nlohmann::json body = nlohmann::json::object();
  if (!request.comment.empty()) body["comment"] = request.comment;
  if (request.has_closure) body["closure"] = true;
  if (!request.machine.empty()) body["machine"] = request.machine;
  if (!request.with.empty()) body["with"] = request.with;
  return body.empty() ? "" : dumped(body);
}

}  // namespace

Reply<Revision> Client::decide(std::string_view step, const DecisionRequest& request) {
  return fetch<Revision>(
      with_method("POST", revision_path(request.program, request.revision, step)),
      decision_body(request));
}

Reply<std::optional<Revision>> Client::reject_revision(const DecisionRequest& request) {
  constexpr int kHidden = 204;
  HttpRequest wanted =
      with_method("POST", revision_path(request.program, request.revision, "reject"));
  const std::string body = decision_body(request);
  wanted.body = body;
  auto response = exchange(wanted);
  if (!response) return failed(response.error());
  if (response->status == kHidden) return std::optional<Revision>();
  const auto json = nlohmann::json::parse(response->body, nullptr, false);
  auto revision = from_json<Revision>(json);
  if (!revision) {
    return failed(Failure::Kind::BadReply, Errc::Syntax,
                  "the answer of {} to reject is not as expected: {}", address().url,
                  revision.error().what);
  }
  return std::optional(*std::move(revision));
}

Reply<Closure> Client::closure(const ClosureQuery& query) {
  std::string path = path_of("programs", query.program) + "/closure";
  if (query.revision)
    path = impl::with_query(std::move(path), "revision", std::to_string(*query.revision));
  path = impl::with_query(std::move(path), "machine", query.machine);
  std::string with;
  for (const auto& program : query.with) with += (with.empty() ? "" : ",") + program;
  path = impl::with_query(std::move(path), "with", with);
  return fetch<Closure>(get(std::move(path)));
}

Reply<RevisionStates> Client::revision_states(std::string_view name, std::uint64_t revision) {
  return fetch<RevisionStates>(get(revision_path(name, revision, "states")));
}

}  // namespace dripline::client
