#pragma once

#include <cstddef>

namespace dripline::test {

/// Calls of operator new so far. A program that uses this gets its operator new replaced by one
/// that counts: link `dripline_test_allocation_counter` into a test program of its own.
std::size_t allocations();

}  // namespace dripline::test
