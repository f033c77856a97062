#include "server/api/api.hpp"

#include <algorithm>
#include <array>
#include <charconv>

#include <nlohmann/json.hpp>

#include "protocol/process/log.hpp"
#include "server/api/views.hpp"

namespace dripline::api {
namespace {

/// A client that found no server at once says for how long it has tried: it can only make what it
/// asks for older.
std::chrono::milliseconds age_of(const Request& head) {
  const auto found = head.headers.find("dripline-age");
  if (found == head.headers.end()) return {};
  const std::string& text = found->second;
  std::uint32_t age = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), age);
  return std::chrono::milliseconds(read.ec == std::errc() ? age : 0);
}

}  // namespace

Api::Api(Services services)
    : services_(std::move(services)),
      access_({.accounts = services_.accounts,
               .runs = services_.runs,
               .machines = services_.machines,
               .ports = services_.ports,
               .has_tls = services_.has_tls}) {
  add_server_routes(router_, services_);
  add_audit_routes(router_, services_);
  add_program_routes(router_, services_);
  add_release_routes(router_, services_);
  add_attachment_routes(router_, services_);
  add_search_routes(router_, services_);
  add_comparison_routes(router_, services_);
  add_check_routes(router_, services_);
  add_import_routes(router_, services_);
  add_measurement_routes(router_, services_);
  add_chart_routes(router_, services_);
  add_study_routes(router_, services_);
  add_template_trial_routes(router_, services_);
  add_offset_routes(router_, services_);
  add_report_template_routes(router_, services_);
  add_archive_routes(router_, services_);
  add_folder_routes(router_, services_);
  add_gateway_routes(router_, services_);
  add_webhook_routes(router_, services_);
  add_job_routes(router_, services_);
  add_upload_routes(router_, services_);
  add_machine_list_routes(router_, services_);
  add_machine_routes(router_, services_);
  add_jog_routes(router_, services_);
  add_run_routes(router_, services_);
  add_report_routes(router_, services_);
  add_setup_routes(router_, services_);
  add_memory_routes(router_, services_);
  add_port_routes(router_, services_);
  add_account_routes(router_, services_);
  add_backup_routes(router_, services_);
  add_certificate_routes(router_, services_);
  add_metrics_routes(router_, services_, times_);
  router_.change_routes([this](Router::Route& route) { protect(route); });
}

/// A route without a permission must not be served, not even by mistake.
void Api::protect(Router::Route& route) {
  route.permission = find_permission(route.method, route.pattern);
  if (route.permission == nullptr) {
    process::log_error("{} {} names no permission", route.method, route.pattern);
    std::abort();
  }
  if (route.permission->machine == MachineIn::Nowhere) return;
  route.handler = [this, row = route.permission,
                   handler = std::move(route.handler)](const Request& request) {
    if (auto refused = access_.judge_machine(request, *row)) return *std::move(refused);
    return handler(request);
  };
}

std::optional<Response> Api::judge(Request& head) const {
  if (head.given == SteadyTime{}) head.given = services_.clock.steady_now() - age_of(head);
  const Router::Route* const found = router_.find(head);
  if (auto refused = access_.judge(head, found)) return refused;
  if (found == nullptr) return route(head);
  const bool is_open = found->permission->permission == identity::Permission::Open;
  // Health and description do not wait, and are answered when every worker is busy.
  if (is_open && head.method == "GET") return route(head);
  return std::nullopt;
}

std::uint64_t Api::max_body(const Request& head) const {
  const Router::Route* const found = router_.find(head);
  if (found == nullptr) return 0;
  switch (found->permission->body) {
    case BodyKind::Text:
      return kMaxText;
    case BodyKind::Piece:
      return kMaxBody;
    case BodyKind::Command:
      return kMaxCommand;
  }
  return 0;
}

bool Api::may_stop(const Request& head) const {
  const Router::Route* const found = router_.find(head);
  return found != nullptr && found->permission->body == BodyKind::Command;
}

bool Api::finds_run(const Request& head) const {
  constexpr std::array<std::string_view, 3> kPatterns{"/api/v1/machines", "/api/v1/runs",
                                                      "/api/v1/runs/{id}"};
  if (head.method != "GET" || !head.caller) return false;
  const Router::Route* const found = router_.find(head);
  return found != nullptr && std::ranges::find(kPatterns, found->pattern) != kPatterns.end() &&
         head.caller->role >= *identity::lowest_role(identity::Permission::Operate);
}

Response Api::handle(Request request) const {
  if (auto judged = judge(request)) return *std::move(judged);
  const auto caller = request.caller;
  Response response = route(std::move(request));
  if (response.events && caller) {
    response.is_allowed = [&accounts = services_.accounts, caller = *caller] {
      return accounts.is_valid(caller);
    };
  }
  return response;
}

Response Api::route(Request request) const {
  const Router::Route* const found = router_.find(request);
  const std::string name = found == nullptr ? "none" : found->method + " " + found->pattern;
  const auto begun = services_.clock.steady_now();
  Response response = answer(std::move(request));
  times_.add(name, services_.clock.steady_now() - begun);
  return response;
}

Response Api::answer(Request request) const {
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
  const auto publish = [&hub](const char* kind, const std::string& machine, const auto& make_text) {
    if (!hub.has_listeners(machine)) return;
    hub.publish({.kind = kind, .machine = machine, .data = make_text()});
  };
  return {.on_machine =
              [publish](const machines::MachineView& view) {
                publish("machine", view.machine.name, [&] { return machine_text(view); });
              },
          .on_run =
              [publish](const storage::Run& run) {
                publish("run", run.machine, [&] { return to_text(run_json(run)); });
              },
          .on_record =
              [publish](const storage::Record& record) {
                publish("record", record.machine, [&] { return to_text(record_json(record)); });
              }};
}

}  // namespace dripline::api
