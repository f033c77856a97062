#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "protocol/base/clock.hpp"
#include "protocol/base/result.hpp"

namespace dripline::storage {

struct Machine {
  std::string name;
  std::string control;
  std::string description;
  std::string gateway_version;
  std::uint64_t epoch = 0;
  std::uint64_t last_record = 0;  ///< of this epoch, stored without a gap
  UtcTime first_seen, last_seen;
};

/// Promises of every store: storage/store.hpp.
class MachineStore {
 public:
  virtual ~MachineStore() = default;

  /// Adds or updates. `last_record` is the store's own and ignored, `first_seen` is kept. Errors:
  /// Syntax and LimitExceeded (the name).
  virtual Result<void> save(const Machine& machine) = 0;
  /// Errors: NotFound.
  virtual Result<Machine> find(const std::string& name) = 0;
  /// In order of their names.
  virtual Result<std::vector<Machine>> list() = 0;
};

}  // namespace dripline::storage
