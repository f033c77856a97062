#pragma once

#include <cstdint>

namespace dripline::storage {

/// A part of a long list.
struct Page {
  std::uint64_t limit = 100;
  std::uint64_t offset = 0;
};

}  // namespace dripline::storage
