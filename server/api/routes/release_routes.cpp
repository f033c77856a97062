#include <algorithm>
#include <limits>

#include <nlohmann/json.hpp>

#include "server/api/access_control.hpp"
#include "server/api/api.hpp"
#include "server/api/bodies/program_bodies.hpp"
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

/// Null: the release pins nothing.
json pins_json(const storage::Decision& decision) {
  if (!decision.closure) return nullptr;
  json pins = json::array();
  for (const auto& pin : *decision.closure) {
    pins.push_back(
        {{"program", pin.program}, {"revision", pin.revision}, {"sha256", pin.content.hex()}});
  }
  return pins;
}

json decision_json(const library::Releases& releases, const storage::Decision& decision) {
  return {{"id", decision.id},
          {"step", storage::to_string(decision.step)},
          {"state", storage::to_string(storage::state_after(decision.step))},
          {"time", to_iso8601(decision.time)},
          {"who", decision.who.name},
          {"comment", text_or_null(decision.comment)},
          {"closure", pins_json(decision)},
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

Response decide(Services& services, const Request& request, library::Releases::Request wanted) {
  wanted.who = request.who;
  wanted.role = request.caller->role;
  const RevisionStep step = wanted.step;
  const auto number = std::optional(wanted.revision);
  const auto decided = services.releases.decide(wanted);
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

Response decide(Services& services, const Request& request, RevisionStep step) {
  const auto number = revision_number(request);
  if (!number) return error_response(number.error());
  const auto comment = decode_decision(request.body);
  if (!comment) return error_response(comment.error());
  return decide(services, request,
                {.program = request.parameter("name"),
                 .revision = *number,
                 .step = step,
                 .comment = *comment});
}

Response release(Services& services, const Request& request) {
  const auto number = revision_number(request);
  if (!number) return error_response(number.error());
  const auto body = decode_release(request.body);
  if (!body) return error_response(body.error());
  library::Releases::Request wanted{.program = request.parameter("name"),
                                    .revision = *number,
                                    .step = RevisionStep::Release,
                                    .comment = body->comment};
  if (body->has_closure) {
    const auto revision = services.programs.revision(wanted.program, *number);
    if (!revision) return error_response(revision.error());
    auto closure = services.releases.closure(
        {.main = *revision, .machine = body->machine, .named = body->named});
    if (!closure) return error_response(closure.error());
    wanted.closure = *std::move(closure);
  }
  return decide(services, request, std::move(wanted));
}

json site_json(const library::CallSite& site) {
  return {{"program", site.program}, {"revision", site.revision}, {"line", site.line}};
}

json closure_json(const library::Closure& closure) {
  json calls = json::array(), missing = json::array(), computed = json::array();
  for (const auto& called : closure.called) {
    calls.push_back({{"name", called.name},
                     {"program", called.revision.program},
                     {"revision", called.revision.number},
                     {"sha256", called.revision.content.hex()},
                     {"state", storage::to_string(called.revision.state)},
                     {"site", called.site ? site_json(*called.site) : json(nullptr)}});
  }
  for (const auto& call : closure.missing)
    missing.push_back({{"name", call.name}, {"site", site_json(call.site)}});
  for (const auto& site : closure.computed) computed.push_back(site_json(site));
  return {{"program", closure.main.program},
          {"revision", closure.main.number},
          {"calls", std::move(calls)},
          {"missing", std::move(missing)},
          {"computed", std::move(computed)}};
}

Response show_closure(Services& services, const Request& request) {
  QueryReader query(request);
  const auto number = query.number("revision", kMaxNumber);
  const auto machine = query.text("machine").value_or("");
  const auto with = query.text("with");
  if (auto good = query.finish(); !good) return error_response(good.error());
  const auto revision = services.programs.revision(request.parameter("name"), number);
  if (!revision) return error_response(revision.error());
  library::ClosureRequest wanted{.main = *revision, .machine = machine, .named = {}};
  for (std::size_t at = 0; with && at <= with->size();) {
    const std::size_t comma = std::min(with->find(',', at), with->size());
    auto named = parse_named_program(with->substr(at, comma - at));
    if (!named)
      return error_response({Errc::Syntax, "query parameter 'with': " + named.error().what});
    wanted.named.push_back(*std::move(named));
    at = comma + 1;
  }
  const auto closure = services.releases.closure(std::move(wanted));
  return closure ? json_response(200, closure_json(*closure)) : error_response(closure.error());
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
  router.add("POST", revision + "release", with(services, release));
  router.add("GET", "/api/v1/programs/{name}/closure", with(services, show_closure));
  for (const auto step : {RevisionStep::Submit, RevisionStep::Approve, RevisionStep::Withdraw}) {
    router.add(
        "POST", revision + std::string(storage::to_string(step)),
        [&services, step](const Request& request) { return decide(services, request, step); });
  }
}

}  // namespace dripline::api
