#pragma once

#include "storage/impl/connections.hpp"
#include "storage/programs/folder_store.hpp"
#include "storage/programs/program_store.hpp"

namespace dripline::storage {

/// Inside the transaction that stores the file's revision. Errors: NotFound (it is not Taken).
Result<void> store_folder_file(sql::Database& database, std::uint64_t id, const Revision& revision);

class FolderRepository final : public FolderStore {
 public:
  explicit FolderRepository(Connections& connections) : connections_(connections) {}

  Result<std::vector<FolderFile>> unfinished(const std::string& folder) override;
  Result<std::optional<FolderFile>> unfinished(const std::string& folder,
                                               const std::string& name) override;
  Result<FolderFile> begin(const FolderFile& file) override;
  Result<void> fail_file(std::uint64_t id, const std::string& reason) override;
  Result<void> set_target(std::uint64_t id, const std::string& target) override;
  Result<void> set_moved(std::uint64_t id, UtcTime time) override;
  Result<std::vector<FolderFile>> list(const std::optional<std::string>& folder,
                                       Page page) override;
  Result<FolderCounts> counts(const std::string& folder) override;

 private:
  Connections& connections_;
};

}  // namespace dripline::storage
