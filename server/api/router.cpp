#include "server/api/router.hpp"

#include <fmt/ranges.h>
#include <algorithm>
#include <optional>

namespace dripline::api {
namespace {

bool is_placeholder(const std::string& segment) {
  return segment.size() > 2 && segment.front() == '{' && segment.back() == '}';
}

using Parameters = std::map<std::string, std::string>;

std::optional<Parameters> match(const std::vector<std::string>& pattern,
                                const std::vector<std::string>& path) {
  if (pattern.size() != path.size()) return std::nullopt;
  Parameters parameters;
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (is_placeholder(pattern[i])) {
      if (path[i].empty()) return std::nullopt;
      parameters[pattern[i].substr(1, pattern[i].size() - 2)] = path[i];
    } else if (pattern[i] != path[i]) {
      return std::nullopt;
    }
  }
  return parameters;
}

}  // namespace

void Router::add(std::string method, std::string_view pattern, Handler handler, Waits waits) {
  const auto target = parse_target(pattern);
  routes_.push_back({.method = std::move(method),
                     .pattern = std::string(pattern),
                     .segments = target.value().segments,
                     .handler = std::move(handler),
                     .waits = waits});
}

const Router::Route* Router::find(const Request& request) const {
  const auto found = std::ranges::find_if(routes_, [&](const Route& route) {
    return route.method == request.method && match(route.segments, request.target.segments);
  });
  return found == routes_.end() ? nullptr : &*found;
}

void Router::change_routes(const std::function<void(Route&)>& change) {
  for (auto& route : routes_) change(route);
}

bool Router::waits_for_machine(const Request& request) const {
  return std::ranges::any_of(routes_, [&](const Route& route) {
    return route.waits == Waits::ForMachine && route.method == request.method &&
           match(route.segments, request.target.segments);
  });
}

Response Router::handle(Request request) const {
  std::vector<std::string> allowed;
  for (const auto& route : routes_) {
    auto parameters = match(route.segments, request.target.segments);
    if (!parameters) continue;
    if (route.method != request.method) {
      allowed.push_back(route.method);
      continue;
    }
    request.parameters = *std::move(parameters);
    return route.handler(request);
  }
  const std::string path = fmt::format("/{}", fmt::join(request.target.segments, "/"));
  if (allowed.empty()) {
    return error_response({Errc::NotFound, fmt::format("there is nothing at '{}'", path)});
  }
  constexpr int kMethodNotAllowed = 405;
  const std::string methods = fmt::format("{}", fmt::join(allowed, ", "));
  Response response = error_response(
      kMethodNotAllowed,
      {Errc::Unsupported, fmt::format("'{}' takes {}, not {}", path, methods, request.method)});
  response.headers.emplace_back("Allow", methods);
  return response;
}

}  // namespace dripline::api
