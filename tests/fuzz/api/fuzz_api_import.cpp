// The bodies of POST /imports/.../accept and reject. Properties: what is taken is within its
// bounds, and a refusal has a text.
#include <cstdlib>

#include "protocol/base/names.hpp"
#include "server/api/bodies/program_bodies.hpp"
#include "server/library/releases.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dripline;
  const std::string_view body(reinterpret_cast<const char*>(data), size);
  const auto acceptance = api::decode_acceptance(body);
  if (!acceptance && acceptance.error().what.empty()) std::abort();
  if (acceptance && acceptance->reason.size() > library::Releases::kMaxComment) std::abort();
  if (acceptance && !acceptance->target.empty() && !check_program_name(acceptance->target))
    std::abort();
  const auto rejection = api::decode_rejection(body);
  if (!rejection && rejection.error().what.empty()) std::abort();
  if (rejection && rejection->size() > library::Releases::kMaxComment) std::abort();
  return 0;
}
