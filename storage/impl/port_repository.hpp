#pragma once

#include "storage/impl/connections.hpp"
#include "storage/port_store.hpp"

namespace dripline::storage {

class PortRepository final : public PortStore {
 public:
  explicit PortRepository(Connections& connections) : connections_(connections) {}

  Result<void> save(const Port& port) override;
  Result<std::vector<Port>> list() override;
  Result<void> remove(const std::string& name) override;

 private:
  Connections& connections_;
};

}  // namespace dripline::storage
