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

json rule_json(const library::RetentionRule& rule) {
  constexpr auto kDay = std::chrono::hours(24);
  return {{"days", rule.age ? json(*rule.age / kDay) : json(nullptr)},
          {"rows", number_or_null(rule.rows)}};
}

json retention_json(const library::Retention& retention) {
  const auto& options = retention.options();
  return {{"folder", retention.folder().string()},
          {"records", rule_json(options.records)},
          {"measurements", rule_json(options.measurements)}};
}

Response list_archives(Services& services, const Request& request) {
  if (services.retention == nullptr) return without_archives();
  QueryReader query(request);
  const storage::Page page = read_page(query);
  if (auto good = query.finish(); !good) return error_response(good.error());
  const auto archives = services.retention->list(page);
  if (!archives) return error_response(archives.error());
  auto list = json::array();
  for (const auto& archive : *archives) list.push_back(archive_json(archive));
  return json_response(
      200, {{"archives", std::move(list)}, {"retention", retention_json(*services.retention)}});
}

/// The file is read to its end whatever is asked for: only then it is known to be whole.
Response read_archive(Services& services, const Request& request) {
  if (services.retention == nullptr) return without_archives();
  QueryReader query(request);
  const storage::Page page = read_page(query);
  const std::string contains = query.text("contains").value_or("");
  if (auto good = query.finish(); !good) return error_response(good.error());
  const auto id = parse_unsigned(request.parameter("id"));
  if (!id) return error_response(id.error());
  const auto archive = services.retention->find(*id);
  if (!archive) return error_response(archive.error());
  auto rows = json::array();
  std::uint64_t found = 0;
  const auto take = [&](const std::string& row) -> Result<void> {
    if (row.find(contains) == std::string::npos) return {};
    if (found++ < page.offset || rows.size() >= page.limit) return {};
    auto read = json::parse(row, nullptr, false);
    if (!read.is_object())
      return fail(Errc::Corrupt, "archive {}: a row is no JSON", archive->file);
    rows.push_back(std::move(read));
    return {};
  };
  if (auto done = services.retention->read(*archive, take); !done)
    return error_response(done.error());
  return json_response(
      200, {{"archive", archive_json(*archive)}, {"found", found}, {"rows", std::move(rows)}});
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
  router.add("GET", "/api/v1/archives/{id}/rows", with(services, read_archive));
  router.add("POST", "/api/v1/archives", with(services, make_archives), Waits::ForMachine);
}

}  // namespace dripline::api
