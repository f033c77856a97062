#include <nlohmann/json.hpp>

#include "server/api/api.hpp"
#include "server/api/nullable_json.hpp"
#include "server/api/views.hpp"

namespace dripline::api {
namespace {

library::Health::State health_of(const Services& services) {
  return services.health == nullptr ? library::Health::State{} : services.health->state();
}

enum class Audience { Anybody, TokenHolder };

nlohmann::json health_json(const library::Health::State& state, Audience audience) {
  auto reasons = nlohmann::json::array();
  for (const auto& finding : state.findings) {
    nlohmann::json reason{{"subject", finding.subject},
                          {"status", library::to_string(finding.level)},
                          {"message", finding.what}};
    if (audience == Audience::TokenHolder) reason["detail"] = finding.detail;
    reasons.push_back(std::move(reason));
  }
  return {{"status", library::to_string(state.level)}, {"reasons", std::move(reasons)}};
}

/// Whether work that is given to the server now would be stored. Degraded is ready, but for a store
/// that lets no one in.
bool is_ready(const library::Health::State& state) {
  using Level = library::Health::Level;
  return state.level != Level::Failed &&
         std::ranges::none_of(state.findings,
                              [](const auto& finding) { return finding.subject == "store"; });
}

/// Null: Sparkplug is not spoken.
nlohmann::json sparkplug_json(const Services& services) {
  if (services.sparkplug == nullptr) return nullptr;
  const auto state = services.sparkplug->state();
  return {{"node", state.node},
          {"connected", state.is_connected},
          {"since", time_or_null(state.since)},
          {"fault", text_or_null(state.fault)},
          {"messages_published", state.messages},
          {"rebirths", state.rebirths}};
}

/// Null: a server without a broker.
nlohmann::json mqtt_json(const Services& services) {
  if (services.publisher == nullptr) return nullptr;
  const auto state = services.publisher->state();
  if (!state) return nullptr;
  return {{"broker", state->broker},
          {"connected", state->is_connected},
          {"since", time_or_null(state->since)},
          {"fault", text_or_null(state->fault)},
          {"records_waiting", state->waiting},
          {"records_published", state->records},
          {"states_published", state->states},
          {"records_missing", state->missing},
          {"sparkplug", sparkplug_json(services)}};
}

/// Null: no program text on the server's own disk.
nlohmann::json cache_json(const Services& services) {
  if (services.cache == nullptr) return nullptr;
  const auto state = services.cache->state();
  return {{"size_bytes", state.capacity},
          {"used_bytes", state.bytes},
          {"hits", state.hits},
          {"misses", state.misses},
          {"fetched", state.ahead},
          {"damaged", state.damaged},
          {"fault", text_or_null(state.fault)}};
}

/// Null: the library is this server's alone.
nlohmann::json sharing_json(const Services& services) {
  if (!services.shared) return nullptr;
  const auto waiting = services.shared->waiting();
  return {{"term", services.shared->term},
          {"standbys", waiting.value_or(std::vector<std::string>{})}};
}

Response hand_over(Services& services, const Request& request) {
  QueryReader query(request);
  if (auto good = query.finish(); !good) return error_response(good.error());
  if (!services.shared) {
    return error_response(
        {Errc::Unsupported,
         "the library of this server is a SQLite file, which no other server can take over"});
  }
  auto waiting = services.shared->hand_over();
  if (!waiting) return error_response(waiting.error());
  if (auto noted = services.audit.write_before({.who = request.who,
                                                .action = "server.drain",
                                                .subject = services.facts.name,
                                                .detail = ""});
      !noted)
    return error_response(noted.error());
  constexpr int kAccepted = 202;
  services.shared->leave();
  return json_response(kAccepted, {{"term", services.shared->term}, {"standbys", *waiting}});
}

Response describe_server(Services& services, const Request& request) {
  QueryReader query(request);
  if (auto good = query.finish(); !good) return error_response(good.error());
  const auto programs = services.programs.count();
  if (!programs) return error_response(programs.error());
  storage::RunFilter active_runs;
  active_runs.state = storage::RunState::Active;
  const auto active = services.runs.count(active_runs);
  if (!active) return error_response(active.error());
  const auto machines = services.machines.machines();
  const auto connected =
      std::ranges::count_if(machines, [](const auto& view) { return view.is_connected; });
  const ServerFacts& facts = services.facts;
  const std::chrono::duration<double> uptime = services.clock.now() - facts.started;
  return json_response(
      200, {{"name", facts.name},
            {"version", facts.version},
            {"started", to_iso8601(facts.started)},
            {"uptime_s", uptime.count()},
            {"data_dir", facts.data_dir},
            {"machines", machines.size()},
            {"machines_connected", connected},
            {"programs", *programs},
            {"runs_active", *active},
            {"health", health_json(health_of(services), Audience::TokenHolder)},
            {"mqtt", mqtt_json(services)},
            {"program_cache", cache_json(services)},
            {"sharing", sharing_json(services)},
            {"dds", {{"domain", facts.dds_domain}, {"rejected", services.dds_rejected()}}}});
}

/// A listener first receives the state of every machine, then the changes.
Response open_events(Services& services, const Request& request) {
  QueryReader query(request);
  const auto machine = query.text("machine");
  const auto form = query.flag("changes") ? Interest::Form::Changes : Interest::Form::Whole;
  if (auto good = query.finish(); !good) return error_response(good.error());
  if (machine) {
    if (const auto known = services.machines.machine(*machine); !known) {
      return error_response(known.error());
    }
  }
  Response response;
  response.events = services.events.subscribe(machine, form);
  if (!response.events) return too_many_listeners();
  for (const auto& view : services.machines.machines()) {
    if (!response.events->wants_machine(view.machine.name)) continue;
    services.events.show(*response.events, view.machine.name, [&] { return machine_text(view); });
  }
  response.content_type = "text/event-stream";
  return response;
}

}  // namespace

Response too_many_listeners() {
  return error_response(
      {Errc::Busy, fmt::format("{} listeners are connected already: at most {}",
                               EventHub::kMaxSubscriptions, EventHub::kMaxSubscriptions)});
}

void add_server_routes(Router& router, Services& services) {
  constexpr int kUnavailable = 503;
  router.add("GET", "/api/v1/ready", [&](const Request&) {
    const auto state = health_of(services);
    auto body = health_json(state, Audience::Anybody);
    body["ready"] = is_ready(state);
    body["role"] = "active";
    return json_response(is_ready(state) ? 200 : kUnavailable, body);
  });
  router.add("GET", "/api/v1/health", [&](const Request&) {
    const auto state = health_of(services);
    const bool is_failed = state.level == library::Health::Level::Failed;
    auto body = health_json(state, Audience::Anybody);
    body["role"] = "active";
    return json_response(is_failed ? kUnavailable : 200, body);
  });
  router.add("GET", "/api/v1/openapi.json",
             [](const Request&) { return json_text_response(std::string(openapi_text())); });
  router.add("GET", "/api/v1/server", with(services, describe_server));
  router.add("POST", "/api/v1/server/drain", with(services, hand_over));
  router.add("GET", "/api/v1/events", with(services, open_events));
}

}  // namespace dripline::api
