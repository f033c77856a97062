#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace dripline::load {

/// How long statuses take from the gateway's clock to the reader of an event stream; both are this
/// computer's. A status that a newer one has replaced is seen when that one is.
struct Delays {
  std::uint64_t events = 0;  ///< of machines
  std::uint64_t bytes = 0;   ///< of all events
  std::uint64_t seen = 0;    ///< statuses, with those that were replaced
  double median_ms = 0, p99_ms = 0, max_ms = 0;
};

/// Reads the event stream of a server, again and again when it ends.
class EventWatch {
 public:
  /// `changes`: statuses a second of each machine.
  explicit EventWatch(double changes) : interval_us_(1e6 / changes) {}
  ~EventWatch() { stop(); }
  EventWatch(const EventWatch&) = delete;
  EventWatch& operator=(const EventWatch&) = delete;

  void start(std::string url, std::string token, std::string path);
  void stop();
  /// Forgets what was seen.
  void reset();
  Delays delays() const;

 private:
  void read();
  void take(std::string_view bytes);
  void take_event(std::string_view event);
  void count(std::string_view machine, std::uint64_t number, std::int64_t written_us);

  const double interval_us_;
  std::string url_, token_, path_;
  std::atomic<bool> is_ending_ = false;
  std::thread thread_;
  std::string text_;  ///< of an event that is not whole yet

  mutable std::mutex mutex_;
  std::map<std::string, std::uint64_t, std::less<>> last_;  ///< number of the last status seen
  std::vector<std::uint64_t> by_ms_;                        ///< statuses by their delay
  std::uint64_t events_ = 0, bytes_ = 0;
};

}  // namespace dripline::load
