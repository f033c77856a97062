#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "protocol/base/clock.hpp"
#include "protocol/base/result.hpp"

/// What is looked at before a certificate, a key or a signed document is used. All texts are PEM,
/// documents are S/MIME. Pure; any thread.
namespace dripline::pki {

/// Whether `key` is the private key of `certificate`. Errors: Syntax (not a key, or one with a
/// password; not a certificate), Denied (another certificate's).
Result<void> check_key(std::string_view certificate, std::string_view key);

struct Issue {
  std::string_view certificate, authority;
  std::optional<std::string_view> revocation_list = {};
};
/// Whether `authority` signed the certificate, it is valid at `now` and not revoked. Errors:
/// Syntax, Denied with the reason.
Result<void> check_issue(const Issue& issue, UtcTime now);

/// The text of a document that `authority` signed. Errors: Syntax (not S/MIME), Denied (another
/// signed it, or it was changed).
Result<std::string> open_document(std::string_view document, std::string_view authority);

}  // namespace dripline::pki
