#pragma once

#include <cstdint>
#include <string>

namespace dripline::differential {

/// A program that mixes arcs, planes, offsets, compensation, cycles, expressions and O words; most
/// are right, some are wrong in one place. The same number gives the same program everywhere.
std::string make_program(std::uint64_t number);

}  // namespace dripline::differential
