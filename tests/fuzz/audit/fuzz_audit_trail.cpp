// An exported audit trail, and a kept checkpoint. Properties: how it is cut changes nothing; an
// entry that is read is written alike.
#include <cstdint>
#include <cstdlib>

#include "protocol/audit/attestation.hpp"
#include "protocol/audit/trail_file.hpp"

namespace {

using namespace dripline;

std::string verdict_of(std::string_view text, std::size_t piece) {
  audit::TrailReader reader;
  Result<void> read;
  for (std::size_t at = 0; read && at < text.size(); at += piece)
    read = reader.feed(text.substr(at, piece));
  if (read) read = reader.finish();
  std::string verdict = read ? "good" : read.error().what;
  if (reader.verifier() && reader.verifier()->first_fault())
    verdict += reader.verifier()->first_fault()->what;
  return verdict;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  if (verdict_of(text, size + 1) != verdict_of(text, 5)) std::abort();
  static_cast<void>(audit::parse_kept_checkpoint(text));
  static_cast<void>(audit::parse_attestation(text));
  const auto entry = audit::parse_entry(text);
  if (entry && audit::line_of(*entry) != text) std::abort();
  return 0;
}
