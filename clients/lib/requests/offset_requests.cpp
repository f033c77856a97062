// The calls of Client for offset proposals. Answers are the server's JSON.
#include <nlohmann/json.hpp>

#include "clients/lib/api_json.hpp"
#include "clients/lib/client.hpp"
#include "clients/lib/impl/request.hpp"

namespace dripline::client {

using impl::dumped;
using impl::get;
using impl::path_of;
using impl::with_method;
using impl::with_number;
using impl::with_query;

Reply<std::string> Client::offsets(const OffsetQuery& query) {
  std::string path = path_of("offsets");
  path = with_query(std::move(path), "machine", query.machine);
  path = with_query(std::move(path), "target", query.target);
  path = with_query(std::move(path), "state", query.state);
  return fetch_text(get(with_number(std::move(path), "limit", query.limit)));
}

Reply<std::string> Client::offset(std::uint64_t id) {
  return fetch_text(get(path_of("offsets", std::to_string(id))));
}

Reply<std::string> Client::decide_offset(std::string_view machine, std::uint64_t id,
                                         std::string_view decision, const std::string& comment) {
  nlohmann::json body = nlohmann::json::object();
  if (!comment.empty()) body["comment"] = comment;
  std::string path = path_of("machines", machine) + "/offsets/" + std::to_string(id) + "/";
  return fetch_text(with_method("POST", path.append(decision)), dumped(body));
}

Reply<std::string> Client::evaluate_offsets(std::string_view machine) {
  return fetch_text(with_method("POST", path_of("machines", machine) + "/offsets/evaluation"));
}

Reply<std::string> Client::offset_rules(std::string_view machine) {
  return fetch_text(get(path_of("machines", machine) + "/offset-rules"));
}

Reply<std::string> Client::save_offset_rules(std::string_view machine, std::string_view text) {
  HttpRequest request = with_method("PUT", path_of("machines", machine) + "/offset-rules");
  request.content_type = "application/toml";
  return fetch_text(std::move(request), text);
}

Reply<std::string> Client::offset_history(std::string_view machine, std::string_view target,
                                          std::uint64_t limit) {
  std::string path = path_of("machines", machine) + "/offset-history";
  path = with_query(std::move(path), "target", target);
  return fetch_text(get(with_number(std::move(path), "limit", limit)));
}

Reply<std::string> Client::offsets_of_run(std::string_view run) {
  return fetch_text(get(path_of("runs", run) + "/offsets"));
}

}  // namespace dripline::client
