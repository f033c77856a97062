#pragma once

#include <string>

#include "protocol/base/clock.hpp"

namespace dripline::feeds {

/// `20261121-081233-4f9a2c7d`: sorts by time, and the random end keeps two servers apart.
std::string make_run_id(UtcTime now);
/// 128 random bits, hexadecimal.
std::string make_order_id();

}  // namespace dripline::feeds
