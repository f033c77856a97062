#include "clients/cli/server/run_reference.hpp"

#include "clients/cli/context.hpp"

namespace dripline::cli {
namespace {

using client::Failure;
using client::Run;

constexpr std::uint64_t kMaxRunsLookedAt = 10000;

client::Reply<Run> find_latest(client::Client& client) {
  auto runs = client.runs({"", "", "", {1, 0}});
  if (!runs) return client::failed(runs.error());
  if (runs->empty()) {
    return client::failed(Failure::Kind::Refused, Errc::NotFound, "there is no run yet");
  }
  return runs->front();
}

client::Reply<Run> find_by_prefix(client::Client& client, const std::string& prefix) {
  auto runs = fetch_all(kMaxRunsLookedAt, [&](client::Page page) {
    return client.runs({"", "", "", page});
  });
  if (!runs) return client::failed(runs.error());
  const Run* found = nullptr;
  for (const auto& run : *runs) {
    if (!run.id.starts_with(prefix)) continue;
    if (found != nullptr) {
      return client::failed(Failure::Kind::Refused, Errc::Conflict,
                            "run '{}' fits {} and {}; expected more of the id", prefix, found->id,
                            run.id);
    }
    found = &run;
  }
  if (found != nullptr) return *found;
  return client::failed(Failure::Kind::Refused, Errc::NotFound,
                        "no run's id begins with '{}'; expected one of dnc run list, or latest",
                        prefix);
}

}  // namespace

client::Reply<Run> find_run(client::Client& client, const std::string& reference) {
  if (reference == "latest") return find_latest(client);
  if (reference.empty()) return find_by_prefix(client, "(empty)");
  auto exact = client.run(reference);
  if (exact || exact.error().kind != Failure::Kind::Refused) return exact;
  return find_by_prefix(client, reference);
}

}  // namespace dripline::cli
