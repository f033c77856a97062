#include "server/ports/gateways/gateway_monitor.hpp"

#include <utility>

#include "gateway/line/recording/flight_recorder.hpp"

namespace dripline::ports {

void GatewayMonitor::listen(OnTraffic on_traffic, HasListeners has_listeners) {
  const std::lock_guard lock(mutex_);
  on_traffic_ = std::move(on_traffic);
  has_listeners_ = std::move(has_listeners);
}

void GatewayMonitor::note(const std::string& machine, std::uint64_t session,
                          std::uint64_t recorded) {
  const std::lock_guard lock(mutex_);
  Followed& line = lines_[machine];
  line.recorded = recorded;
  if (std::exchange(line.session, session) == session) return;
  // Another process: all that it has recorded itself is new.
  line.seen = line.next = recorded == 0 ? UINT64_MAX : line::FlightRecorder::kFirst;
}

void GatewayMonitor::look() {
  {
    const std::lock_guard lock(mutex_);
    for (auto& [machine, line] : lines_) {
      const bool is_watched = has_listeners_ && has_listeners_(machine);
      if (is_watched && !line.is_watched) line.next = line.seen;
      line.is_watched = is_watched;
      line.seen = line.recorded == 0 ? UINT64_MAX : line.recorded;
      if (!is_watched || std::exchange(line.is_read, true)) continue;
      pool_.post([this, machine = machine] { read(machine); });
    }
  }
  pool_.post_after(kInterval, [this] { look(); });
}

/// One at a time for each line.
void GatewayMonitor::read(const std::string& machine) {
  std::uint64_t session = 0, number = 0;
  {
    const std::lock_guard lock(mutex_);
    session = lines_[machine].session;
    number = lines_[machine].next;
  }
  // After an error it is read on from there with the next look.
  (void)read_recording(ask_, machine, number, [&](const RecordingPart& part) {
    publish(machine, part);
  }).has_value();
  const std::lock_guard lock(mutex_);
  Followed& line = lines_[machine];
  line.is_read = false;
  if (line.session == session) line.next = number;
}

void GatewayMonitor::publish(const std::string& machine, const RecordingPart& part) const {
  OnTraffic on_traffic;
  {
    const std::lock_guard lock(mutex_);
    on_traffic = on_traffic_;
  }
  if (!on_traffic) return;
  if (part.lost > 0) {
    on_traffic(
        {.port = machine,
         .time = clock_.now(),
         .what = TrafficKind::Note,
         .bytes = {},
         .text = fmt::format("{} entries are not in the gateway's recording any more", part.lost)});
  }
  for (const PortTraffic& entry : part.entries) on_traffic(entry);
}

}  // namespace dripline::ports
