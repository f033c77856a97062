// The calls of Client for setups.
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
using impl::with_page;
using impl::with_query;

Reply<std::vector<Setup>> Client::setups(std::string_view machine, Page page) {
  return fetch_list<Setup>(with_page(path_of("machines", machine) + "/setups", page), "setups");
}

Reply<Setup> Client::setup(std::string_view machine, std::optional<std::uint64_t> revision) {
  const std::string path = path_of("machines", machine) + "/setup";
  return fetch<Setup>(get(with_number(path, "revision", revision)));
}

Reply<Setup> Client::save_setup(const SetupRequest& request) {
  std::string path = path_of("machines", request.machine) + "/setup";
  path = with_query(std::move(path), "comment", request.comment);
  path = with_number(std::move(path), "base", request.base);
  HttpRequest http = with_method("PUT", with_query(std::move(path), "control", request.control));
  http.content_type = "application/toml";
  return fetch<Setup>(http, request.text);
}

Reply<LoadedSetup> Client::loaded_setup(std::string_view machine) {
  return fetch<LoadedSetup>(get(path_of("machines", machine) + "/setup/loaded"));
}

Reply<LoadedSetup> Client::note_loaded_setup(std::string_view machine,
                                             std::optional<std::uint64_t> revision) {
  auto json = nlohmann::json::object();
  if (revision) json["revision"] = *revision;
  return fetch<LoadedSetup>(with_method("PUT", path_of("machines", machine) + "/setup/loaded"),
                            dumped(json));
}

}  // namespace dripline::client
