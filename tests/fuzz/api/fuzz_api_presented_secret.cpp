// The header fields Authorization and Cookie. Properties: a secret has the right length, is part of
// what was sent and has nothing in it that ends a header field; a cookie after a bearer is not
// read.
#include <cstdlib>
#include <string>

#include "server/identity/presented_secret.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dripline::identity;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const std::size_t cut = std::min(text.find('\n'), size);
  const std::string_view authorization = text.substr(0, cut);
  const std::string_view cookies = text.substr(std::min(cut + 1, size));
  const auto read = read_presented(authorization, cookies, "dripline");
  const std::string& secret = read.secret;
  if (!secret.empty() && (secret.size() < kMinSecret || secret.size() > kMaxSecret)) std::abort();
  if (text.find(secret) == std::string_view::npos) std::abort();
  if (secret.find_first_of(" ;,\"\r\n\t") != std::string::npos) std::abort();
  using From = PresentedSecret::From;
  if (!authorization.empty() && read.from != From::Bearer) std::abort();
  if (read.from == From::Nothing && !secret.empty()) std::abort();
  return 0;
}
