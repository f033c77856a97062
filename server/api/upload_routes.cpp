#include <nlohmann/json.hpp>

#include "server/api/bodies.hpp"
#include "server/api/routes.hpp"
#include "server/api/views.hpp"

namespace dripline::api {
namespace {

Response answer_upload(int status, const Result<storage::Upload>& upload) {
  if (!upload) return error_response(upload.error());
  return json_response(status, upload_json(*upload, Api::kMaxPiece));
}

Response begin_upload(Services& services, const Request& request) {
  const auto body = decode_upload(request.body);
  if (!body) return error_response(body.error());
  return answer_upload(201, services.programs.begin(*body, request.who));
}

Response append_upload(Services& services, const Request& request) {
  QueryReader query(request);
  const auto offset = query.number("offset", std::numeric_limits<std::int64_t>::max());
  if (auto good = query.finish(); !good) return error_response(good.error());
  if (!offset) return error_response({Errc::Syntax, "query parameter 'offset' is missing"});
  if (request.body.empty()) return error_response({Errc::Syntax, "the piece is empty"});
  if (request.body.size() > Api::kMaxPiece) {
    return error_response({Errc::LimitExceeded, fmt::format("piece of {} bytes: at most {}",
                                                            request.body.size(), Api::kMaxPiece)});
  }
  return answer_upload(200, services.programs.append(request.parameter("id"), *offset,
                                                     std::as_bytes(std::span(request.body))));
}

Response commit_upload(Services& services, const Request& request) {
  const auto body = decode_commit(request.body);
  if (!body) return error_response(body.error());
  const auto protection =
      body->force ? library::Protection::Override : library::Protection::Respect;
  const auto committed =
      services.programs.commit(request.parameter("id"), body->sha256, request.who, protection);
  if (!committed) return error_response(committed.error());
  auto view = revision_json(committed->revision, services.programs.title(committed->revision));
  if (!committed->is_unchanged) return json_response(201, view);
  view["unchanged"] = true;
  return json_response(200, view);
}

Response abandon_upload(Services& services, const Request& request) {
  return empty_response(services.programs.abandon(request.parameter("id")));
}

}  // namespace

void add_upload_routes(Router& router, Services& services) {
  router.add("POST", "/api/v1/uploads", with(services, begin_upload));
  router.add("GET", "/api/v1/uploads/{id}", [&](const Request& request) {
    return answer_upload(200, services.programs.upload(request.parameter("id")));
  });
  router.add("PUT", "/api/v1/uploads/{id}/content", with(services, append_upload));
  router.add("POST", "/api/v1/uploads/{id}/commit", with(services, commit_upload));
  router.add("DELETE", "/api/v1/uploads/{id}", with(services, abandon_upload));
}

}  // namespace dripline::api
