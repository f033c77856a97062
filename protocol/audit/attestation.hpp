#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "protocol/base/signature.hpp"

/// What a server states of a run, signed, to be checked without the server: lines of a name, a
/// blank and a value that is escaped, then its key and its signature of all lines before.
namespace dripline::audit {

struct Fact {
  std::string name;  ///< small letters and _
  std::string value;
  friend bool operator==(const Fact&, const Fact&) = default;
};

/// With its signature.
std::string attestation_text(const std::vector<Fact>& facts, const SigningKey& key);

struct Attestation {
  std::vector<Fact> facts;
  PublicKey key;  ///< that has signed it

  /// Empty: there is none of this name.
  std::string_view value(std::string_view name) const;
};
/// Errors: Syntax, LimitExceeded (kMaxAttestation), Corrupt (the key beside it has not signed it).
Result<Attestation> parse_attestation(std::string_view text);

inline constexpr std::size_t kMaxAttestation = 64 * 1024;

}  // namespace dripline::audit
