// Many gateways in one process, each with a DDS domain, participant, sockets and threads of its
// own, as a real one has.
//   load_gateways DOMAIN TAG CELLS DISCOVERY_MS LEASE_MS FIRST MACHINES CHANGES RECORDS FEEDING
// CHANGES of its status and RECORDS a second for each; the first FEEDING of them pull a program.
// Prints "connected" when all are. SIGUSR1: no more records; when all are acknowledged, one line a
// machine and "drained". Ends with SIGTERM.
#include <sys/prctl.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <thread>
#include <vector>

#include "tests/load/gateway.hpp"

namespace {

using namespace dripline;
using namespace std::chrono_literals;

std::atomic<bool> is_draining = false, is_ending = false;

constexpr double kTextRate = 8192;  // bytes a second: 300 blocks of 27 bytes
constexpr auto kSlice = 2ms;

[[noreturn]] void give_up(const std::string& why) {
  std::fprintf(stderr, "load_gateways: %s\n", why.c_str());
  std::_Exit(1);
}

struct Rates {
  double changes = 0, records = 0;
};

class Fleet {
 public:
  void open(const load::LoadGateway::Options& options) {
    auto opened = load::LoadGateway::open(options);
    if (!opened) give_up(opened.error().what);
    machines_.push_back(std::move(*opened));
  }
  void begin() {
    for (auto& machine : machines_) {
      if (auto begun = machine->begin(); !begun) give_up(begun.error().what);
    }
  }
  /// One machine after the other, so that the changes are spread over the second.
  void run(const Rates& rates) {
    const SteadyTime begin = std::chrono::steady_clock::now();
    std::uint64_t changes = 0, records = 0;
    bool was_connected = false;
    while (!is_ending) {
      const SteadyTime now = std::chrono::steady_clock::now();
      const double passed = std::chrono::duration<double>(now - begin).count();
      const auto count = static_cast<double>(machines_.size());
      for (const auto due = static_cast<std::uint64_t>(passed * rates.changes * count);
           changes < due; ++changes) {
        auto& machine = *machines_[changes % machines_.size()];
        machine.change(now);
        machine.turn(now);  // what is due without mail
      }
      const auto due = static_cast<std::uint64_t>(passed * rates.records * count);
      for (; records < due; ++records) {
        auto& machine = *machines_[records % machines_.size()];
        if (!is_draining) machine.report();
        machine.turn(now);
      }
      for (auto& machine : machines_) {
        if (machine->has_mail()) machine->turn(now);
      }
      if (!was_connected) was_connected = tell_connected();
      if (is_draining && !is_told_) is_told_ = tell_drained();
      std::this_thread::sleep_for(kSlice);
    }
  }

 private:
  bool tell_connected() const {
    for (const auto& machine : machines_) {
      if (!machine->is_connected()) return false;
    }
    std::printf("connected\n");
    std::fflush(stdout);
    return true;
  }
  bool tell_drained() const {
    for (const auto& machine : machines_) {
      if (machine->unacknowledged() > 0) return false;
    }
    for (const auto& machine : machines_) {
      std::printf("%s %llu %llu %llu %llu %llu\n", machine->machine().c_str(),
                  static_cast<unsigned long long>(machine->epoch()),
                  static_cast<unsigned long long>(machine->records()),
                  static_cast<unsigned long long>(machine->text_bytes()),
                  static_cast<unsigned long long>(machine->damaged_texts()),
                  static_cast<unsigned long long>(machine->refused_statuses()));
    }
    std::printf("drained\n");
    std::fflush(stdout);
    return true;
  }

  std::vector<std::unique_ptr<load::LoadGateway>> machines_;
  bool is_told_ = false;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 11)
    give_up(
        "usage: load_gateways DOMAIN TAG CELLS DISCOVERY_MS LEASE_MS FIRST MACHINES CHANGES "
        "RECORDS "
        "FEEDING");
  std::signal(SIGUSR1, [](int) { is_draining = true; });
  std::signal(SIGTERM, [](int) { is_ending = true; });
  load::LoadGateway::Options options;
  options.network.domain = static_cast<std::uint32_t>(std::strtoul(argv[1], nullptr, 10));
  options.network.tag = argv[2];
  options.network.cells = static_cast<std::uint32_t>(std::strtoul(argv[3], nullptr, 10));
  options.network.discovery_interval_ms =
      static_cast<std::uint32_t>(std::strtoul(argv[4], nullptr, 10));
  options.network.lease_ms = static_cast<std::uint32_t>(std::strtoul(argv[5], nullptr, 10));
  const std::size_t first = std::strtoul(argv[6], nullptr, 10);
  const std::size_t count = std::strtoul(argv[7], nullptr, 10);
  const std::size_t feeding = std::strtoul(argv[10], nullptr, 10);
  Fleet fleet;
  for (std::size_t i = 0; i < count; ++i) {
    options.machine = "mill-" + std::to_string(first + i);
    options.text_rate = i < feeding ? kTextRate : 0;
    fleet.open(options);
  }
  fleet.begin();
  fleet.run({std::strtod(argv[8], nullptr), std::strtod(argv[9], nullptr)});
  std::_Exit(0);  // hundreds of endpoints take long to close, and nothing is left to be saved
}
