// The body of POST /programs/{name}/revisions/{number}/release. Properties: what is taken is within
// its bounds and names programs, and a refusal has a text.
#include <cstdlib>

#include "protocol/base/names.hpp"
#include "server/api/bodies/program_bodies.hpp"
#include "server/library/releases.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dripline;
  const auto release = api::decode_release({reinterpret_cast<const char*>(data), size});
  if (!release) return release.error().what.empty() ? std::abort(), 0 : 0;
  if (release->comment.size() > library::Releases::kMaxComment) std::abort();
  if (release->named.size() > storage::Decision::kMaxPins) std::abort();
  if (!release->has_closure && !(release->named.empty() && release->machine.empty())) std::abort();
  for (const auto& named : release->named) {
    if (!check_program_name(named.program)) std::abort();
  }
  return 0;
}
