#pragma once

#include <string>
#include <string_view>

/// PostgreSQL's text is UTF-8 without NUL; what machines print and people name is any bytes, and a
/// record is never refused for them. So a byte that is no part of such text is stored as one of the
/// 256 characters from U+F700 (of private use); the bytes of these characters themselves, too.
/// Every text comes back as it was, byte for byte; nearly every one is stored as it is. The
/// function hex() of the schema knows the same characters.
namespace dripline::storage::postgresql {

std::string to_stored(std::string_view text);
std::string from_stored(std::string_view stored);

}  // namespace dripline::storage::postgresql
