#pragma once

#include <functional>
#include <map>
#include <mutex>
#include <string>

#include "server/machines/worker_pool.hpp"
#include "server/ports/gateways/gateway_requests.hpp"

namespace dripline::ports {

/// Follows the recordings of gateways' lines that someone watches; others cost nothing. A line
/// that is watched is shown from its last entries before that on, and nothing is left out: where
/// the recording begins is known from the status, and an answer that fails is asked for again. Any
/// thread.
class GatewayMonitor {
 public:
  static constexpr std::chrono::milliseconds kInterval{300};
  using OnTraffic = std::function<void(const PortTraffic&)>;
  using HasListeners = std::function<bool(const std::string& port)>;

  /// Both must outlive it; the pool's tasks are over before.
  GatewayMonitor(AskLine ask, const Clock& clock, machines::WorkerPool& pool)
      : ask_(std::move(ask)), clock_(clock), pool_(pool) {}
  void begin() { look(); }
  void listen(OnTraffic on_traffic, HasListeners has_listeners);
  /// `recorded`: the number of the line's next entry; 0: its gateway does not say.
  void note(const std::string& machine, std::uint64_t session, std::uint64_t recorded);

 private:
  struct Followed {
    std::uint64_t session = 0;
    std::uint64_t recorded = 0;  ///< as the last status has it
    std::uint64_t seen = 0;      ///< the same one interval ago: no one watched it then
    std::uint64_t next = 0;      ///< of a line that is watched
    bool is_watched = false, is_read = false;
  };
  void look();
  void read(const std::string& machine);
  void publish(const std::string& machine, const RecordingPart& part) const;

  const AskLine ask_;
  const Clock& clock_;
  machines::WorkerPool& pool_;
  mutable std::mutex mutex_;
  OnTraffic on_traffic_;
  HasListeners has_listeners_;
  std::map<std::string, Followed> lines_;
};

}  // namespace dripline::ports
