// Payload of a drip feed over DDS between two processes: a gateway pulls a program that has no end,
// the server answers every request in pieces of 32 KiB. Nothing but the endpoints is measured: the
// bytes come from memory and are only counted.
//   bench_dds_feed DOMAIN SECONDS [WINDOW_KIB REQUEST_KIB]
//   bench_dds_feed --server DOMAIN        the other process, started by the first
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <mutex>
#include <thread>

#include "protocol/dds/endpoint.hpp"

namespace {

using namespace dripline;
using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr std::uint64_t kTotal = std::uint64_t{1} << 50;

dds::NetworkOptions network(const char* domain) {
  dds::NetworkOptions options;
  options.domain = static_cast<std::uint32_t>(std::strtoul(domain, nullptr, 10));
  options.tag = "bench";
  return options;
}

[[noreturn]] void give_up(const std::string& why) {
  std::fprintf(stderr, "bench_dds_feed: %s\n", why.c_str());
  std::exit(1);
}

class Server {
 public:
  void run(const dds::NetworkOptions& options) {
    dds::ServerHandlers handlers;
    handlers.on_request = [this](dds::BlockRequest request) {
      std::lock_guard lock(mutex_);
      requests_.push_back(std::move(request));
      came_.notify_one();
    };
    auto opened = dds::ServerEndpoint::open(options, std::move(handlers));
    if (!opened) give_up(opened.error().what);
    for (;;) answer(**opened, next());
  }

 private:
  dds::BlockRequest next() {
    std::unique_lock lock(mutex_);
    came_.wait(lock, [this] { return !requests_.empty(); });
    dds::BlockRequest request = std::move(requests_.front());
    requests_.pop_front();
    return request;
  }
  void answer(dds::ServerEndpoint& endpoint, const dds::BlockRequest& request) {
    data_.machine = request.machine;
    data_.session = request.session;
    data_.run = request.run;
    data_.total_bytes = kTotal;
    for (std::uint32_t done = 0; done < request.length; done += dds::kMaxBlockBytes) {
      data_.offset = request.offset + done;
      data_.bytes.resize(std::min<std::size_t>(dds::kMaxBlockBytes, request.length - done),
                         std::byte{'X'});
      (void)endpoint.write(data_);  // what is not taken is asked for again
    }
  }

  std::mutex mutex_;
  std::condition_variable came_;
  std::deque<dds::BlockRequest> requests_;
  dds::BlockData data_;
};

class Gateway {
 public:
  Gateway(std::uint64_t window, std::uint32_t request) : window_(window), request_(request) {}

  void run(const dds::NetworkOptions& options, int seconds) {
    dds::GatewayHandlers handlers;
    handlers.on_block = [this](const dds::BlockData& m) { count(m); };
    handlers.on_server = [this](bool is_connected) {
      std::lock_guard lock(mutex_);
      is_connected_ = is_connected;
      changed_.notify_one();
    };
    auto opened = dds::GatewayEndpoint::open(options, "bench", std::move(handlers));
    if (!opened) give_up(opened.error().what);
    dds::Announce announce;
    announce.epoch = 1;
    announce.machine = "bench";
    announce.control = "centurion";
    if (auto written = (*opened)->write(announce); !written) give_up(written.error().what);
    wait_for_server();
    pull(**opened, 500ms);  // warm up
    double best = 0;
    for (int i = 0; i < seconds; ++i) best = std::max(best, one_second(**opened));
    std::printf("{\"best_bytes_per_second\":%.0f,\"asked_again\":%llu}\n", best,
                static_cast<unsigned long long>(asked_again_));
  }

 private:
  void count(const dds::BlockData& m) {
    std::lock_guard lock(mutex_);
    if (m.offset != received_) return;  // the answer to something asked twice, or after a gap
    received_ += m.bytes.size();
    if (asked_ - received_ + request_ <= window_) changed_.notify_one();
  }
  /// On a shared machine the best second says more than the mean.
  double one_second(dds::GatewayEndpoint& endpoint) {
    const std::uint64_t before = received();
    const auto start = Clock::now();
    pull(endpoint, 1s);
    const std::chrono::duration<double> passed = Clock::now() - start;
    return static_cast<double>(received() - before) / passed.count();
  }
  std::uint64_t received() {
    std::lock_guard lock(mutex_);
    return received_;
  }
  void wait_for_server() {
    std::unique_lock lock(mutex_);
    if (!changed_.wait_for(lock, 10s, [this] { return is_connected_; })) give_up("no server");
  }
  void pull(dds::GatewayEndpoint& endpoint, std::chrono::duration<double> duration) {
    const auto end = Clock::now() + duration;
    while (Clock::now() < end) {
      std::uint64_t offset = 0;
      {
        std::unique_lock lock(mutex_);
        const bool has_room = changed_.wait_for(
            lock, 100ms, [this] { return asked_ - received_ + request_ <= window_; });
        if (!has_room) {
          asked_ = received_;
          ++asked_again_;
        }
        offset = asked_;
        asked_ += request_;
      }
      (void)endpoint.write(dds::BlockRequest{"bench", 1, "run", "", offset, request_});
    }
  }

  std::uint64_t window_;
  std::uint32_t request_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool is_connected_ = false;
  std::uint64_t asked_ = 0, received_ = 0, asked_again_ = 0;
};

pid_t start_server(char* self, char* domain) {
  char option[] = "--server";
  char* const argv[] = {self, option, domain, nullptr};
  pid_t pid = 0;
  if (posix_spawn(&pid, "/proc/self/exe", nullptr, nullptr, argv, environ) != 0) {
    give_up("cannot start the server");
  }
  return pid;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 3 && std::strcmp(argv[1], "--server") == 0) {
    Server().run(network(argv[2]));
  }
  if (argc < 3) give_up("DOMAIN SECONDS [WINDOW_KIB REQUEST_KIB]");
  const std::uint64_t window = (argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 768) * 1024;
  const auto request =
      static_cast<std::uint32_t>((argc > 4 ? std::strtoul(argv[4], nullptr, 10) : 256) * 1024);
  const pid_t server = start_server(argv[0], argv[1]);
  Gateway(window, request).run(network(argv[1]), std::atoi(argv[2]));
  kill(server, SIGKILL);
  waitpid(server, nullptr, 0);
  return 0;
}
