#include <nlohmann/json.hpp>

#include "protocol/dds/message.hpp"
#include "server/api/api.hpp"
#include "server/api/bodies/json_object.hpp"
#include "server/api/nullable_json.hpp"

namespace dripline::api {

namespace {

using nlohmann::json;
using storage::OffsetProposal;

constexpr std::size_t kMaxRulesBody = offsets::kMaxRuleText;

Response without_offsets() {
  return error_response({Errc::Unsupported, "this server has no offset proposals"});
}

json offset_json(const OffsetProposal& proposal) {
  auto reasons = json::parse(proposal.reasons, nullptr, false);
  if (!reasons.is_array()) reasons = json::array();
  return {{"id", proposal.id},
          {"machine", proposal.machine},
          {"rule", proposal.rule},
          {"target", proposal.target},
          {"unit", proposal.unit},
          {"old_value", proposal.old_value},
          {"new_value", proposal.new_value},
          {"base", proposal.base},
          {"state", storage::to_string(proposal.state)},
          {"used", proposal.used},
          {"left_out", proposal.left_out},
          {"mean", proposal.mean},
          {"first", proposal.first},
          {"last", proposal.last},
          {"reasons", std::move(reasons)},
          {"created", to_iso8601(proposal.created)},
          {"decided", time_or_null(proposal.decided)},
          {"who", text_or_null(proposal.who)},
          {"comment", text_or_null(proposal.comment)},
          {"automatic", proposal.is_automatic},
          {"setup", number_or_null(proposal.setup)}};
}

json rules_json(const storage::OffsetRules& rules) {
  return {{"machine", rules.machine},
          {"version", rules.version},
          {"text", rules.text},
          {"author", rules.author},
          {"created", to_iso8601(rules.created)}};
}

json evaluation_json(const offsets::Evaluation& evaluation) {
  return {{"rule", evaluation.rule.name},
          {"target", evaluation.rule.target},
          {"unit", evaluation.unit},
          {"value", evaluation.value},
          {"since", evaluation.since},
          {"reasons", evaluation.outcome.reasons},
          {"proposal", evaluation.proposal ? offset_json(*evaluation.proposal) : json(nullptr)}};
}

json history_json(const offsets::HistoryEntry& entry) {
  json view{{"target", entry.target},
            {"unit", entry.unit},
            {"value", entry.value},
            {"setup", entry.setup.number},
            {"time", to_iso8601(entry.setup.created)},
            {"who", text_or_null(entry.setup.author)},
            {"why", text_or_null(entry.setup.comment)},
            {"proposal", entry.proposal ? offset_json(*entry.proposal) : json(nullptr)},
            {"runs", json::array()},
            {"parts", entry.parts},
            {"good", entry.good},
            {"archived", entry.archived},
            {"archives", entry.archives},
            {"uncounted", entry.uncounted}};
  for (const storage::Run& run : entry.runs) view["runs"].push_back(run.id);
  return view;
}

json at_machine_json(const offsets::MachineChange& change) {
  json cells = json::array();
  for (const auto& [name, numbers] : change.what.cells) {
    const auto& [before, after] = numbers;
    cells.push_back(
        {{"name", name}, {"before", before ? json(*before) : json(nullptr)}, {"value", after}});
  }
  return {{"change", change.change},
          {"target", change.target},
          {"time", to_iso8601(change.time)},
          {"who", text_or_null(change.what.by)},
          {"what", change.what.what},
          {"unit", text_or_null(change.what.unit)},
          {"length", number_or_null(change.what.length)},
          {"zero", number_or_null(change.what.zero)},
          {"cells", std::move(cells)}};
}

/// `{comment}`, or nothing.
Result<std::string> read_comment(const Request& request) {
  if (request.body.empty()) return std::string();
  auto body = JsonObject::parse(request.body);
  if (!body) return fail(body.error());
  const auto comment = body->optional_text("comment", offsets::Offsets::kMaxComment);
  if (auto good = body->finish(); !good) return fail(good.error());
  return comment.value_or("");
}

/// A proposal of another machine is none of this one's.
Result<storage::OffsetDecision> read_decision(Services& services, const Request& request) {
  const auto id = parse_unsigned(request.parameter("id"));
  if (!id) return fail(id.error());
  const auto comment = read_comment(request);
  if (!comment) return fail(comment.error());
  const auto proposal = services.offsets->stored().find(*id);
  if (!proposal) return fail(proposal.error());
  if (proposal->machine != request.parameter("name")) {
    return fail(Errc::NotFound, "machine {} has no offset proposal {}", request.parameter("name"),
                *id);
  }
  return storage::OffsetDecision{.id = *id, .who = request.who, .comment = *comment, .time = {}};
}

Response list_offsets(Services& services, const Request& request) {
  if (services.offsets == nullptr) return without_offsets();
  QueryReader query(request);
  const storage::Page page = read_page(query);
  storage::OffsetFilter filter;
  filter.machine = query.text("machine");
  filter.target = query.text("target");
  const auto state = query.text("state");
  if (auto good = query.finish(); !good) return error_response(good.error());
  if (state) {
    const auto parsed = storage::parse_offset_state(*state);
    if (!parsed) return error_response(parsed.error());
    filter.state = *parsed;
  }
  return list_response("offsets", services.offsets->stored().list(filter, page), offset_json);
}

Response show_offset(Services& services, const Request& request) {
  if (services.offsets == nullptr) return without_offsets();
  const auto id = parse_unsigned(request.parameter("id"));
  if (!id) return error_response(id.error());
  return value_response(200, services.offsets->stored().find(*id), offset_json);
}

Response approve_offset(Services& services, const Request& request) {
  if (services.offsets == nullptr) return without_offsets();
  const auto decision = read_decision(services, request);
  if (!decision) return error_response(decision.error());
  return value_response(200, services.offsets->approve(*decision), offset_json);
}

Response reject_offset(Services& services, const Request& request) {
  if (services.offsets == nullptr) return without_offsets();
  const auto decision = read_decision(services, request);
  if (!decision) return error_response(decision.error());
  return value_response(200, services.offsets->reject(*decision), offset_json);
}

Response look_at_offsets(Services& services, const Request& request) {
  if (services.offsets == nullptr) return without_offsets();
  const std::string machine = request.parameter("name");
  if (const auto known = services.offsets->stored().rules(machine); !known)
    return error_response(known.error());
  return list_response("rules", services.offsets->look(machine), evaluation_json);
}

Response show_rules(Services& services, const Request& request) {
  if (services.offsets == nullptr) return without_offsets();
  return value_response(200, services.offsets->stored().rules(request.parameter("name")),
                        rules_json);
}

/// The body is the TOML text.
Response save_rules(Services& services, const Request& request) {
  if (services.offsets == nullptr) return without_offsets();
  if (request.body.size() > kMaxRulesBody) {
    return error_response({Errc::LimitExceeded, fmt::format("offset rules of {} bytes, at most {}",
                                                            request.body.size(), kMaxRulesBody)});
  }
  return value_response(
      200, services.offsets->save_rules(request.parameter("name"), request.body, request.who),
      rules_json);
}

Response show_history(Services& services, const Request& request) {
  if (services.offsets == nullptr) return without_offsets();
  QueryReader query(request);
  const storage::Page page = read_page(query);
  const std::string target = query.text("target").value_or("");
  if (auto good = query.finish(); !good) return error_response(good.error());
  const std::string machine = request.parameter("name");
  const auto entries = services.offsets->history().list(machine, target, page);
  if (!entries) return error_response(entries.error());
  const auto changes = services.offsets->history().at_machine(
      {machine, std::string(dds::kChangePrefix), target}, page);
  if (!changes) return error_response(changes.error());
  json view{{"history", json::array()}, {"at_machine", json::array()}};
  for (const auto& entry : *entries) view["history"].push_back(history_json(entry));
  for (const auto& change : *changes) view["at_machine"].push_back(at_machine_json(change));
  return json_response(200, view);
}

Response show_in_force(Services& services, const Request& request) {
  if (services.offsets == nullptr) return without_offsets();
  const auto found = services.offsets->history().in_force(request.parameter("id"));
  if (!found) return error_response(found.error());
  json view{{"run", found->run.id},
            {"machine", found->run.machine},
            {"setup", number_or_null(found->run.setup)},
            {"first_block", 1},
            {"last_block", found->run.counters.executed},
            {"unit", text_or_null(found->unit)},
            {"values", json::array()}};
  for (const auto& value : found->values)
    view["values"].push_back({{"target", value.target}, {"value", value.value}});
  return json_response(200, view);
}

}  // namespace

std::function<void(const storage::OffsetProposal&)> publish_offsets_to(EventHub& hub) {
  return [&hub](const storage::OffsetProposal& proposal) {
    if (!hub.has_listeners()) return;
    hub.publish({.kind = "offset",
                 .machine = proposal.machine,
                 .data = to_text(offset_json(proposal)),
                 .port = {}});
  };
}

void add_offset_routes(Router& router, Services& services) {
  const std::string machine = "/api/v1/machines/{name}";
  router.add("GET", "/api/v1/offsets", with(services, list_offsets));
  router.add("GET", "/api/v1/offsets/{id}", with(services, show_offset));
  router.add("POST", machine + "/offsets/{id}/approve", with(services, approve_offset));
  router.add("POST", machine + "/offsets/{id}/reject", with(services, reject_offset));
  router.add("POST", machine + "/offsets/evaluation", with(services, look_at_offsets));
  router.add("GET", machine + "/offset-rules", with(services, show_rules));
  router.add("PUT", machine + "/offset-rules", with(services, save_rules));
  router.add("GET", machine + "/offset-history", with(services, show_history));
  router.add("GET", "/api/v1/runs/{id}/offsets", with(services, show_in_force));
}

}  // namespace dripline::api
