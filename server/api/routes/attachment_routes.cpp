#include <algorithm>

#include <nlohmann/json.hpp>

#include "server/api/api.hpp"
#include "server/api/bodies/program_bodies.hpp"
#include "server/api/content_body.hpp"
#include "server/api/nullable_json.hpp"
#include "server/api/views.hpp"

namespace dripline::api {
namespace {

using nlohmann::json;

json attachment_json(const storage::Attachment& attachment) {
  return {{"program", attachment.program},
          {"revision", number_or_null(attachment.revision)},
          {"name", attachment.name},
          {"size", attachment.size},
          {"sha256", attachment.content.hex()},
          {"comment", text_or_null(attachment.comment)},
          {"author", attachment.author},
          {"created", to_iso8601(attachment.created)}};
}

/// The attachment of a path, and `revision` of its query.
Result<storage::AttachmentName> named(const Request& request) {
  QueryReader query(request);
  const auto revision = query.number("revision", kMaxNumber);
  if (auto good = query.finish(); !good) return fail(good.error());
  return storage::AttachmentName{request.parameter("name"), revision,
                                 request.parameter("attachment")};
}

Response list_attachments(Services& services, const Request& request) {
  QueryReader query(request);
  const auto revision = query.number("revision", kMaxNumber);
  if (auto good = query.finish(); !good) return error_response(good.error());
  const auto attachments = services.attachments.list(request.parameter("name"), revision);
  if (!attachments) return error_response(attachments.error());
  json list = json::array();
  for (const auto& attachment : *attachments) list.push_back(attachment_json(attachment));
  return json_response(200, {{"attachments", std::move(list)}});
}

Response begin_attachment(Services& services, const Request& request) {
  const auto body = decode_attachment(request.body);
  if (!body) return error_response(body.error());
  library::Attachments::Request wanted = *body;
  wanted.name.program = request.parameter("name");
  const auto upload = services.attachments.begin(wanted, request.who);
  if (!upload) return error_response(upload.error());
  return json_response(201, upload_json(*upload, Api::kMaxPiece));
}

Response commit_attachment(Services& services, const Request& request) {
  const auto body = decode_commit(request.body);
  if (!body) return error_response(body.error());
  if (const auto own = own_upload(services, request); !own) return error_response(own.error());
  const auto attachment =
      services.attachments.commit(request.parameter("id"), body->sha256, request.who);
  if (!attachment) return error_response(attachment.error());
  return json_response(201, attachment_json(*attachment));
}

/// To be saved, never shown: a browser takes nothing in it for a page or a script of ours.
Response send_attachment(Services& services, const Request& request) {
  const auto name = named(request);
  if (!name) return error_response(name.error());
  const auto attachment = services.attachments.find(*name);
  if (!attachment) return error_response(attachment.error());
  Response response = content_response(services, request, {attachment->content, attachment->size});
  response.headers.emplace_back("Content-Disposition",
                                library::content_disposition(attachment->name));
  response.headers.emplace_back("X-Content-Type-Options", "nosniff");
  response.headers.emplace_back("Content-Security-Policy", "sandbox; default-src 'none'");
  return response;
}

Response remove_attachment(Services& services, const Request& request) {
  const auto name = named(request);
  if (!name) return error_response(name.error());
  const auto removed = services.attachments.remove(*name, request.who);
  return removed ? no_content() : error_response(removed.error());
}

}  // namespace

void add_attachment_routes(Router& router, Services& services) {
  const std::string attachments = "/api/v1/programs/{name}/attachments";
  router.add("GET", attachments, with(services, list_attachments));
  router.add("POST", attachments, with(services, begin_attachment));
  router.add("GET", attachments + "/{attachment}", with(services, send_attachment));
  router.add("DELETE", attachments + "/{attachment}", with(services, remove_attachment));
  router.add("POST", "/api/v1/uploads/{id}/attach", with(services, commit_attachment));
}

}  // namespace dripline::api
