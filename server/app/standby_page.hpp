#pragma once

#include <string>

#include "server/api/request.hpp"
#include "server/api/response.hpp"
#include "server/app/standby_faults.hpp"

namespace dripline::app {

/// The server that has the library, as far as it is known; old where the database cannot be
/// reached.
struct ActiveServer {
  std::string name = {};  ///< for people; empty: not known
  std::string url = {};   ///< empty: not known
};

/// A browser that was sent to this server: it asks for a page, and not for the API.
bool wants_page(const api::Request& request);

/// A page in the language that the browser prefers (German or English), which names the server that
/// has the library, links to it and loads itself again until this server has the library. It has
/// nothing of the shop and no script. Status 503.
api::Response standby_page(const ActiveServer& active, const StandbyFaults& faults,
                           const api::Request& request);

}  // namespace dripline::app
