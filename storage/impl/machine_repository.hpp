#pragma once

#include "storage/impl/connections.hpp"
#include "storage/machine_store.hpp"

namespace dripline::storage {

/// Inside the caller's transaction: the machine's row id, made when it is new (a gateway's records
/// may come before its announcement). Errors: Syntax and LimitExceeded for a new name.
Result<std::int64_t> machine_id(sqlite::Database& database, const std::string& name,
                                std::uint64_t epoch, UtcTime now);

class MachineRepository final : public MachineStore {
 public:
  explicit MachineRepository(Connections& connections) : connections_(connections) {}

  Result<void> save(const Machine& machine) override;
  Result<Machine> find(const std::string& name) override;
  Result<std::vector<Machine>> list() override;

 private:
  Connections& connections_;
};

}  // namespace dripline::storage
