#include <nlohmann/json.hpp>

#include "server/api/api.hpp"
#include "server/api/bodies/program_bodies.hpp"
#include "server/api/bodies/run_bodies.hpp"
#include "server/api/nullable_json.hpp"
#include "server/api/views.hpp"
#include "server/machines/start_point.hpp"

namespace dripline::api {

namespace {

using nlohmann::json;

constexpr std::chrono::seconds kVerdictWait{2};

json job_json(const storage::Job& job) {
  return {{"id", job.id},
          {"machine", job.machine},
          {"program", job.program},
          {"revision", number_or_null(job.revision)},
          {"quantity", job.quantity},
          {"parts_per_run", job.parts_per_run},
          {"counts", storage::to_string(job.counts)},
          {"completed", job.completed},
          {"good", job.good},
          {"unknown", job.unknown},
          {"rework", job.rework},
          {"scrap", job.scrap},
          {"runs", job.runs},
          {"state", storage::to_string(job.state)},
          {"comment", text_or_null(job.comment)},
          {"author", job.author},
          {"created", to_iso8601(job.created)}};
}

Response list_jobs(Services& services, const Request& request) {
  QueryReader query(request);
  const storage::Page page = read_page(query);
  const std::string state = query.text("state").value_or("open");
  if (auto good = query.finish(); !good) return error_response(good.error());
  if (state != "open" && state != "closed") {
    return error_response(
        {Errc::Syntax, fmt::format("query parameter 'state' is '{}': open or closed", state)});
  }
  const auto queue = services.jobs.list(request.parameter("name"), state == "open", page);
  if (!queue) return error_response(queue.error());
  auto jobs = json::array();
  for (const auto& job : queue->jobs) jobs.push_back(job_json(job));
  return json_response(200, {{"jobs", std::move(jobs)}, {"hold", hold_json(queue->hold)}});
}

Response add_job(Services& services, const Request& request) {
  auto body = decode_job(request.body);
  if (!body) return error_response(body.error());
  body->job.machine = request.parameter("name");
  const auto added = services.jobs.add(
      {.job = body->job, .place = body->place, .role = request.caller->role}, request.who);
  return value_response(201, added, job_json);
}

Result<std::uint64_t> job_number(const Request& request) {
  auto number = parse_unsigned(request.parameter("job"));
  if (!number) return fail(Errc::Syntax, "job '{}' is not a number", request.parameter("job"));
  return number;
}

Response move_job(Services& services, const Request& request) {
  const auto job = job_number(request);
  if (!job) return error_response(job.error());
  const auto place = decode_job_move(request.body);
  if (!place) return error_response(place.error());
  return value_response(
      200, services.jobs.move(request.parameter("name"), *job, *place, request.who), job_json);
}

Response remove_job(Services& services, const Request& request) {
  const auto job = job_number(request);
  if (!job) return error_response(job.error());
  return empty_response(services.jobs.remove(request.parameter("name"), *job, request.who));
}

Response hold_queue(Services& services, const Request& request) {
  const auto reason = decode_rejection(request.body);
  if (!reason) return error_response(reason.error());
  return empty_response(services.jobs.hold(request.parameter("name"), *reason, request.who));
}

Response release_queue(Services& services, const Request& request) {
  return empty_response(services.jobs.release(request.parameter("name"), request.who));
}

/// A take is a command of its caller: the rights, the machine's own consent and the audit entry are
/// those of every start.
Response start_job(Services& services, const Request& request) {
  const auto wanted = decode_job_start(request.body);
  if (!wanted) return error_response(wanted.error());
  auto job = services.jobs.take(request.parameter("name"), *wanted);
  if (job && job->counts == storage::JobCount::Good && services.measurements != nullptr) {
    // The verdict on what its last run made may be about to come: it may have all its parts.
    (void)services.measurements->wait(kVerdictWait);
    job = services.jobs.take(request.parameter("name"), *wanted);
  }
  if (!job) return error_response(job.error());
  machines::StartRequest start;
  start.given = request.given;
  start.machine = job->machine;
  start.program = job->program;
  start.revision = job->revision;
  start.author = request.who.name;
  start.role = request.caller->role;
  start.job = job->id;
  start.before = [&services, who = request.who, id = job->id](const storage::Run& run) {
    return services.audit.write_before(
        {.who = who,
         .action = "run.start",
         .subject = run.id,
         .detail =
             fmt::format("{}, job {}", machines::audit_text(services.machines, run, false), id)});
  };
  std::string notice;
  start.on_notice = [&notice](const std::string& given) { notice = given; };
  const auto run = services.machines.start(start);
  return value_response(201, run,
                        [&](const storage::Run& begun) { return begun_json(begun, notice); });
}

}  // namespace

std::function<void(const library::JobChange&)> publish_jobs_to(EventHub& hub) {
  return [&hub](const library::JobChange& change) {
    if (!hub.has_listeners()) return;
    const json view{{"machine", change.machine},
                    {"change", to_string(change.kind)},
                    {"job", change.job ? job_json(*change.job) : json(nullptr)},
                    {"hold", hold_json(change.hold)}};
    hub.publish({.kind = "job", .machine = change.machine, .data = to_text(view), .port = {}});
  };
}

void add_job_routes(Router& router, Services& services) {
  const std::string machine = "/api/v1/machines/{name}";
  router.add("GET", machine + "/jobs", with(services, list_jobs));
  router.add("POST", machine + "/jobs", with(services, add_job));
  router.add("PUT", machine + "/jobs/{job}", with(services, move_job));
  router.add("DELETE", machine + "/jobs/{job}", with(services, remove_job));
  router.add("POST", machine + "/start-job", with(services, start_job), Waits::ForMachine);
  router.add("PUT", machine + "/job-hold", with(services, hold_queue));
  router.add("DELETE", machine + "/job-hold", with(services, release_queue));
}

}  // namespace dripline::api
