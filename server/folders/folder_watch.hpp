#pragma once

#include <thread>

#include "protocol/base/descriptor.hpp"
#include "server/folders/hot_folder.hpp"

namespace dripline::folders {

/// Looks at a hot folder on a thread of its own: when the system reports a change (inotify), when a
/// file should be complete, and from time to time, because network shares report nothing. The
/// folder must outlive it.
class FolderWatch {
 public:
  explicit FolderWatch(HotFolder& folder);
  ~FolderWatch();
  FolderWatch(const FolderWatch&) = delete;
  FolderWatch& operator=(const FolderWatch&) = delete;

  /// What arrived; tests use it without the thread.
  class Events {
   public:
    Events();
    /// Watches the folder, if it is not watched. Where the system cannot, nothing is ever reported.
    void watch(const std::filesystem::path& folder);
    /// Reads what is there into `arrivals`. Never waits. True: there was something.
    bool read(Arrivals& arrivals);
    int descriptor() const { return inotify_.get(); }

   private:
    Descriptor inotify_;
    int watch_ = -1;
  };

 private:
  void work(const std::stop_token& stop);

  HotFolder& folder_;
  Descriptor wake_;  ///< an eventfd
  std::jthread thread_;
};

}  // namespace dripline::folders
