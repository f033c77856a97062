#include <nlohmann/json.hpp>

#include "server/api/access_control.hpp"
#include "server/api/api.hpp"
#include "server/api/bodies.hpp"
#include "server/api/nullable_json.hpp"
#include "server/api/views.hpp"

namespace dripline::api {
namespace {

using nlohmann::json;
using storage::RevisionStep;

json state_names(const std::set<storage::RevisionState>& states) {
  json names = json::array();
  for (const auto state : states) names.push_back(storage::to_string(state));
  return names;
}

json policy_json(const library::Releases& releases) {
  const library::ReleasePolicy& policy = releases.policy();
  json steps = json::object();
  for (std::size_t i = 0; i < storage::kRevisionSteps; ++i) {
    const auto step = static_cast<RevisionStep>(i);
    const library::StepRule& rule = policy.rule(step);
    steps[std::string(storage::to_string(step))] = {{"from", state_names(rule.from)},
                                                    {"role", storage::to_string(rule.role)},
                                                    {"four_eyes", rule.needs_four_eyes},
                                                    {"comment", rule.needs_comment}};
  }
  return {{"runs", policy.runs_released_only ? "release" : "open"},
          {"prove_out",
           {{"machines", policy.prove_out_machines},
            {"role", storage::to_string(policy.prove_out_role)}}},
          {"steps", std::move(steps)},
          {"imports", {{"accept_at_once", policy.accept_at_once}}},
          {"sha256", policy.digest.hex()},
          {"public_key", releases.public_key().hex()}};
}

json decision_json(const library::Releases& releases, const storage::Decision& decision) {
  return {{"id", decision.id},
          {"step", storage::to_string(decision.step)},
          {"state", storage::to_string(storage::state_after(decision.step))},
          {"time", to_iso8601(decision.time)},
          {"who", decision.who.name},
          {"comment", text_or_null(decision.comment)},
          {"text", releases.text_of(decision)},
          {"signature", decision.signature.hex()}};
}

Response show_policy(Services& services, const Request& request) {
  QueryReader query(request);
  if (auto good = query.finish(); !good) return error_response(good.error());
  return json_response(200, policy_json(services.releases));
}

Response show_states(Services& services, const Request& request) {
  const auto number = revision_number(request);
  if (!number) return error_response(number.error());
  const auto revision = services.programs.revision(request.parameter("name"), *number);
  if (!revision) return error_response(revision.error());
  const auto decisions = services.releases.decisions(revision->program, revision->number);
  if (!decisions) return error_response(decisions.error());
  json steps = json::array();
  for (const auto& decision : *decisions)
    steps.push_back(decision_json(services.releases, decision));
  return json_response(200, {{"state", storage::to_string(revision->state)},
                             {"steps", std::move(steps)},
                             {"public_key", services.releases.public_key().hex()}});
}

Response decide(Services& services, const Request& request, RevisionStep step) {
  const auto number = revision_number(request);
  if (!number) return error_response(number.error());
  const auto comment = decode_decision(request.body);
  if (!comment) return error_response(comment.error());
  const auto decided = services.releases.decide({.program = request.parameter("name"),
                                                 .revision = *number,
                                                 .step = step,
                                                 .comment = *comment,
                                                 .who = request.who,
                                                 .role = request.caller->role});
  if (decided) {
    return json_response(200, revision_json(*decided, services.programs.title(*decided)));
  }
  if (decided.error().code != Errc::Denied) return error_response(decided.error());
  services.accounts.refusals().note(
      {.who = request.who,
       .action = "access.refused",
       .subject = fmt::format("{} {} revision {}", storage::to_string(step),
                              request.parameter("name"), *number),
       .detail = decided.error().what});
  return forbidden(decided.error().what);
}

/// What came from a machine and waits for acceptance is hidden; what is in review or approved goes
/// back to draft.
Response reject(Services& services, const Request& request) {
  const auto number = revision_number(request);
  if (!number) return error_response(number.error());
  const auto revision = services.programs.revision(request.parameter("name"), *number);
  if (!revision) return error_response(revision.error());
  if (!revision->is_held && revision->state != storage::RevisionState::Draft)
    return decide(services, request, RevisionStep::Reject);
  const auto comment = decode_decision(request.body);
  if (!comment) return error_response(comment.error());
  if (services.imports == nullptr || !revision->is_held || comment->empty())
    return empty_response(
        services.programs.reject(revision->program, revision->number, request.who));
  const auto rejected = services.imports->decide({.program = revision->program,
                                                  .revision = revision->number,
                                                  .state = storage::ImportState::Rejected,
                                                  .who = request.who,
                                                  .reason = *comment});
  return rejected ? no_content() : error_response(rejected.error());
}

}  // namespace

void add_release_routes(Router& router, Services& services) {
  const std::string revision = "/api/v1/programs/{name}/revisions/{number}/";
  router.add("GET", "/api/v1/release-policy", with(services, show_policy));
  router.add("GET", revision + "states", with(services, show_states));
  router.add("POST", revision + "reject", with(services, reject));
  for (const auto step : {RevisionStep::Submit, RevisionStep::Approve, RevisionStep::Release,
                          RevisionStep::Withdraw}) {
    router.add(
        "POST", revision + std::string(storage::to_string(step)),
        [&services, step](const Request& request) { return decide(services, request, step); });
  }
}

}  // namespace dripline::api
