// The calls of Client for the job queues of machines.
#include <nlohmann/json.hpp>

#include "clients/lib/api_json.hpp"
#include "clients/lib/client.hpp"
#include "clients/lib/impl/request.hpp"

namespace dripline::client {

using impl::dumped;
using impl::get;
using impl::path_of;
using impl::with_method;
using impl::with_query;

namespace {

std::string jobs_path(std::string_view machine) {
  return path_of("machines", machine) + "/jobs";
}

std::string job_path(std::string_view machine, std::uint64_t job) {
  return fmt::format("{}/{}", jobs_path(machine), job);
}

}  // namespace

Reply<JobList> Client::jobs(std::string_view machine, bool is_open, Page page) {
  std::string path = with_query(jobs_path(machine), "state", is_open ? "open" : "closed");
  path = with_query(std::move(path), "limit", std::to_string(page.limit));
  path = with_query(std::move(path), "offset", std::to_string(page.offset));
  return fetch<JobList>(get(path));
}

Reply<Job> Client::add_job(const JobRequest& request) {
  nlohmann::json body{{"program", request.program},
                      {"quantity", request.quantity},
                      {"parts_per_run", request.parts_per_run}};
  if (request.revision) body["revision"] = *request.revision;
  if (!request.counts.empty()) body["counts"] = request.counts;
  if (!request.comment.empty()) body["comment"] = request.comment;
  if (request.place) body["place"] = *request.place;
  return fetch<Job>(with_method("POST", jobs_path(request.machine)), dumped(body));
}

Reply<Job> Client::move_job(std::string_view machine, std::uint64_t job, std::uint64_t place) {
  return fetch<Job>(with_method("PUT", job_path(machine, job)), dumped({{"place", place}}));
}

Reply<void> Client::remove_job(std::string_view machine, std::uint64_t job) {
  return perform(with_method("DELETE", job_path(machine, job)));
}

Reply<BegunRun> Client::start_job(std::string_view machine, std::optional<std::uint64_t> job) {
  nlohmann::json body = nlohmann::json::object();
  if (job) body["job"] = *job;
  return fetch<BegunRun>(with_method("POST", path_of("machines", machine) + "/start-job"),
                         dumped(body));
}

Reply<void> Client::hold_jobs(std::string_view machine, const std::string& reason) {
  return perform(with_method("PUT", path_of("machines", machine) + "/job-hold"),
                 dumped({{"reason", reason}}));
}

Reply<void> Client::release_jobs(std::string_view machine) {
  return perform(with_method("DELETE", path_of("machines", machine) + "/job-hold"));
}

}  // namespace dripline::client
