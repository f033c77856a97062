#include "clients/cli/text/named_revision.hpp"

#include <charconv>

namespace dripline::cli {

NamedRevision named_revision(const std::string& text) {
  const std::size_t at = text.rfind('@');
  if (at == std::string::npos) return {text, std::nullopt};
  std::uint64_t number = 0;
  const char* end = text.data() + text.size();
  const auto read = std::from_chars(text.data() + at + 1, end, number);
  if (read.ec != std::errc{} || read.ptr != end) return {text, std::nullopt};
  return {text.substr(0, at), number};
}

}  // namespace dripline::cli
