#include "protocol/audit/attestation.hpp"

#include <algorithm>

#include "protocol/audit/escape.hpp"

namespace dripline::audit {
namespace {

constexpr std::string_view kAttestation = "dripline run attestation 1\n", kKeyName = "public_key",
                           kSignatureName = "signature";

/// The next line as name and value; its end is taken too. Errors: Syntax.
Result<Fact> take_fact(std::string_view& text) {
  const auto end = text.find('\n');
  const auto line = text.substr(0, end);
  const auto blank = line.find(' ');
  if (end == std::string_view::npos || blank == 0 || blank == std::string_view::npos)
    return fail(Errc::Syntax, "'{}' is not a name and a value", escaped(line));
  const bool is_name = std::ranges::all_of(line.substr(0, blank), [](char c) {
    return c == '_' || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
  });
  auto value = unescaped(line.substr(blank + 1));
  if (!is_name || !value)
    return fail(Errc::Syntax, "'{}' is not a name and a value", escaped(line));
  text.remove_prefix(end + 1);
  return Fact{std::string(line.substr(0, blank)), *std::move(value)};
}

std::string line_of(const Fact& fact) {
  return fmt::format("{} {}\n", fact.name, escaped(fact.value));
}

}  // namespace

std::string attestation_text(const std::vector<Fact>& facts, const SigningKey& key) {
  std::string text(kAttestation);
  for (const Fact& fact : facts) text += line_of(fact);
  text += line_of({std::string(kKeyName), key.public_key().hex()});
  return text + line_of({std::string(kSignatureName), key.sign(text).hex()});
}

std::string_view Attestation::value(std::string_view name) const {
  const auto found = std::ranges::find(facts, name, &Fact::name);
  return found == facts.end() ? std::string_view() : std::string_view(found->value);
}

Result<Attestation> parse_attestation(std::string_view text) {
  if (text.size() > kMaxAttestation) {
    return fail(Errc::LimitExceeded, "an attestation has at most {} bytes, this has {}",
                kMaxAttestation, text.size());
  }
  if (!text.starts_with(kAttestation)) return fail(Errc::Syntax, "not the attestation of a run");
  Attestation attestation;
  std::string_view rest = text.substr(kAttestation.size());
  for (;;) {
    const std::size_t signed_bytes = text.size() - rest.size();
    auto fact = take_fact(rest);
    if (!fact) return fail(fact.error());
    if (fact->name != kSignatureName) {
      attestation.facts.push_back(*std::move(fact));
      continue;
    }
    if (!rest.empty()) return fail(Errc::Syntax, "something follows the signature");
    if (attestation.facts.empty() || attestation.facts.back().name != kKeyName)
      return fail(Errc::Syntax, "there is no key before the signature");
    const auto key = parse_public_key(attestation.facts.back().value);
    if (!key) return fail(key.error());
    const auto signature = parse_signature(fact->value);
    if (!signature) return fail(signature.error());
    attestation.facts.pop_back();
    attestation.key = *key;
    if (is_signed_by(*key, text.substr(0, signed_bytes), *signature)) return attestation;
    return fail(Errc::Corrupt, "it was changed: the key {} has not signed this", key->hex());
  }
}

}  // namespace dripline::audit
