#pragma once

#include <gtest/gtest.h>
#include <mosquitto.h>
#include <csignal>
#include <fstream>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/integration/system.hpp"

namespace dripline::integration {

/// Debian's mosquitto on loopback. It keeps its sessions when it is ended by SIGTERM; what it has
/// acknowledged and not stored is lost when it is killed, as with every broker.
class Broker {
 public:
  Broker(std::filesystem::path folder, int port) : folder_(std::move(folder)), port_(port) {
    std::filesystem::create_directories(folder_);
  }
  /// Lines of mosquitto.conf besides.
  void start(const std::string& more = "allow_anonymous true\n") {
    const auto file = folder_ / "mosquitto.conf";
    std::ofstream(file) << "user root\npersistence true\npersistence_location " << folder_.string()
                        << "/\nmax_queued_messages 0\nlistener " << port_ << " 127.0.0.1\n"
                        << more;
    process_.emplace(std::vector<std::string>{"/usr/sbin/mosquitto", "-c", file.string()},
                     folder_ / "mosquitto.out");
    ASSERT_TRUE(test_support::eventually([&] {
      return process_->output().find(" running") != std::string::npos || !process_->is_running();
    }));
    ASSERT_TRUE(process_->is_running()) << process_->output();
  }
  void end() {
    process_->signal(SIGTERM);
    ASSERT_TRUE(process_->wait());
  }
  void freeze() { process_->signal(SIGSTOP); }
  void thaw() { process_->signal(SIGCONT); }
  int port() const { return port_; }
  std::filesystem::path folder() const { return folder_; }

 private:
  const std::filesystem::path folder_;
  const int port_;
  std::optional<test_support::ChildProcess> process_;
};

/// A subscriber with a session that the broker keeps, and QoS 2: it gets each message of the broker
/// exactly once.
class Subscriber {
 public:
  struct Received {
    std::string topic, payload;
    bool is_retained = false;
  };
  explicit Subscriber(int port, std::string pattern = "shop/#") : pattern_(std::move(pattern)) {
    mosquitto_lib_init();
    client_ = mosquitto_new("reader", false, this);
    mosquitto_reconnect_delay_set(client_, 1, 1, false);
    mosquitto_connect_callback_set(client_, [](::mosquitto* client, void* object, int reason) {
      const auto& self = *static_cast<Subscriber*>(object);
      if (reason == 0) mosquitto_subscribe(client, nullptr, self.pattern_.c_str(), 2);
    });
    mosquitto_subscribe_callback_set(client_, [](::mosquitto*, void* object, int, int, const int*) {
      auto& self = *static_cast<Subscriber*>(object);
      const std::lock_guard lock(self.mutex_);
      self.is_subscribed_ = true;
    });
    mosquitto_message_callback_set(
        client_, [](::mosquitto*, void* object, const mosquitto_message* message) {
          auto& self = *static_cast<Subscriber*>(object);
          const std::lock_guard lock(self.mutex_);
          self.received_.push_back({message->topic,
                                    {static_cast<const char*>(message->payload),
                                     static_cast<std::size_t>(message->payloadlen)},
                                    message->retain});
        });
    EXPECT_EQ(mosquitto_connect_async(client_, "127.0.0.1", port, 20), MOSQ_ERR_SUCCESS);
    EXPECT_EQ(mosquitto_loop_start(client_), MOSQ_ERR_SUCCESS);
    EXPECT_TRUE(test_support::eventually([&] {
      const std::lock_guard lock(mutex_);
      return is_subscribed_;
    }));
  }
  ~Subscriber() {
    mosquitto_disconnect(client_);
    mosquitto_loop_stop(client_, false);
    mosquitto_destroy(client_);
  }
  Subscriber(const Subscriber&) = delete;
  Subscriber& operator=(const Subscriber&) = delete;

  std::vector<Received> received(const std::string& part) {
    const std::lock_guard lock(mutex_);
    std::vector<Received> some;
    for (const auto& message : received_) {
      if (message.topic.find(part) != std::string::npos) some.push_back(message);
    }
    return some;
  }
  void publish(const std::string& topic, const std::string& payload) {
    EXPECT_EQ(mosquitto_publish(client_, nullptr, topic.c_str(), static_cast<int>(payload.size()),
                                payload.data(), 1, false),
              MOSQ_ERR_SUCCESS);
  }
  /// Of the last message; an empty object: there is none.
  nlohmann::json last(const std::string& part) {
    const auto all = received(part);
    if (all.empty()) return nlohmann::json::object();
    return nlohmann::json::parse(all.back().payload);
  }

 private:
  const std::string pattern_;
  ::mosquitto* client_ = nullptr;
  std::mutex mutex_;
  bool is_subscribed_ = false;
  std::vector<Received> received_;
};

}  // namespace dripline::integration
