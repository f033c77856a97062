// The body of POST /uploads/{id}/commit. Property: a digest that is taken prints as it was given.
#include <algorithm>
#include <cstdlib>
#include <string>

#include "server/api/bodies/program_bodies.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dripline;
  std::string text(reinterpret_cast<const char*>(data), size);
  const auto body = api::decode_commit(text);
  if (!body) return body.error().what.empty() ? (std::abort(), 0) : 0;
  // Hexadecimal digits may come as \u escapes, so only plain bodies can be compared.
  if (!body->sha256 || text.find('\\') != std::string::npos) return 0;
  std::ranges::transform(text, text.begin(), [](char c) {
    return c >= 'A' && c <= 'F' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  if (text.find(body->sha256->hex()) == std::string::npos) std::abort();
  return 0;
}
