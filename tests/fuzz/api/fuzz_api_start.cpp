// The body of POST /runs. Property: names that are taken are good names.
#include <cstdlib>

#include "protocol/base/names.hpp"
#include "server/api/bodies/run_bodies.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dripline;
  const auto body = api::decode_start({reinterpret_cast<const char*>(data), size});
  if (!body) return body.error().what.empty() ? (std::abort(), 0) : 0;
  if (!check_machine_name(body->machine) || !check_program_name(body->program)) std::abort();
  return 0;
}
