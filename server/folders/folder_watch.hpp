#pragma once

#include <chrono>
#include <future>
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
  /// Waits for its thread, as long as that takes.
  ~FolderWatch();
  FolderWatch(const FolderWatch&) = delete;
  FolderWatch& operator=(const FolderWatch&) = delete;

  /// It takes no further file. Returns at once.
  void request_end();
  /// After that. False: its thread had not ended by `until`, and uses the folder as long as the
  /// process lives.
  bool has_ended(std::chrono::steady_clock::time_point until) const;
  const HotFolder& folder() const { return folder_; }

  /// What arrived; tests use it without the thread.
  class Events {
   public:
    Events();
    /// Watches the folder, if it is not watched. True: from now on. Where the system cannot,
    /// nothing is ever reported.
    bool watch(const std::filesystem::path& folder);
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
  std::promise<void> end_;
  std::future<void> ended_ = end_.get_future();
  std::jthread thread_;
};

}  // namespace dripline::folders
