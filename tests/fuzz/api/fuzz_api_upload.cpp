// The body of POST /uploads. Property: what is taken has a good program name and bounded texts.
#include <cstdlib>

#include "protocol/base/names.hpp"
#include "server/api/bodies/program_bodies.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dripline;
  const auto body = api::decode_upload({reinterpret_cast<const char*>(data), size});
  if (!body) return body.error().what.empty() ? (std::abort(), 0) : 0;
  if (!check_program_name(body->program)) std::abort();
  if (body->comment.size() > library::Programs::kMaxComment) std::abort();
  return 0;
}
