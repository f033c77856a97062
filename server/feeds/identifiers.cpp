#include "server/feeds/identifiers.hpp"

#include <fmt/chrono.h>
#include <openssl/rand.h>
#include <array>

#include "protocol/base/invariant.hpp"

namespace dripline::feeds {
namespace {

template <std::size_t N>
std::string random_hex() {
  std::array<unsigned char, N> bytes{};
  invariant(RAND_bytes(bytes.data(), static_cast<int>(N)) == 1, "random numbers are available");
  std::string text;
  for (const unsigned char b : bytes) fmt::format_to(std::back_inserter(text), "{:02x}", b);
  return text;
}

}  // namespace

std::string make_run_id(UtcTime now) {
  const auto seconds = std::chrono::floor<std::chrono::seconds>(now);
  return fmt::format("{}-{:%Y%m%d-%H%M%S}", random_hex<4>(),
                     fmt::gmtime(std::chrono::system_clock::to_time_t(seconds)));
}

std::string make_order_id() {
  return random_hex<16>();
}

}  // namespace dripline::feeds
