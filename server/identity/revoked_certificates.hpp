#pragma once

#include <set>
#include <string>
#include <string_view>

#include "protocol/base/result.hpp"

namespace dripline::identity {

/// The serials of clients' certificates that are worth nothing any more: one a line, hexadecimal,
/// with or without colons and leading zeros; `#` begins a comment. In the form of
/// ClientCertificate::serial. Errors: Syntax, with the line.
Result<std::set<std::string>> parse_revoked(std::string_view text);
/// Errors: also NotFound (it cannot be read), LimitExceeded (more than 1 MiB).
Result<std::set<std::string>> read_revoked(const std::string& file);

}  // namespace dripline::identity
