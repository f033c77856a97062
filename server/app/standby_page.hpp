#pragma once

#include <string>

#include "server/api/request.hpp"
#include "server/api/response.hpp"

namespace dripline::app {

/// What the page of a server that waits says.
struct StandbyPageFacts {
  std::string active;             ///< for people: the server that has the library; empty: not known
  std::string url;                ///< of that server; empty: not known
  bool is_database_lost = false;  ///< so that the two above may be old
  bool is_blocked = false;        ///< a UDP port of it is in use: it cannot take over
  bool lacks_agent = false;       ///< it would take over without its MTConnect agent
  bool has_other_network = false;   ///< its gateways are others': it cannot take over
  bool has_other_settings = false;  ///< than the server that has the library
  bool lacks_disk = false;
};

/// A browser that was sent to this server: it asks for a page, and not for the API.
bool wants_page(const api::Request& request);

/// A page in the language that the browser prefers (German or English), which names the server that
/// has the library, links to it and loads itself again until this server has the library. It has
/// nothing of the shop and no script. Status 503.
api::Response standby_page(const StandbyPageFacts& facts, const api::Request& request);

}  // namespace dripline::app
