#include <nlohmann/json.hpp>

#include "server/api/api.hpp"
#include "server/api/nullable_json.hpp"
#include "server/api/views.hpp"

namespace dripline::api {
namespace {

using library::Backups;
using nlohmann::json;

json backup_json(const backup::Backup& backup) {
  return {{"id", backup.id},           {"made", to_iso8601(backup.made)},
          {"made_by", backup.made_by}, {"size", backup.size},
          {"added", backup.added},     {"verified", time_or_null(backup.verified)}};
}

json work_json(const Backups::Work& work) {
  return {{"kind", to_string(work.kind)},
          {"backup", work.id},
          {"phase", to_string(work.phase)},
          {"done", work.done},
          {"total", work.total}};
}

json outcome_json(const Backups::Outcome& outcome) {
  return {{"kind", to_string(outcome.kind)},
          {"backup", outcome.id},
          {"time", to_iso8601(outcome.at)},
          {"error", outcome.error}};
}

json state_json(const Backups::State& state) {
  auto backups = json::array();
  for (auto at = state.list.backups.rbegin(); at != state.list.backups.rend(); ++at)
    backups.push_back(backup_json(*at));
  return {{"folder", state.folder},
          {"every_hours", state.every.count()},
          {"overdue", state.is_overdue},
          {"backups", std::move(backups)},
          {"damaged", state.list.damaged},
          {"work", state.work ? work_json(*state.work) : json(nullptr)},
          {"last", state.last ? outcome_json(*state.last) : json(nullptr)}};
}

/// A handler that needs the server to have a folder of backups.
template <class Action>
Handler with_backups(Services& services, Action action) {
  return [&services, action](const Request& request) {
    QueryReader query(request);
    if (auto good = query.finish(); !good) return error_response(good.error());
    if (services.backups == nullptr) {
      return error_response(
          {Errc::NotFound, "this server makes no backups: start dncd with --backups FOLDER"});
    }
    return action(*services.backups, request);
  };
}

Response begun(const Backups& backups, const Result<void>& result) {
  constexpr int kAccepted = 202;
  if (!result) return error_response(result.error());
  return json_response(kAccepted, state_json(backups.state()));
}

}  // namespace

void add_backup_routes(Router& router, Services& services) {
  router.add("GET", "/api/v1/backups", with_backups(services, [](Backups& backups, const Request&) {
               return json_response(200, state_json(backups.state()));
             }));
  router.add("POST", "/api/v1/backups",
             with_backups(services, [](Backups& backups, const Request& request) {
               return begun(backups, backups.begin_make(request.who));
             }));
  router.add("POST", "/api/v1/backups/{id}/verify",
             with_backups(services, [](Backups& backups, const Request& request) {
               return begun(backups, backups.begin_verify(request.who, request.parameter("id")));
             }));
  router.add("DELETE", "/api/v1/backups/{id}",
             with_backups(services, [](Backups& backups, const Request& request) {
               const auto removed = backups.remove(request.who, request.parameter("id"));
               return removed ? no_content() : error_response(removed.error());
             }));
}

}  // namespace dripline::api
