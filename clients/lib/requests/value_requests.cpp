// The calls of Client for the values of a machine's control.
#include "clients/lib/client.hpp"
#include "clients/lib/impl/request.hpp"

namespace dripline::client {

Reply<ControlValues> Client::control_values(std::string_view machine, std::string_view beginning,
                                            std::uint64_t offset) {
  std::string path = impl::path_of("machines", machine) + "/values";
  path = impl::with_query(std::move(path), "beginning", beginning);
  if (offset > 0) path = impl::with_query(std::move(path), "offset", std::to_string(offset));
  return fetch<ControlValues>(impl::get(path));
}

}  // namespace dripline::client
