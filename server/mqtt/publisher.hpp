#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "protocol/base/clock.hpp"
#include "server/machines/machine_control.hpp"
#include "server/mqtt/broker_link.hpp"
#include "server/mqtt/broker_state.hpp"
#include "server/mqtt/record_feed.hpp"
#include "server/mqtt/status_queue.hpp"
#include "storage/store.hpp"

namespace dripline::mqtt {

/// Publishes records and states to a broker, on a thread of its own: every record at least once and
/// in order, from a stored cursor, so that neither an outage of the broker nor a kill loses one;
/// the latest state of each machine. Never delays whom it is notified by. Any thread; all of Parts
/// must outlive it.
class Publisher {
 public:
  struct Options {
    std::size_t window = 100;                     ///< messages of each sort in progress
    std::chrono::milliseconds look{1000};         ///< for records, besides when notified
    std::chrono::milliseconds gather{20};         ///< between two looks
    std::chrono::milliseconds commit_after{200};  ///< of acknowledgments, so that they are few
    std::chrono::milliseconds connect_limit{10'000};
    std::chrono::milliseconds answer_limit{30'000};  ///< for an acknowledgment
    std::chrono::milliseconds farewell{1000};        ///< at the end, for what is in progress
    BrokerState::Options state = {};
  };
  struct Parts {
    const storage::Store& store;
    BrokerLink& link;
    const Clock& clock;
    std::string server;  ///< identity of the database
    std::string version;
    /// All of them, whenever a connection begins.
    std::function<std::vector<machines::MachineView>()> machines;
    std::function<nlohmann::json(const machines::MachineView&)> status_json;
    std::function<nlohmann::json(const storage::Record&)> record_json;
    BrokerState::OnFault on_fault = {};  ///< on the thread of the publisher
  };
  struct State : BrokerState::View {
    std::string broker = {};
    std::uint64_t waiting = 0;  ///< records that the broker has not acknowledged
    std::uint64_t records = 0;  ///< acknowledged since the start
    std::uint64_t states = 0;   ///< likewise
    std::uint64_t missing = 0;  ///< records that went into archives before they were published
  };

  Publisher(Parts parts, MqttSettings settings, Options options);
  ~Publisher();
  Publisher(const Publisher&) = delete;
  Publisher& operator=(const Publisher&) = delete;

  void begin();
  /// Takes leave of the broker.
  void end();

  void note(const machines::MachineView& view);
  void note_record();
  /// Errors: those of the store.
  Result<State> state() const;

  static constexpr const char* kReader = "mqtt";  ///< of the records

 private:
  Result<void> begin_reading();
  void work(const std::stop_token& stop);
  /// One connection, to its end. Errors: why it ended, unless it was to be stopped.
  Result<void> serve(const std::stop_token& stop);
  Result<void> connect(const std::stop_token& stop);
  Result<void> publish_loop(const std::stop_token& stop);
  void greet();
  Result<void> publish_online();
  Result<void> publish_states();
  Result<void> publish_records();
  Result<void> receive(std::chrono::milliseconds limit);
  Result<void> take(const BrokerLink::Acknowledgment& acknowledged);
  Result<void> commit(bool is_due_now);
  /// A message that waits for its acknowledgment while no older one of its sort does.
  struct Oldest {
    std::uint64_t message = 0;  ///< 0: none waits
    SteadyTime since{};
  };
  static void follow(Oldest& oldest, std::uint64_t message, SteadyTime now);
  Result<void> check_answers();
  void take_leave();
  std::chrono::milliseconds next_wait() const;
  std::size_t under_way() const { return states_.size() + feed_.under_way(); }

  Message online_message(bool is_online) const;

  const Parts parts_;
  const MqttSettings settings_;
  const Options options_;
  StatusQueue queue_;
  std::atomic<bool> is_record_noted_ = false;

  BrokerState broker_;
  std::atomic<std::uint64_t> published_records_ = 0, published_states_ = 0, missing_ = 0;

  // Of the thread.
  RecordFeed feed_;
  std::map<std::uint64_t, std::string> states_;  ///< in progress: message, what it is
  bool is_more_ = false;                         ///< records wait that fit the window
  SteadyTime looked_{};
  SteadyTime committed_{};
  Oldest oldest_record_, oldest_state_;
  std::jthread worker_;  // last: it uses the others
};

}  // namespace dripline::mqtt
