#pragma once

#include "storage/impl/connections.hpp"

namespace dripline::storage {

/// Serial ports as configured. Promises: storage/store.hpp. Thread-safe.
class PortRepository {
 public:
  explicit PortRepository(Connections& connections) : connections_(connections) {}

  Result<void> save(const Port& port);
  Result<std::vector<Port>> all();
  Result<void> remove(const std::string& name);

 private:
  Connections& connections_;
};

}  // namespace dripline::storage
