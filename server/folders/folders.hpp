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
  /// No further file is taken. Returns at once.
  void request_end();
  /// After that: waits for what is being taken. Errors: Timeout (names the folders whose thread had
  /// not ended by `until`, as on a share that hangs: this object, and what it uses, must live as
  /// long as the process).
  Result<void> end(std::chrono::steady_clock::time_point until);
  /// From time to time: reports folders that do not answer.
  void look();

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
