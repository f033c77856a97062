// The calls of Client for the setups of controls: tools, offsets, parameters.
#include "clients/lib/api_json.hpp"
#include "clients/lib/client.hpp"
#include "clients/lib/impl/request.hpp"

namespace dripline::client {

using impl::get;
using impl::path_of;
using impl::with_method;
using impl::with_query;

Reply<std::vector<Setup>> Client::setups(std::string_view machine, Page page) {
  std::string path = path_of("machines", machine) + "/setups";
  path = with_query(std::move(path), "limit", std::to_string(page.limit));
  return fetch_list<Setup>(with_query(std::move(path), "offset", std::to_string(page.offset)),
                           "setups");
}

Reply<Setup> Client::setup(std::string_view machine, std::optional<std::uint64_t> revision) {
  const std::string number = revision ? std::to_string(*revision) : "";
  return fetch<Setup>(get(with_query(path_of("machines", machine) + "/setup", "revision", number)));
}

Reply<Setup> Client::save_setup(const SetupRequest& request) {
  std::string path = path_of("machines", request.machine) + "/setup";
  path = with_query(std::move(path), "comment", request.comment);
  path = with_query(std::move(path), "base", request.base ? std::to_string(*request.base) : "");
  HttpRequest http = with_method("PUT", with_query(std::move(path), "control", request.control));
  http.body = request.text;
  http.content_type = "application/toml";
  return fetch<Setup>(http);
}

Reply<std::vector<Memory>> Client::memories(std::string_view machine, std::string_view run,
                                            Page page) {
  std::string path = path_of("machines", machine) + "/memory";
  path = with_query(std::move(path), "run", std::string(run));
  path = with_query(std::move(path), "limit", std::to_string(page.limit));
  return fetch_list<Memory>(with_query(std::move(path), "offset", std::to_string(page.offset)),
                            "memories");
}

}  // namespace dripline::client
