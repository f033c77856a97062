#include <nlohmann/json.hpp>

#include "server/api/api.hpp"
#include "server/api/nullable_json.hpp"
#include "server/api/views.hpp"

namespace dripline::api {

namespace {

using nlohmann::json;

Response without_archives() {
  return error_response(
      {Errc::NotFound, "this server makes no archives: start dncd with --archives FOLDER"});
}

json archive_json(const storage::Archive& archive) {
  return {{"id", archive.id},
          {"kind", storage::to_string(archive.kind)},
          {"machine", text_or_null(archive.machine)},
          {"file", archive.file},
          {"sha256", archive.sha256.hex()},
          {"rows", archive.rows},
          {"bytes", archive.bytes},
          {"first", to_iso8601(archive.first_time)},
          {"last", to_iso8601(archive.last_time)},
          {"created", to_iso8601(archive.created)},
          {"removed", archive.is_removed}};
}

Response list_archives(Services& services, const Request& request) {
  if (services.retention == nullptr) return without_archives();
  QueryReader query(request);
  const storage::Page page = read_page(query);
  if (auto good = query.finish(); !good) return error_response(good.error());
  return list_response("archives", services.retention->list(page), archive_json);
}

Response make_archives(Services& services, const Request&) {
  if (services.retention == nullptr) return without_archives();
  const auto made = services.retention->apply();
  if (!made) return error_response(made.error());
  return json_response(200, {{"made", *made}});
}

}  // namespace

void add_archive_routes(Router& router, Services& services) {
  router.add("GET", "/api/v1/archives", with(services, list_archives));
  router.add("POST", "/api/v1/archives", with(services, make_archives), Waits::ForMachine);
}

}  // namespace dripline::api
