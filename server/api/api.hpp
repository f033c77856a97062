#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "protocol/base/clock.hpp"
#include "server/api/access_control.hpp"
#include "server/api/events/event_hub.hpp"
#include "server/api/request_times.hpp"
#include "server/api/router.hpp"
#include "server/folders/folders.hpp"
#include "server/identity/accounts.hpp"
#include "server/imports/imports.hpp"
#include "server/library/attachments.hpp"
#include "server/library/audit_chain.hpp"
#include "server/library/audit_trail.hpp"
#include "server/library/backups.hpp"
#include "server/library/health.hpp"
#include "server/library/history/retention.hpp"
#include "server/library/history/run_history.hpp"
#include "server/library/job_queue.hpp"
#include "server/library/program_search.hpp"
#include "server/library/programs.hpp"
#include "server/library/releases.hpp"
#include "server/library/setups.hpp"
#include "server/machines/machine_control.hpp"
#include "server/measurements/measurements.hpp"
#include "server/mqtt/publisher.hpp"
#include "server/mqtt/sparkplug_node.hpp"
#include "server/offsets/offsets.hpp"
#include "server/paths/program_paths.hpp"
#include "server/ports/port_control.hpp"
#include "server/webhooks/webhooks.hpp"
#include "storage/cache/disk_cache.hpp"

namespace dripline::api {

/// The constant part of the answer to `GET /api/v1/server`.
struct ServerFacts {
  std::string name, version, data_dir;
  UtcTime started;
  std::uint32_t dds_domain = 0;
  std::optional<UtcTime> certificate_expires = {};      ///< nullopt: without TLS
  std::optional<UtcTime> dds_certificate_expires = {};  ///< nullopt: without DDS Security
};

/// Of a library that other servers wait for.
struct SharedLibrary {
  std::uint64_t term = 0;    ///< of this server
  bool has_standby = false;  ///< by the settings: another server should wait
  std::function<Result<std::vector<std::string>>()> waiting;  ///< the servers that do
  /// Whether it can be handed over to one of them, which are named. Errors: Conflict, Busy.
  std::function<Result<std::vector<std::string>>()> hand_over;
  std::function<void()> leave;  ///< does it, soon after it has returned
};

/// The services that the handlers use; all must outlive the Api.
struct Services {
  library::Programs& programs;
  library::Releases& releases;
  library::Attachments& attachments;
  library::ProgramSearch& search;
  library::Setups& setups;
  machines::MachineControl& machines;
  library::RunHistory& runs;
  library::JobQueue& jobs;
  paths::ProgramPaths& paths;
  library::AuditTrail& audit;
  library::AuditChain& chain;
  identity::Accounts& accounts;
  EventHub& events;
  const Clock& clock;
  ServerFacts facts;
  std::function<std::uint64_t()> dds_rejected;
  ports::PortControl* ports = nullptr;                 ///< null: a server without serial ports
  library::Health* health = nullptr;                   ///< null: always ok
  library::Backups* backups = nullptr;                 ///< null: a server that makes none
  imports::Imports* imports = nullptr;                 ///< null: a server without an import queue
  measurements::Measurements* measurements = nullptr;  ///< null: a server without measurements
  library::Retention* retention = nullptr;             ///< null: everything stays in the database
  offsets::Offsets* offsets = nullptr;                 ///< null: a server without offset proposals
  folders::Folders* folders = nullptr;                 ///< null: a server without hot folders
  webhooks::Webhooks* webhooks = nullptr;              ///< null: a server without webhooks
  mqtt::Publisher* publisher = nullptr;                ///< null: a server without a broker
  mqtt::SparkplugNode* sparkplug = nullptr;            ///< null: it is not spoken
  const cache::DiskCache* cache = nullptr;             ///< null: no program text on its own disk
  std::optional<SharedLibrary> shared = {};            ///< nullopt: this server's alone
  bool has_tls = false;                                ///< the sockets in front of it do
};

/// The REST API without its sockets: a request in, a response out. Any thread, several at once;
/// handlers wait for storage and for gateways, so never on a thread that serves sockets.
class Api {
 public:
  /// Every route must be in the table of route_permissions.
  explicit Api(Services services);
  Api(const Api&) = delete;  // the handlers refer to our services
  Api& operator=(const Api&) = delete;
  /// The answer that needs only the request's head, before its body is read and without waiting: of
  /// a caller who is not known or may not, of health and OpenAPI description, which anybody may
  /// read, and of what does not exist. Otherwise nullopt, and the caller is set in `head`.
  std::optional<Response> judge(Request& head) const;
  /// Calls `judge`, finds the handler and runs it. Never throws.
  Response handle(Request request) const;
  /// The largest body of a request that `judge` let pass.
  std::uint64_t max_body(const Request& head) const;
  /// Whether it is a command to a machine that may be a stop.
  bool may_stop(const Request& head) const;
  /// Whether it asks for machines or runs, of who may stop them.
  bool finds_run(const Request& head) const;
  /// Whether the request's handler waits for a machine.
  bool waits_for_machine(const Request& head) const { return router_.waits_for_machine(head); }
  const Router& router() const { return router_; }

  /// The largest piece of an upload; a body may be kMaxBody.
  static constexpr std::uint64_t kMaxPiece = 4 * 1024 * 1024;
  static constexpr std::uint64_t kMaxBody = kMaxPiece + 64 * 1024;
  /// Of any other request: the largest text is a report template.
  static constexpr std::uint64_t kMaxText = 320 * 1024;
  static constexpr std::uint64_t kMaxCommand = 16 * 1024;  ///< of one that may stop a machine

 private:
  /// Notes how long it took.
  Response route(Request request) const;
  Response answer(Request request) const;

  void protect(Router::Route& route);

  Services services_;
  mutable RequestTimes times_;
  AccessControl access_;
  Router router_;
};

/// The listener that publishes the machines' changes as events.
machines::MachineListener publish_to(EventHub& hub);

/// The listener that publishes the traffic of lines as events; for PortControl::on_traffic.
std::function<void(const ports::PortTraffic&)> publish_traffic_to(EventHub& hub);

/// The listener that publishes what happens in the import queue as events.
std::function<void(const storage::Import&)> publish_imports_to(EventHub& hub);

/// The listener that publishes the verdicts on parts as events.
std::function<void(const storage::MeasuredPart&)> publish_parts_to(EventHub& hub);

/// The listener that publishes offset proposals and what becomes of them as events.
std::function<void(const storage::OffsetProposal&)> publish_offsets_to(EventHub& hub);

/// The listener that publishes what happens to job queues as events.
std::function<void(const library::JobChange&)> publish_jobs_to(EventHub& hub);

/// The OpenAPI description, as JSON text.
std::string_view openapi_text();

// The handlers, a file for each kind of resource. `services` must outlive the router.

void add_server_routes(Router& router, Services& services);
void add_audit_routes(Router& router, Services& services);
void add_program_routes(Router& router, Services& services);
void add_release_routes(Router& router, Services& services);
void add_attachment_routes(Router& router, Services& services);
void add_search_routes(Router& router, Services& services);
void add_comparison_routes(Router& router, Services& services);
void add_check_routes(Router& router, Services& services);
void add_import_routes(Router& router, Services& services);
void add_measurement_routes(Router& router, Services& services);
void add_chart_routes(Router& router, Services& services);
void add_study_routes(Router& router, Services& services);
void add_template_trial_routes(Router& router, Services& services);
void add_offset_routes(Router& router, Services& services);
void add_report_template_routes(Router& router, Services& services);
void add_folder_routes(Router& router, Services& services);
void add_gateway_routes(Router& router, Services& services);
void add_webhook_routes(Router& router, Services& services);
void add_job_routes(Router& router, Services& services);
void add_upload_routes(Router& router, Services& services);
void add_machine_list_routes(Router& router, Services& services);
void add_machine_routes(Router& router, Services& services);
void add_jog_routes(Router& router, Services& services);
void add_run_routes(Router& router, Services& services);
void add_report_routes(Router& router, Services& services);
void add_setup_routes(Router& router, Services& services);
void add_memory_routes(Router& router, Services& services);
void add_port_routes(Router& router, Services& services);
void add_account_routes(Router& router, Services& services);
void add_backup_routes(Router& router, Services& services);
void add_archive_routes(Router& router, Services& services);
void add_certificate_routes(Router& router, Services& services);
void add_metrics_routes(Router& router, Services& services, const RequestTimes& times);

inline constexpr std::uint64_t kMaxLimit = 1000;  ///< entries in one answer
/// `limit` (default 100) and `offset`.
storage::Page read_page(QueryReader& query);
/// Gives a command to a run or a machine, and notes it in the audit trail.
Response carry_out(Services& services, const Request& request,
                   const machines::CommandRequest& command);
/// Of a path with `{number}`. Errors: Syntax.
Result<std::uint64_t> revision_number(const Request& request);

/// The upload that the request names, of its caller. Errors: those of Programs::upload.
Result<storage::Upload> own_upload(Services& services, const Request& request);
/// The answer when the hub has kMaxSubscriptions listeners.
Response too_many_listeners();

/// A handler that uses the services and nothing else.
inline Handler with(Services& services, Response (*handler)(Services&, const Request&)) {
  return [&services, handler](const Request& request) { return handler(services, request); };
}

/// `{"NAME": [...]}` with what `view` makes of each item, or the error.
template <class T, class View>
Response list_response(const char* name, const Result<std::vector<T>>& list, View view) {
  if (!list) return error_response(list.error());
  auto array = nlohmann::json::array();
  for (const auto& item : *list) array.push_back(view(item));
  return json_response(200, {{name, std::move(array)}});
}

/// What `view` makes of the value, or the error.
template <class T, class View>
Response value_response(int status, const Result<T>& value, View view) {
  return value ? json_response(status, view(*value)) : error_response(value.error());
}

/// No content, or the error.
inline Response empty_response(const Result<void>& done) {
  return done ? no_content() : error_response(done.error());
}

}  // namespace dripline::api
