// How long all gateways of a shop need to come back after a restart of the server, with or without
// DDS Security. The server is a process of its own; the gateways are endpoints in this one, each
// with sockets, threads and a certificate of its own, so both sides' handshakes share this
// computer.
//   bench_dds_reconnect DOMAIN GATEWAYS secure|plain
//   bench_dds_reconnect --server DOMAIN SECURITY_FOLDER|-      the other process
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <mutex>
#include <set>
#include <thread>

#include "clients/tools/authority/authority.hpp"
#include "protocol/dds/security_folder.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {

using namespace dripline;
using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
namespace fs = std::filesystem;

[[noreturn]] void give_up(const std::string& why) {
  std::fprintf(stderr, "bench_dds_reconnect: %s\n", why.c_str());
  std::exit(1);
}

dds::NetworkOptions network(const char* domain) {
  dds::NetworkOptions options;
  options.domain = static_cast<std::uint32_t>(std::strtoul(domain, nullptr, 10));
  options.tag = "bench-reconnect";
  return options;
}

int serve(const char* domain, const std::string& folder) {
  auto options = network(domain);
  if (folder != "-") {
    auto security =
        dds::open_security_folder(folder, {.role = dds::Role::Server}, SystemClock().now());
    if (!security) give_up(security.error().what);
    options.security = security->files;
  }
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  sigprocmask(SIG_BLOCK, &signals, nullptr);
  auto opened = dds::ServerEndpoint::open(options, {});
  if (!opened) give_up(opened.error().what);
  int signal = 0;
  sigwait(&signals, &signal);
  return 0;
}

/// The server, until it is asked to end.
class ServerProcess {
 public:
  ServerProcess(const char* domain, const std::string& folder) {
    const std::string self = fs::read_symlink("/proc/self/exe").string();
    const char* const arguments[] = {self.c_str(), "--server", domain, folder.c_str(), nullptr};
    if (posix_spawn(&pid_, self.c_str(), nullptr, nullptr, const_cast<char* const*>(arguments),
                    environ) != 0)
      give_up("the server cannot be started");
  }
  ServerProcess(const ServerProcess&) = delete;
  ServerProcess& operator=(const ServerProcess&) = delete;
  ~ServerProcess() { end(SIGTERM); }
  /// Returns the CPU seconds it took.
  double end(int signal) {
    if (pid_ <= 0) return 0;
    ::kill(pid_, signal);
    rusage used{};
    ::wait4(pid_, nullptr, 0, &used);
    pid_ = 0;
    const auto seconds = [](const timeval& time) {
      return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) / 1e6;
    };
    return seconds(used.ru_utime) + seconds(used.ru_stime);
  }

 private:
  pid_t pid_ = 0;
};

class Gateways {
 public:
  void open(const dds::NetworkOptions& options, std::size_t number) {
    const std::string machine = "machine-" + std::to_string(number);
    dds::GatewayHandlers handlers;
    handlers.on_server = [this, number](bool is_connected) {
      const std::lock_guard lock(mutex_);
      if (is_connected) {
        connected_.insert(number);
      } else {
        connected_.erase(number);
      }
      changed_.notify_all();
    };
    auto opened = dds::GatewayEndpoint::open(options, machine, std::move(handlers));
    if (!opened) give_up(opened.error().what);
    dds::Announce announce;
    announce.machine = machine;
    announce.control = "centurion";
    announce.epoch = announce.session = 1;
    if (auto written = (*opened)->write(announce); !written) give_up(written.error().what);
    endpoints_.push_back(std::move(*opened));
  }
  /// How long it took until as many were connected.
  double wait_for(std::size_t count, Clock::time_point since) {
    std::unique_lock lock(mutex_);
    if (!changed_.wait_for(lock, 300s, [&] { return connected_.size() == count; }))
      std::fprintf(stderr, "only %zu are connected after 300 s\n", connected_.size());
    return std::chrono::duration<double>(Clock::now() - since).count();
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::set<std::size_t> connected_;
  std::vector<std::unique_ptr<dds::GatewayEndpoint>> endpoints_;
};

double own_cpu_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

int run(const char* domain, std::size_t count, bool is_secure) {
  const test_support::TemporaryFolder folder;
  const auto shop = folder.path() / "shop";
  const SystemClock clock;
  std::string server_folder = "-";
  std::optional<authority::Authority> authority;
  if (is_secure) {
    if (auto made = authority::Authority::create(shop, "bench", clock); !made)
      give_up(made.error().what);
    authority.emplace(authority::Authority::open(shop, clock).value());
    (void)authority->issue(authority::the_server(), 10).value();
    server_folder = authority->folder_of(authority::the_server()).string();
  }
  Gateways gateways;
  for (std::size_t i = 0; i < count; ++i) {
    auto options = network(domain);
    if (authority) {
      const std::string machine = "machine-" + std::to_string(i);
      const authority::Holder holder{authority::Role::Gateway, machine};
      (void)authority->issue(holder, 10).value();
      options.security =
          dds::open_security_folder(authority->folder_of(holder),
                                    {.role = dds::Role::Gateway, .machine = machine}, clock.now())
              .value()
              .files;
    }
    gateways.open(options, i);
  }
  auto start = Clock::now();
  ServerProcess first(domain, server_folder);
  const double connect = gateways.wait_for(count, start);
  const double first_cpu = first.end(SIGTERM);
  gateways.wait_for(0, start);
  start = Clock::now();
  ServerProcess second(domain, server_folder);
  const double restart = gateways.wait_for(count, start);
  second.end(SIGKILL);
  start = Clock::now();  // the gateways still wait for the end of the killed one's lease; the time
                         // contains it
  const double own = own_cpu_seconds();
  gateways.wait_for(0, start);
  ServerProcess third(domain, server_folder);
  const double kill = gateways.wait_for(count, start);
  std::printf(
      "{\"gateways\":%zu,\"secure\":%s,\"connect_s\":%.1f,\"after_restart_s\":%.1f,"
      "\"after_kill_s\":%.1f,\"server_cpu_s\":%.1f,\"gateways_cpu_s\":%.1f}\n",
      count, is_secure ? "true" : "false", connect, restart, kill, first_cpu,
      own_cpu_seconds() - own);
  std::fflush(stdout);
  third.end(SIGTERM);
  std::_Exit(0);  // hundreds of endpoints take long to close, and nothing is left to be saved
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 4 && std::string_view(argv[1]) == "--server") return serve(argv[2], argv[3]);
  if (argc != 4) give_up("usage: bench_dds_reconnect DOMAIN GATEWAYS secure|plain");
  return run(argv[1], std::strtoul(argv[2], nullptr, 10), std::string_view(argv[3]) == "secure");
}
