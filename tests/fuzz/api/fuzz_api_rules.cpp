// The body of POST /ports/{name}/test-rules. Property: what is taken is a text within its limit.
#include <cstdlib>

#include "server/api/bodies/port_bodies.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dripline;
  const auto text = api::decode_rules_text({reinterpret_cast<const char*>(data), size});
  if (!text) return text.error().what.empty() ? (std::abort(), 0) : 0;
  if (text->size() > api::kMaxRulesText || text->find('\0') != std::string::npos) std::abort();
  return 0;
}
