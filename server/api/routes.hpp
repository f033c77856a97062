#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "server/api/api.hpp"

/// The handlers, a file for each kind of resource. `services` must outlive the router.
namespace dripline::api {

void add_server_routes(Router& router, Services& services);
void add_program_routes(Router& router, Services& services);
void add_upload_routes(Router& router, Services& services);
void add_machine_routes(Router& router, Services& services);
void add_run_routes(Router& router, Services& services);
void add_report_routes(Router& router, Services& services);
void add_setup_routes(Router& router, Services& services);
void add_memory_routes(Router& router, Services& services);
void add_port_routes(Router& router, Services& services);

inline constexpr std::uint64_t kMaxLimit = 1000;  ///< entries in one answer
/// `limit` (default 100) and `offset`.
storage::Page read_page(QueryReader& query);
/// Gives a command to a run or a machine, and notes it in the audit trail.
Response carry_out(Services& services, const Request& request,
                   const machines::CommandRequest& command);
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
