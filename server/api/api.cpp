#include "server/api/api.hpp"

#include <openssl/crypto.h>
#include <nlohmann/json.hpp>

#include "protocol/base/digest.hpp"
#include "protocol/process/log.hpp"
#include "server/api/views.hpp"

namespace dripline::api {

namespace {

/// Requests that need no token; their handlers do not wait.
bool is_open_to_all(const Request& request) {
  const auto& path = request.target.segments;
  return path.size() == 3 && path[0] == "api" && path[1] == "v1" &&
         (path[2] == "health" || path[2] == "openapi.json");
}

}  // namespace

Api::Api(Services services, Token token)
    : services_(std::move(services)), token_(std::move(token)) {
  add_server_routes(router_, services_);
  add_program_routes(router_, services_);
  add_upload_routes(router_, services_);
  add_machine_routes(router_, services_);
  add_run_routes(router_, services_);
  add_report_routes(router_, services_);
  add_setup_routes(router_, services_);
  add_memory_routes(router_, services_);
  add_port_routes(router_, services_);
}

std::optional<Response> Api::judge(Request& head) const {
  if (is_open_to_all(head)) return route(head);
  if (is_authorized(token_, head.header("authorization"))) {
    head.who = token_.name;
    return std::nullopt;
  }
  Response response =
      error_response({Errc::Denied, "send the server's token: Authorization: Bearer TOKEN"});
  response.headers.emplace_back("WWW-Authenticate", "Bearer");
  return response;
}

Response Api::handle(Request request) const {
  if (auto judged = judge(request)) return *std::move(judged);
  return route(std::move(request));
}

Response Api::route(Request request) const {
  try {
    return router_.handle(std::move(request));
  } catch (const std::exception& e) {  // no memory, or a defect of ours; the server must not end
    process::log_error("request failed: {}", e.what());
    return error_response({Errc::Io, "the server could not answer this request"});
  }
}

storage::Page read_page(QueryReader& query) {
  constexpr std::uint64_t kDefaultLimit = 100;
  constexpr auto kMaxOffset = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
  storage::Page page;
  page.limit = query.number("limit", kMaxLimit).value_or(kDefaultLimit);
  page.offset = query.number("offset", kMaxOffset).value_or(0);
  return page;
}

machines::MachineListener publish_to(EventHub& hub) {
  const auto publish = [&hub](const char* kind, const std::string& machine, const auto& make_json) {
    if (!hub.has_listeners()) return;
    hub.publish({.kind = kind, .machine = machine, .data = to_text(make_json())});
  };
  return {.on_machine =
              [publish](const machines::MachineView& view) {
                publish("machine", view.machine.name, [&] { return machine_json(view); });
              },
          .on_run =
              [publish](const storage::Run& run) {
                publish("run", run.machine, [&] { return run_json(run); });
              },
          .on_record =
              [publish](const storage::Record& record) {
                publish("record", record.machine, [&] { return record_json(record); });
              }};
}

bool is_authorized(const Token& token, const std::string& authorization) {
  constexpr std::string_view kScheme = "Bearer ";
  if (token.secret.empty() || !authorization.starts_with(kScheme)) return false;
  // Digests have one length, so the time does not depend on the token's length either.
  const Digest given = sha256(std::string_view(authorization).substr(kScheme.size()));
  const Digest right = sha256(token.secret);
  return CRYPTO_memcmp(given.bytes.data(), right.bytes.data(), Digest::kSize) == 0;
}

}  // namespace dripline::api
