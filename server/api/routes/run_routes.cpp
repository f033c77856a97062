#include <nlohmann/json.hpp>

#include "protocol/dds/endpoint.hpp"
#include "server/api/access_control.hpp"
#include "server/api/api.hpp"
#include "server/api/bodies/run_bodies.hpp"
#include "server/api/views.hpp"
#include "server/machines/start_point.hpp"

namespace dripline::api {

namespace {

Response start_run(Services& services, const Request& request) {
  auto start = decode_start(request.body);
  if (!start) return error_response(start.error());
  start->given = request.given;
  start->author = request.who.name;
  start->role = request.caller->role;
  start->before = [&services, who = request.who,
                   is_test = start->is_test](const storage::Run& run) {
    return services.audit.write_before(
        {.who = who,
         .action = "run.start",
         .subject = run.id,
         .detail = machines::audit_text(services.machines, run, is_test)});
  };
  std::string notice;
  start->on_notice = [&notice](const std::string& given) { notice = given; };
  const auto run = services.machines.start(*start);
  if (!run) return error_response(run.error());
  return json_response(201, begun_json(*run, notice));
}

Response restart_run(Services& services, const Request& request) {
  const auto at = decode_restart(request.body);
  if (!at) return error_response(at.error());
  const auto original = services.runs.run(request.parameter("id"));
  if (!original) return error_response(original.error());
  machines::StartRequest start;
  start.given = request.given;
  start.machine = original->machine;
  start.program = original->program;
  start.revision = original->revision;
  start.author = request.who.name;
  start.role = request.caller->role;
  start.restart = {original->id, *at};
  start.job = original->job;
  const std::string what = fmt::format("run {} at {} on {}", original->id, *at, original->machine);
  start.before = [&audit = services.audit, who = request.who, what](const storage::Run& run) {
    return audit.write_before(
        {.who = who, .action = "run.restart", .subject = run.id, .detail = what});
  };
  const auto run = services.machines.start(start);
  if (!run) return error_response(run.error());
  return json_response(201, run_json(*run));
}

Result<storage::RunFilter> read_filter(QueryReader& query) {
  storage::RunFilter filter;
  filter.machine = query.text("machine");
  filter.program = query.text("program");
  if (const auto state = query.text("state")) {
    const auto parsed = storage::parse_run_state(*state);
    if (!parsed) return fail(parsed.error());
    filter.state = *parsed;
  }
  return filter;
}

Response list_runs(Services& services, const Request& request) {
  QueryReader query(request);
  const storage::Page page = read_page(query);
  const auto filter = read_filter(query);
  if (!filter) return error_response(filter.error());
  if (auto good = query.finish(); !good) return error_response(good.error());
  return list_response("runs", services.runs.runs(*filter, page), run_json);
}

Response show_run(Services& services, const Request& request) {
  const auto run = services.runs.run(request.parameter("id"));
  if (!run) return error_response(run.error());
  nlohmann::json view = run_json(*run);
  const auto machine = services.machines.machine(run->machine);
  const bool is_held = machine && machine->held && machine->held->run == run->id;
  view["held"] = is_held ? hold_json(machine->held) : nlohmann::json(nullptr);
  view["parts"] = nullptr;
  if (services.measurements != nullptr) {
    const auto parts = services.measurements->stored().parts_of_run(run->id);
    if (!parts) return error_response(parts.error());
    for (std::size_t i = 0; i < parts->verdicts.size(); ++i) {
      view["parts"][std::string(measurement::to_string(measurement::Verdict(i)))] =
          parts->verdicts[i];
    }
    view["parts"]["archived"] = parts->archived;
    view["parts"]["archives"] = parts->archives;
  }
  return json_response(200, view);
}

Response attest_run(Services& services, const Request& request) {
  QueryReader query(request);
  if (auto good = query.finish(); !good) return error_response(good.error());
  const auto facts = services.runs.facts(request.parameter("id"), services.chain.header().database);
  if (!facts) return error_response(facts.error());
  Response response;
  response.content_type = "text/plain; charset=utf-8";
  response.body = services.chain.attest(*facts);
  return response;
}

Response command_run(Services& services, const Request& request) {
  auto command = decode_command(request.body);
  if (!command) return error_response(command.error());
  command->run = request.parameter("id");
  return carry_out(services, request, *command);
}

Response list_records(Services& services, const Request& request) {
  QueryReader query(request);
  const storage::Page page = read_page(query);
  const std::string kind = query.text("kind").value_or("");
  if (auto good = query.finish(); !good) return error_response(good.error());
  return list_response("records", services.runs.records(request.parameter("id"), kind, page),
                       record_json);
}

}  // namespace

namespace {

/// Whether the command makes the machine safer, whatever it does now.
bool stops(Services& services, const machines::CommandRequest& command) {
  if (dds::is_stop(command.action, command.argument, command.value)) return true;
  if (!dds::is_override(command.action)) return false;
  const auto view = services.machines.machine(
      machine_of_run(services.machines, services.runs, command.run).value_or(command.machine));
  return view && view->status && dds::lowers_override(command.action, command.value, *view->status);
}

/// What was asked for besides the action: "80 %" is 0.8 of an override.
std::string detail_of(const machines::CommandRequest& command) {
  using enum dds::CommandAction;
  const bool has_value =
      command.action == Switch || command.action == Handwheel || dds::is_override(command.action);
  if (!has_value) return command.argument;
  return fmt::format("{}{}{}", command.argument, command.argument.empty() ? "" : " ",
                     command.value);
}

}  // namespace

/// The entry comes first. What stops a machine goes out before it, and whether or not it can be
/// written: the store may keep it waiting.
Response carry_out(Services& services, const Request& request,
                   const machines::CommandRequest& given) {
  machines::CommandRequest command = given;
  command.who = request.who.name;
  command.given = request.given;
  const bool is_of_run = !command.run.empty();
  library::AuditTrail::Change change{
      .who = request.who,
      .action = fmt::format("{}.{}", is_of_run ? "run" : "machine", dds::to_string(command.action)),
      .subject = is_of_run ? command.run : command.machine,
      .detail = detail_of(command)};
  const bool is_stop = stops(services, command);
  if (!is_stop) {
    if (auto written = services.audit.write_before(change); !written)
      return error_response(written.error());
  }
  const auto done = services.machines.command(command);
  if (is_stop) services.audit.write_late(change);
  if (done) return json_response(200, {{"accepted", true}});
  // The gateway may have carried out the command although its answer is missing.
  const bool is_unknown = done.error().code == Errc::Timeout;
  if (!change.detail.empty()) change.detail += ": ";
  change.detail += is_unknown ? "not answered" : "refused, " + done.error().what;
  is_stop ? services.audit.write_late(change) : services.audit.write(std::move(change));
  return error_response(done.error());
}

void add_run_routes(Router& router, Services& services) {
  router.add("POST", "/api/v1/runs", with(services, start_run), Waits::ForMachine);
  router.add("GET", "/api/v1/runs", with(services, list_runs));
  router.add("GET", "/api/v1/runs/{id}", with(services, show_run));
  router.add("GET", "/api/v1/runs/{id}/attestation", with(services, attest_run));
  router.add("POST", "/api/v1/runs/{id}/restart", with(services, restart_run), Waits::ForMachine);
  router.add("POST", "/api/v1/runs/{id}/commands", with(services, command_run), Waits::ForMachine);
  router.add("GET", "/api/v1/runs/{id}/records", with(services, list_records));
}

}  // namespace dripline::api
