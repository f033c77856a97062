#include "server/folders/folder_watch.hpp"

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/inotify.h>
#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

namespace dripline::folders {
namespace {

/// Looks after changes are at least so far apart: a big file is written in many pieces.
constexpr std::chrono::milliseconds kBetween{100};
constexpr std::uint32_t kEvents =
    IN_MOVED_TO | IN_CREATE | IN_MODIFY | IN_CLOSE_WRITE | IN_DELETE | IN_MOVED_FROM | IN_ONLYDIR;

void note(const inotify_event& event, const std::string& name, Arrivals& arrivals) {
  if ((event.mask & IN_Q_OVERFLOW) != 0) arrivals.written.clear();  // a close may be among the lost
  if (name.empty()) return;
  if ((event.mask & IN_MODIFY) != 0) arrivals.written.insert(name);
  if ((event.mask & IN_MOVED_TO) != 0) arrivals.whole.insert(name);
  if ((event.mask & (IN_CREATE | IN_MODIFY)) != 0) arrivals.whole.erase(name);
  if ((event.mask & (IN_CLOSE_WRITE | IN_DELETE | IN_MOVED_FROM | IN_MOVED_TO)) != 0)
    arrivals.written.erase(name);
}

}  // namespace

FolderWatch::Events::Events() : inotify_(::inotify_init1(IN_NONBLOCK | IN_CLOEXEC)) {}

bool FolderWatch::Events::watch(const std::filesystem::path& folder) {
  // The same folder keeps its watch; another one at the path gets one of its own.
  if (!inotify_) return false;
  const int watch = ::inotify_add_watch(inotify_.get(), folder.c_str(), kEvents);
  if (watch != watch_ && watch_ >= 0) (void)::inotify_rm_watch(inotify_.get(), watch_);
  return std::exchange(watch_, watch) != watch && watch >= 0;
}

bool FolderWatch::Events::read(Arrivals& arrivals) {
  constexpr std::size_t kRoom = 64 * 1024;
  alignas(inotify_event) std::array<char, kRoom> room;
  bool is_something = false;
  for (;;) {
    const auto size = inotify_ ? ::read(inotify_.get(), room.data(), room.size()) : -1;
    if (size <= 0) return is_something;
    is_something = true;
    for (std::size_t at = 0; at < static_cast<std::size_t>(size);) {
      inotify_event event{};
      std::memcpy(&event, room.data() + at, sizeof event);
      const std::string name(event.len > 0 ? room.data() + at + sizeof event : "");
      note(event, name, arrivals);
      at += sizeof event + event.len;
    }
  }
}

FolderWatch::FolderWatch(HotFolder& folder)
    : folder_(folder), wake_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
  thread_ = std::jthread([this](const std::stop_token& stop) {
    work(stop);
    end_.set_value();
  });
}

FolderWatch::~FolderWatch() {
  request_end();
}

void FolderWatch::request_end() {
  thread_.request_stop();
  const std::uint64_t one = 1;
  (void)!::write(wake_.get(), &one, sizeof one);
}

bool FolderWatch::has_ended(std::chrono::steady_clock::time_point until) const {
  return ended_.wait_until(until) == std::future_status::ready;
}

void FolderWatch::work(const std::stop_token& stop) {
  using std::chrono::steady_clock;
  Events events;
  Arrivals arrivals;
  while (!stop.stop_requested()) {
    events.read(arrivals);
    const auto begun = steady_clock::now();
    auto next = folder_.look(arrivals, stop);
    arrivals.whole.clear();
    // A look opens the folder: what came between it and the watch is found by another one.
    if (const auto path = folder_.watched_path(); !path.empty() && events.watch(path)) next = begun;
    for (;;) {
      const auto left =
          std::chrono::duration_cast<std::chrono::milliseconds>(next - steady_clock::now());
      if (left.count() < 0 || stop.stop_requested()) break;
      std::array<pollfd, 2> waits{
          pollfd{.fd = wake_.get(), .events = POLLIN, .revents = 0},
          pollfd{.fd = events.descriptor(), .events = POLLIN, .revents = 0}};
      (void)::poll(waits.data(), waits.size(), static_cast<int>(left.count()) + 1);
      if (events.read(arrivals)) next = std::min(next, begun + kBetween);
    }
  }
}

}  // namespace dripline::folders
