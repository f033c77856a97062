#include "clients/lib/client.hpp"
#include "clients/lib/impl/request.hpp"

namespace dripline::client {

using impl::with_query;

Reply<std::string> Client::compare(const ComparisonQuery& query) {
  const auto number = [](const std::optional<std::uint64_t>& revision) {
    return revision ? std::to_string(*revision) : std::string();
  };
  std::string path = impl::path_of("programs", query.first) + "/comparison";
  path = with_query(std::move(path), "revision", number(query.first_revision));
  path = with_query(std::move(path), "other", query.second);
  path = with_query(std::move(path), "other_revision", number(query.second_revision));
  path = with_query(std::move(path), "by", query.by);
  path = with_query(std::move(path), "machine", query.machine);
  path = with_query(std::move(path), "tolerance", fmt::format("{}", query.tolerance));
  path = with_query(std::move(path), "context", std::to_string(query.context));
  auto response = exchange(impl::get(std::move(path)));
  if (!response) return failed(response.error());
  return std::move(response->body);
}

Reply<std::string> Client::check(const CheckQuery& query) {
  std::string path = impl::path_of("programs", query.program) + "/check";
  if (query.revision)
    path = with_query(std::move(path), "revision", std::to_string(*query.revision));
  path = with_query(std::move(path), "machine", query.machine);
  auto response = exchange(impl::get(std::move(path)));
  if (!response) return failed(response.error());
  return std::move(response->body);
}

}  // namespace dripline::client
