#pragma once

#include <cstdint>
#include <string>

#include "protocol/base/digest.hpp"

namespace dripline::migration {

struct TableDigest {
  std::uint64_t rows = 0;
  Digest sha256{};
  bool operator==(const TableDigest&) const = default;
};

struct VerifiedTable {
  std::string name;
  TableDigest digest;
};

}  // namespace dripline::migration
