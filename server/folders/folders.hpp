#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "server/folders/folder_watch.hpp"
#include "storage/programs/folder_store.hpp"

namespace dripline::folders {

/// All hot folders of the server. Any thread.
class Folders {
 public:
  Folders(const HotFolder::Parts& parts, std::vector<FolderSettings> settings);
  ~Folders();
  Folders(const Folders&) = delete;
  Folders& operator=(const Folders&) = delete;

  /// Begins to look, each folder on a thread of its own.
  void begin();

  std::vector<FolderState> states() const;
  /// Newest first; without a name of all folders. Errors: NotFound, those of the store.
  Result<std::vector<storage::FolderFile>> files(const std::optional<std::string>& folder,
                                                 storage::Page page);

 private:
  storage::FolderStore& store_;
  std::vector<std::unique_ptr<HotFolder>> folders_;
  std::vector<std::unique_ptr<FolderWatch>> watches_;  ///< last: they use the folders
};

}  // namespace dripline::folders
