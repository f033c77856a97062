// A load for dncd and its page: as many gateways as wanted, each of which writes its status so many
// times a second, as one with a running program does. They are real endpoints of DDS, and no
// machines: nothing is interpreted, and commands are not answered.
//   bench_page_fleet DOMAIN TAG CELLS DISCOVERY_MS LEASE_MS FIRST MACHINES CHANGES_PER_SECOND
// Each has sockets of its own, and Cyclone takes no descriptor above 1023: at most 100 a process.
// Prints "connected N" when all are, then runs until its standard input ends.
#include <poll.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "protocol/dds/endpoint.hpp"

namespace {

using namespace dripline;
using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

[[noreturn]] void give_up(const std::string& why) {
  std::fprintf(stderr, "bench_page_fleet: %s\n", why.c_str());
  std::exit(1);
}

constexpr std::uint16_t kXyz = 0b111;

/// What a milling machine reports in the middle of a program.
dds::Status first_status(const std::string& machine) {
  dds::Status status;
  status.machine = machine;
  status.session = 1;
  status.execution = dds::Execution::Active;
  status.run = "run-of-" + machine;
  status.program = "O0200";
  status.total_bytes = 2'000'000;
  status.sent = 500'000;
  status.accepted = 21'000;
  status.axes = kXyz;
  status.feed_mm_per_min = 600;
  status.spindle_rpm = 4000;
  status.buffered_seconds = 4;
  status.remote_enable = dds::RemoteEnable::Unattended;
  status.waits_for = dds::WaitsFor::Nothing;
  status.modes.emplace();
  status.modes->motion = dds::MotionKind::Line;
  status.modes->feed = 600;
  status.modes->tool = 3;
  status.modes->work_system = "G54";
  status.coordinates.emplace();
  status.coordinates->following_error.emplace();
  status.coordinates->program.emplace();
  return status;
}

/// The next block.
void advance(dds::Status& status) {
  status.time =
      std::chrono::time_point_cast<std::chrono::microseconds>(std::chrono::system_clock::now());
  status.steady =
      std::chrono::duration_cast<std::chrono::microseconds>(Clock::now().time_since_epoch());
  ++status.executed;
  ++status.line;
  ++status.accepted;
  status.sequence = static_cast<std::int64_t>(10 * status.line);
  status.offset = (status.offset + 23) % status.total_bytes;
  const double angle = static_cast<double>(status.executed) / 40;
  status.position = {80 * std::cos(angle), 80 * std::sin(angle), -3.5};
  status.coordinates->target = status.position;
  status.coordinates->program->position = status.position;
  status.buffered_seconds = 4 + std::sin(angle);
}

class Fleet {
 public:
  void open(const dds::NetworkOptions& options, std::size_t number) {
    const std::string machine = "mill-" + std::to_string(number);
    dds::GatewayHandlers handlers;
    handlers.on_server = [this, number](bool is_connected) {
      const std::lock_guard lock(mutex_);
      if (is_connected) connected_.insert(number);
      changed_.notify_all();
    };
    auto opened = dds::GatewayEndpoint::open(options, machine, std::move(handlers));
    if (!opened) give_up(opened.error().what);
    dds::Announce announce;
    announce.machine = machine;
    announce.control = "fanuc";
    announce.version = "bench";
    announce.epoch = announce.session = 1;
    if (auto written = (*opened)->write(announce); !written) give_up(written.error().what);
    machines_.push_back({std::move(*opened), first_status(machine)});
  }
  void wait_until_connected() {
    std::unique_lock lock(mutex_);
    if (!changed_.wait_for(lock, 600s, [&] { return connected_.size() == machines_.size(); }))
      give_up("only " + std::to_string(connected_.size()) + " are connected after 600 s");
  }
  /// One after the other, so that the changes are spread over the second.
  void run(double changes_per_second) {
    const double rate = changes_per_second * static_cast<double>(machines_.size());
    const std::chrono::duration<double> interval(1 / rate);
    pollfd input{.fd = STDIN_FILENO, .events = POLLIN, .revents = 0};
    const auto begin = Clock::now();
    std::uint64_t written = 0, refused = 0;
    while (::poll(&input, 1, 0) == 0) {
      const std::chrono::duration<double> passed = Clock::now() - begin;
      const auto due = static_cast<std::uint64_t>(passed.count() * rate);
      for (; written < due; ++written) {
        auto& [endpoint, status] = machines_[written % machines_.size()];
        advance(status);
        if (!endpoint->write(status)) ++refused;
      }
      std::this_thread::sleep_for(interval);
    }
    const std::chrono::duration<double> passed = Clock::now() - begin;
    std::printf("{\"machines\":%zu,\"changes_per_second\":%.0f,\"refused\":%llu}\n",
                machines_.size(), static_cast<double>(written) / passed.count(),
                static_cast<unsigned long long>(refused));
  }

 private:
  struct Machine {
    std::unique_ptr<dds::GatewayEndpoint> endpoint;
    dds::Status status;
  };
  std::vector<Machine> machines_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::set<std::size_t> connected_;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 9)
    give_up(
        "usage: bench_page_fleet DOMAIN TAG CELLS DISCOVERY_MS LEASE_MS FIRST MACHINES "
        "CHANGES_PER_SECOND");
  dds::NetworkOptions options;
  options.domain = static_cast<std::uint32_t>(std::strtoul(argv[1], nullptr, 10));
  options.tag = argv[2];
  options.cells = static_cast<std::uint32_t>(std::strtoul(argv[3], nullptr, 10));
  options.discovery_interval_ms = static_cast<std::uint32_t>(std::strtoul(argv[4], nullptr, 10));
  options.lease_ms = static_cast<std::uint32_t>(std::strtoul(argv[5], nullptr, 10));
  const std::size_t first = std::strtoul(argv[6], nullptr, 10);
  const std::size_t count = std::strtoul(argv[7], nullptr, 10);
  Fleet fleet;
  for (std::size_t i = 0; i < count; ++i) fleet.open(options, first + i);
  fleet.wait_until_connected();
  std::printf("connected %zu\n", count);
  std::fflush(stdout);
  fleet.run(std::strtod(argv[8], nullptr));
  std::fflush(stdout);
  std::_Exit(0);  // hundreds of endpoints take long to close, and nothing is left to be saved
}
