#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <thread>
#include <vector>

#include "protocol/base/clock.hpp"
#include "server/machines/machine_control.hpp"
#include "server/mqtt/broker_link.hpp"
#include "server/mqtt/broker_state.hpp"
#include "server/mqtt/mqtt_settings.hpp"
#include "server/mqtt/sparkplug_session.hpp"
#include "server/mqtt/status_queue.hpp"

namespace dripline::mqtt {

/// The machines as devices of a Sparkplug B node, over a connection and on a thread of its own: a
/// connection has one last will, and Sparkplug's is the node's death. Of what a broker sends it
/// takes one thing, the wish for all births again. Never delays whom it is notified by. Any thread;
/// all of Parts must outlive it.
class SparkplugNode {
 public:
  struct Options {
    std::size_t window = 200;  ///< messages that are not written to the connection yet
    std::chrono::milliseconds look{1000};
    std::chrono::milliseconds connect_limit{10'000};
    std::chrono::milliseconds rebirth_interval{1000};  ///< of two births that were asked for
    std::chrono::milliseconds farewell{1000};          ///< at the end, for what is in progress
    BrokerState::Options state = {};
  };
  struct Parts {
    BrokerLink& link;
    const Clock& clock;
    std::string version;
    std::uint8_t first_connection = 0;  ///< SparkplugSession
    /// All of them, whenever they are to be born.
    std::function<std::vector<machines::MachineView>()> machines;
    std::function<nlohmann::json(const machines::MachineView&)> status_json;
    BrokerState::OnFault on_fault = {};  ///< on the thread of the node
  };
  struct State : BrokerState::View {
    std::string node = {};       ///< GROUP/NODE
    std::uint64_t messages = 0;  ///< since the start
    std::uint64_t rebirths = 0;  ///< that were asked for
  };

  SparkplugNode(Parts parts, const MqttSettings& settings, Options options);
  ~SparkplugNode();
  SparkplugNode(const SparkplugNode&) = delete;
  SparkplugNode& operator=(const SparkplugNode&) = delete;

  void begin();
  /// Publishes the node's death, and takes leave of the broker.
  void end();

  void note(const machines::MachineView& view);
  State state() const;

 private:
  void work(const std::stop_token& stop);
  Result<void> serve(const std::stop_token& stop);
  Result<void> connect(const std::stop_token& stop);
  Result<void> publish_loop(const std::stop_token& stop);
  Result<void> publish_births();
  Result<void> publish_states();
  Result<void> publish(const Message& message);
  Result<void> receive(std::chrono::milliseconds limit);
  void take_leave();
  std::chrono::milliseconds next_wait() const;

  const Parts parts_;
  const std::string broker_address_;
  const std::string name_;
  const Options options_;
  StatusQueue queue_;
  BrokerState broker_;
  std::atomic<std::uint64_t> messages_ = 0, rebirths_ = 0;

  // Of the thread.
  SparkplugSession session_;
  std::size_t under_way_ = 0;
  bool is_rebirth_wanted_ = false;
  SteadyTime born_{};
  std::jthread worker_;  // last: it uses the others
};

}  // namespace dripline::mqtt
