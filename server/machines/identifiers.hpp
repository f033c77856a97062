#pragma once

#include <string>

#include "protocol/base/clock.hpp"

namespace dripline::machines {

/// `4f9a2c7d-20261121-081233`: the first eight digits are random and distinguish runs where there
/// is little room; the time is for people.
std::string make_run_id(UtcTime now);
/// 128 random bits, hexadecimal.
std::string make_command_id();

}  // namespace dripline::machines
