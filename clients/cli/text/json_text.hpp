#pragma once

#include <optional>
#include <string>
#include <vector>

#include "clients/cli/context.hpp"
#include "clients/lib/api_json.hpp"

namespace dripline::cli {

/// JSON for `--json`: indented, with a line end; invalid UTF-8 is replaced.
inline std::string json_text(const nlohmann::ordered_json& json) {
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

/// One object on one line, for streams of them.
inline std::string json_line(const nlohmann::ordered_json& json) {
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

template <class T>
std::string json_text(const T& value) {
  return json_text(client::to_json_value(value));
}

/// `{"NAME": [...]}`, as the server's listings are.
template <class T>
std::string json_list_text(const char* name, const std::vector<T>& list) {
  auto array = nlohmann::ordered_json::array();
  for (const auto& item : list) array.push_back(client::to_json_value(item));
  return json_text(nlohmann::ordered_json{{name, std::move(array)}});
}

/// The exit status, when nothing is left to be printed: the call failed, or `reply` was printed as
/// JSON.
template <class T>
std::optional<int> finished(const Context& context, const client::Reply<T>& reply) {
  if (!reply) return complain(reply.error());
  if (!context.wants_json) return std::nullopt;
  context.print(json_text(*reply));
  return kExitOk;
}

/// The same for a listing, `{"NAME": [...]}`.
template <class T>
std::optional<int> finished(const Context& context, const client::Reply<std::vector<T>>& reply,
                            const char* name) {
  if (!reply) return complain(reply.error());
  if (!context.wants_json) return std::nullopt;
  context.print(json_list_text(name, *reply));
  return kExitOk;
}

}  // namespace dripline::cli
