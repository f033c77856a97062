#pragma once

#include "storage/impl/connections.hpp"

namespace dripline::storage {

/// Inside the caller's transaction: the machine's row id, made when it is new (a gateway's records
/// may come before its announcement). Errors: Syntax and LimitExceeded for a new name.
Result<std::int64_t> machine_id(sqlite::Database& database, const std::string& name,
                                std::uint64_t epoch, UtcTime now);

/// Promises: storage/store.hpp. Thread-safe.
class MachineRepository {
 public:
  explicit MachineRepository(Connections& connections) : connections_(connections) {}

  Result<void> save(const Machine& machine);
  Result<Machine> find(const std::string& name);
  Result<std::vector<Machine>> all();

 private:
  Connections& connections_;
};

}  // namespace dripline::storage
