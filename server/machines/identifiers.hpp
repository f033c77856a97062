#pragma once

#include <string>

#include "protocol/base/clock.hpp"

namespace dripline::machines {

/// `4f9a2c7d-20261121-081233`: the first eight digits, random, tell runs apart where there is
/// little room to show more; the time is for people.
std::string make_run_id(UtcTime now);
/// 128 random bits, hexadecimal.
std::string make_command_id();

}  // namespace dripline::machines
