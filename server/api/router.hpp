#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "server/api/request.hpp"
#include "server/api/response.hpp"

namespace dripline::api {

using Handler = std::function<Response(const Request&)>;

/// What a handler may wait for. Machines can take seconds, so each such request gets a thread.
enum class Waits { ForStorage, ForMachine };

struct RoutePermission;

/// Finds the handler of a method and a path. Patterns are written as in README.md:
/// `/api/v1/programs/{name}`; `{name}` matches one segment, never an empty one.
class Router {
 public:
  void add(std::string method, std::string_view pattern, Handler handler,
           Waits waits = Waits::ForStorage);
  /// Runs the handler. Without a route: 404, or 405 with Allow when only the method is wrong.
  Response handle(Request request) const;
  bool waits_for_machine(const Request& request) const;

  struct Route;
  /// Null: there is none for this method and path.
  const Route* find(const Request& request) const;
  /// Calls `change` with every route, before the first request.
  void change_routes(const std::function<void(Route&)>& change);

  struct Route {
    std::string method;
    std::string pattern;
    std::vector<std::string> segments;
    Handler handler;
    Waits waits = Waits::ForStorage;
    const RoutePermission* permission = nullptr;  ///< what it needs; set by the API
  };
  const std::vector<Route>& routes() const { return routes_; }

 private:
  std::vector<Route> routes_;
};

}  // namespace dripline::api
