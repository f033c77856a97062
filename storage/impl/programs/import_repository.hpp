#pragma once

#include "storage/impl/connections.hpp"
#include "storage/programs/import_store.hpp"

namespace dripline::storage {

class ImportRepository final : public ImportStore {
 public:
  explicit ImportRepository(Connections& connections) : connections_(connections) {}

  Result<std::vector<Import>> list(bool is_pending, Page page) override;
  Result<std::uint64_t> count_pending() override;
  Result<Import> find(const std::string& program, std::uint64_t revision) override;
  Result<std::vector<Import>> uncompared(std::uint64_t limit) override;
  Result<void> set_class(const std::string& program, std::uint64_t revision,
                         const ImportClass& found) override;
  Result<Revision> decide(const ImportDecision& decision) override;

 private:
  Connections& connections_;
};

}  // namespace dripline::storage
