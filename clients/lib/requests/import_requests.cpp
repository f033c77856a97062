// The calls of Client for the import queue.
#include <nlohmann/json.hpp>

#include "clients/lib/api_json.hpp"
#include "clients/lib/client.hpp"
#include "clients/lib/impl/request.hpp"

namespace dripline::client {

using impl::dumped;
using impl::get;
using impl::path_of;
using impl::with_method;
using impl::with_page;
using impl::with_query;

namespace {

std::string import_path(std::string_view program, std::uint64_t revision,
                        std::string_view rest = "") {
  return fmt::format("{}/{}{}", path_of("imports", program), revision, rest);
}

}  // namespace

Reply<std::vector<Import>> Client::imports(bool is_pending, Page page) {
  const std::string path =
      with_query(path_of("imports"), "state", is_pending ? "pending" : "decided");
  return fetch_list<Import>(with_page(path, page), "imports");
}

Reply<std::string> Client::import(std::string_view program, std::uint64_t revision) {
  return fetch_text(get(import_path(program, revision)));
}

Reply<Revision> Client::accept_import(const AcceptRequest& request) {
  nlohmann::json body = nlohmann::json::object();
  if (!request.target.empty()) body["as"] = request.target;
  if (!request.comment.empty()) body["comment"] = request.comment;
  return fetch<Revision>(
      with_method("POST", import_path(request.program, request.revision, "/accept")), dumped(body));
}

Reply<void> Client::reject_import(const DecisionRequest& request) {
  return perform(with_method("POST", import_path(request.program, request.revision, "/reject")),
                 dumped({{"reason", request.comment}}));
}

}  // namespace dripline::client
