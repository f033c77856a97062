// One end of the star in a process of its own, to be killed and stopped by tests:
//   dds_peer server DOMAIN TAG LEASE_MS            acknowledges every record
//   dds_peer gateway DOMAIN TAG LEASE_MS SESSION   machine lathe-1; answers every order
// Prints "open" once it is there; ends when its standard input does.
#include <unistd.h>

#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

#include "protocol/dds/endpoint.hpp"

namespace {

using namespace dripline;

/// Answers are written here, since a handler must not call back into its endpoint.
class Answers {
 public:
  void post(std::function<void()> answer) {
    std::lock_guard lock(mutex_);
    answers_.push_back(std::move(answer));
    came_.notify_one();
  }
  void run(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    while (came_.wait(lock, stop, [this] { return !answers_.empty(); })) {
      auto answer = std::move(answers_.front());
      answers_.pop_front();
      lock.unlock();
      answer();
      lock.lock();
    }
  }

 private:
  std::mutex mutex_;
  std::condition_variable_any came_;
  std::deque<std::function<void()>> answers_;
};

void must(const Result<void>& result) {
  if (!result) std::fprintf(stderr, "dds_peer: %s\n", result.error().what.c_str());
}

void wait_for_end_of_input() {
  std::puts("open");
  std::fflush(stdout);
  char unused = 0;
  while (read(STDIN_FILENO, &unused, 1) > 0) {
  }
}

int serve(const dds::NetworkOptions& options) {
  Answers answers;
  std::unique_ptr<dds::ServerEndpoint> server;
  dds::ServerHandlers handlers;
  handlers.on_record = [&](const dds::Record& m) {
    answers.post([&server, m] {
      must(server->write(dds::RecordAck{m.machine, m.epoch, m.number}));
    });
  };
  auto opened = dds::ServerEndpoint::open(options, std::move(handlers));
  if (!opened) return std::fprintf(stderr, "dds_peer: %s\n", opened.error().what.c_str()), 1;
  server = std::move(*opened);
  const std::jthread worker([&](const std::stop_token& stop) { answers.run(stop); });
  wait_for_end_of_input();
  return 0;
}

int play_gateway(const dds::NetworkOptions& options, std::uint64_t session) {
  Answers answers;
  std::unique_ptr<dds::GatewayEndpoint> gateway;
  dds::GatewayHandlers handlers;
  handlers.on_command = [&](const dds::Command& m) {
    answers.post([&gateway, m] {
      must(gateway->write(dds::CommandResult{m.machine, m.id, true, ""}));
    });
  };
  auto opened = dds::GatewayEndpoint::open(options, "lathe-1", std::move(handlers));
  if (!opened) return std::fprintf(stderr, "dds_peer: %s\n", opened.error().what.c_str()), 1;
  gateway = std::move(*opened);
  dds::Announce announce;
  announce.machine = "lathe-1";
  announce.control = "centurion";
  announce.epoch = 7;
  announce.session = session;
  must(gateway->write(announce));
  const std::jthread worker([&](const std::stop_token& stop) { answers.run(stop); });
  wait_for_end_of_input();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 5) return 2;
  dds::NetworkOptions options;
  options.domain = static_cast<std::uint32_t>(std::strtoul(argv[2], nullptr, 10));
  options.tag = argv[3];
  options.discovery_interval_ms = 50;
  options.lease_ms = static_cast<std::uint32_t>(std::strtoul(argv[4], nullptr, 10));
  if (std::strcmp(argv[1], "server") == 0) return serve(options);
  return play_gateway(options, argc > 5 ? std::strtoull(argv[5], nullptr, 10) : 1);
}
