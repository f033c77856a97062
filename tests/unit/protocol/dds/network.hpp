#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>

#include "protocol/dds/endpoint.hpp"

/// A server and gateways on loopback for one test, out of sight of every other test.
namespace dripline::dds::test {

using namespace std::chrono_literals;

inline constexpr auto kDeadline = 10s;  // how long a loaded machine may take, not how long it takes

// Domains from 101 on would reach into the ports the system gives to anybody.
inline constexpr std::uint32_t kDomains = 100;

/// What callbacks delivered, in order; the test's thread waits for it.
template <class T>
class Inbox {
 public:
  void put(T value) {
    {
      std::lock_guard lock(mutex_);
      values_.push_back(std::move(value));
    }
    came_.notify_all();
  }
  /// The next value, or none after `wait`.
  std::optional<T> take(std::chrono::milliseconds wait = kDeadline) {
    std::unique_lock lock(mutex_);
    if (!came_.wait_for(lock, wait, [this] { return !values_.empty(); })) return std::nullopt;
    T value = std::move(values_.front());
    values_.pop_front();
    return value;
  }
  std::size_t size() const {
    std::lock_guard lock(mutex_);
    return values_.size();
  }

 private:
  mutable std::mutex mutex_;
  std::condition_variable came_;
  std::deque<T> values_;
};

struct TestServer {
  Inbox<Announce> announces;
  Inbox<std::string> lost;
  Inbox<bool> rivals;
  Inbox<Status> statuses;
  Inbox<Record> records;
  Inbox<CommandResult> results;
  Inbox<BlockRequest> requests;
  std::function<bool(const Announce&)> may_serve;
  std::unique_ptr<ServerEndpoint> endpoint;  // last: its callbacks use the inboxes

  ServerHandlers handlers() {
    return {.on_announce = [this](Announce m) { announces.put(std::move(m)); },
            .on_lost = [this](std::string m) { lost.put(std::move(m)); },
            .on_rival = [this](const std::string&, bool is_there) { rivals.put(is_there); },
            .may_serve = may_serve,
            .on_status = [this](Status m) { statuses.put(std::move(m)); },
            .on_record = [this](Record m) { records.put(std::move(m)); },
            .on_command_result = [this](CommandResult m) { results.put(std::move(m)); },
            .on_request = [this](BlockRequest m) { requests.put(std::move(m)); }};
  }
};

struct TestGateway {
  Inbox<Command> commands;
  Inbox<RecordAck> acks;
  Inbox<BlockData> blocks;
  Inbox<bool> server;
  std::unique_ptr<GatewayEndpoint> endpoint;

  GatewayHandlers handlers() {
    return {.on_command = [this](Command m) { commands.put(std::move(m)); },
            .on_ack = [this](RecordAck m) { acks.put(std::move(m)); },
            .on_block = [this](BlockData m) { blocks.put(std::move(m)); },
            .on_server = [this](bool is_connected) { server.put(is_connected); }};
  }
};

class Network : public testing::Test {
 protected:
  Network() {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    options_.tag = fmt::format("{}-{}.{}", getpid(), info->test_suite_name(), info->name());
    options_.domain = static_cast<std::uint32_t>(getpid()) % kDomains;
    options_.discovery_interval_ms = 50;
    options_.lease_ms = 1000;
  }

  /// The first server of a test looks for a domain whose port no other process holds.
  std::unique_ptr<TestServer> open_server(std::function<bool(const Announce&)> may_serve = {}) {
    auto server = std::make_unique<TestServer>();
    server->may_serve = std::move(may_serve);
    for (int tries = 0; tries < 200; ++tries) {
      auto opened = ServerEndpoint::open(options_, server->handlers());
      if (opened) {
        server->endpoint = std::move(*opened);
        return server;
      }
      if (opened.error().code != Errc::Busy) throw std::runtime_error(opened.error().what);
      options_.domain = (options_.domain + 1) % kDomains;
    }
    throw std::runtime_error("no free domain");
  }

  std::unique_ptr<TestGateway> open_gateway(const std::string& machine, std::uint64_t session = 1) {
    auto gateway = std::make_unique<TestGateway>();
    auto opened = GatewayEndpoint::open(options_, machine, gateway->handlers());
    if (!opened) throw std::runtime_error(opened.error().what);
    gateway->endpoint = std::move(*opened);
    EXPECT_TRUE(gateway->endpoint->write(announce(machine, session)));
    return gateway;
  }

  static Announce announce(const std::string& machine, std::uint64_t session = 1) {
    Announce m;
    m.machine = machine;
    m.control = "centurion";
    m.version = "0.1.0";
    m.epoch = 7;
    m.session = session;
    m.description = "Drehmaschine Süd";
    return m;
  }

  NetworkOptions options_;
};

inline UtcTime at(std::int64_t microseconds) {
  return UtcTime{std::chrono::microseconds{microseconds}};
}

inline Record record(const std::string& machine, std::uint64_t number) {
  Record m;
  m.machine = machine;
  m.epoch = 7;
  m.number = number;
  m.time = at(1'700'000'000'000'000);
  m.run = "run-1";
  m.kind = RecordKind::Output;
  m.block = 12;
  m.line = 34;
  m.sequence = 50;
  m.device = "file";
  m.text = "X1.000 Z-2.500";
  return m;
}

inline BlockData block_data(const std::string& machine, std::uint64_t offset, std::size_t size) {
  BlockData m;
  m.machine = machine;
  m.session = 1;
  m.run = "run-1";
  m.offset = offset;
  m.total_bytes = offset + size;
  m.ends = true;
  m.bytes.resize(size);
  for (std::size_t i = 0; i < size; ++i) m.bytes[i] = static_cast<std::byte>(i * 31 + offset);
  return m;
}

}  // namespace dripline::dds::test
