#include "protocol/base/random.hpp"

#include <fmt/format.h>
#include <openssl/rand.h>
#include <iterator>
#include <vector>

#include "protocol/base/invariant.hpp"

namespace dripline {
namespace {

void fill(unsigned char* bytes, std::size_t size) {
  invariant(RAND_bytes(bytes, static_cast<int>(size)) == 1, "random numbers are available");
}

}  // namespace

std::uint64_t random_number() {
  std::uint64_t number = 0;
  fill(reinterpret_cast<unsigned char*>(&number), sizeof number);
  return number;
}

std::string random_hex(std::size_t bytes) {
  std::vector<unsigned char> random(bytes);
  fill(random.data(), random.size());
  std::string text;
  for (const unsigned char byte : random) text += fmt::format("{:02x}", byte);
  return text;
}

}  // namespace dripline
