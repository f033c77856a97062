#pragma once

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
/// The answer when the hub has kMaxSubscriptions listeners.
Response too_many_listeners();

}  // namespace dripline::api
