#include "clients/lib/client.hpp"
#include "clients/lib/impl/request.hpp"

namespace dripline::client {

using impl::with_number;
using impl::with_query;

Reply<std::string> Client::compare(const ComparisonQuery& query) {
  std::string path = impl::path_of("programs", query.first) + "/comparison";
  path = with_number(std::move(path), "revision", query.first_revision);
  path = with_query(std::move(path), "other", query.second);
  path = with_number(std::move(path), "other_revision", query.second_revision);
  path = with_query(std::move(path), "by", query.by);
  path = with_query(std::move(path), "machine", query.machine);
  path = with_query(std::move(path), "tolerance", fmt::format("{}", query.tolerance));
  return fetch_text(impl::get(with_number(std::move(path), "context", query.context)));
}

Reply<std::string> Client::check(const CheckQuery& query) {
  std::string path = impl::path_of("programs", query.program) + "/check";
  path = with_number(std::move(path), "revision", query.revision);
  return fetch_text(impl::get(with_query(std::move(path), "machine", query.machine)));
}

}  // namespace dripline::client
