#include <nlohmann/json.hpp>

#include "server/api/bodies.hpp"
#include "server/api/routes.hpp"
#include "server/api/views.hpp"

namespace dripline::api {
namespace {

Response start_run(Services& services, const Request& request) {
  auto start = decode_start(request.body);
  if (!start) return error_response(start.error());
  start->author = request.who;
  const auto run = services.machines.start(*start);
  if (!run) return error_response(run.error());
  services.audit.write(
      {.who = request.who,
       .action = "run.start",
       .subject = run->id,
       .detail = fmt::format("{} revision {} on {}", run->program, run->revision, run->machine)});
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
  const auto runs = services.runs.runs(*filter, page);
  if (!runs) return error_response(runs.error());
  auto list = nlohmann::json::array();
  for (const auto& run : *runs) list.push_back(run_json(run));
  return json_response(200, {{"runs", std::move(list)}});
}

Response show_run(Services& services, const Request& request) {
  const auto run = services.runs.run(request.parameter("id"));
  return run ? json_response(200, run_json(*run)) : error_response(run.error());
}

Response command_run(Services& services, const Request& request) {
  auto command = decode_command(request.body);
  if (!command) return error_response(command.error());
  command->run = request.parameter("id");
  const auto done = services.machines.command(*command);
  // The gateway may have carried out the command although its answer is missing.
  const bool is_unknown = !done && done.error().code == Errc::Timeout;
  if (done || is_unknown) {
    services.audit.write({.who = request.who,
                          .action = fmt::format("run.{}", dds::to_string(command->action)),
                          .subject = command->run,
                          .detail = fmt::format("{} {} {}", command->argument, command->value,
                                                is_unknown ? "not answered" : "accepted")});
  }
  if (!done) return error_response(done.error());
  return json_response(200, {{"accepted", true}});
}

Response list_records(Services& services, const Request& request) {
  QueryReader query(request);
  const storage::Page page = read_page(query);
  const std::string kind = query.text("kind").value_or("");
  if (auto good = query.finish(); !good) return error_response(good.error());
  const auto records = services.runs.records(request.parameter("id"), kind, page);
  if (!records) return error_response(records.error());
  auto list = nlohmann::json::array();
  for (const auto& record : *records) list.push_back(record_json(record));
  return json_response(200, {{"records", std::move(list)}});
}

}  // namespace

void add_run_routes(Router& router, Services& services) {
  router.add(
      "POST", "/api/v1/runs", [&](const Request& request) { return start_run(services, request); },
      Waits::ForMachine);
  router.add("GET", "/api/v1/runs",
             [&](const Request& request) { return list_runs(services, request); });
  router.add("GET", "/api/v1/runs/{id}",
             [&](const Request& request) { return show_run(services, request); });
  router.add(
      "POST", "/api/v1/runs/{id}/commands",
      [&](const Request& request) { return command_run(services, request); }, Waits::ForMachine);
  router.add("GET", "/api/v1/runs/{id}/records",
             [&](const Request& request) { return list_records(services, request); });
}

}  // namespace dripline::api
