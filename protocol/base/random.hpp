#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace dripline {

/// Unpredictable random bits from the system's generator; without it the process ends. Any thread.
std::uint64_t random_number();
/// `bytes` random bytes as twice as many hexadecimal digits.
std::string random_hex(std::size_t bytes);

}  // namespace dripline
