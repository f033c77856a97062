#pragma once

#include <algorithm>
#include <condition_variable>
#include <mutex>

#include "protocol/serial/line_driver.hpp"
#include "tests/support/patience.hpp"
#include "tests/unit/protocol/serial/toy_discipline.hpp"

namespace dripline::serial {

/// The events of a line, stored for a test that reads them on its own thread.
struct LineLog {
  struct Passed {
    LineTraffic::What what;
    wire::LineTime time;
    std::string text;
  };
  mutable std::mutex mutex;
  std::condition_variable changed;
  std::string received;
  std::vector<Passed> traffic;
  std::vector<std::string> channel;  ///< "open", or why not
  std::vector<Error> failures, faults;
  int ended = 0, room_calls = 0, steady_calls = 0;
  std::string to_send;  ///< offered whenever there is room

  template <class Condition>
  bool wait(Condition condition, std::chrono::milliseconds limit = test_support::kPatience) {
    std::unique_lock lock(mutex);
    return changed.wait_for(lock, limit, condition);
  }
  bool wait_open(std::size_t times = 1) {
    return wait([&, times] {
      return static_cast<std::size_t>(std::count(channel.begin(), channel.end(), "open")) >= times;
    });
  }
  std::size_t sent() const {
    std::size_t count = 0;
    for (const Passed& passed : traffic)
      if (passed.what == LineTraffic::What::Sent) count += passed.text.size();
    return count;
  }

  LineListener listener() {
    const auto change = [this](auto&& work) {
      const std::lock_guard lock(mutex);
      work();
      changed.notify_all();
    };
    return {.on_event =
                [this, change](wire::Event& event) {
                  change([&] {
                    if (auto* text = std::get_if<wire::TextReceived>(&event))
                      received += text->text;
                    if (auto* failed = std::get_if<wire::TransferFailed>(&event))
                      failures.push_back(failed->error);
                    if (auto* fault = std::get_if<wire::LineError>(&event))
                      faults.push_back(fault->error);
                    if (std::holds_alternative<wire::TransferEnded>(event)) ++ended;
                  });
                },
            .on_traffic =
                [this, change](const LineTraffic& seen) {
                  change([&] {
                    std::string text(seen.text);
                    for (const std::byte byte : seen.bytes) text += static_cast<char>(byte);
                    traffic.push_back({seen.what, seen.time, std::move(text)});
                  });
                },
            .on_channel =
                [this, change](const Error* lost) {
                  change([&] { channel.push_back(lost != nullptr ? lost->what : "open"); });
                },
            .on_room = [this, change] { change([&] { ++room_calls; }); },
            .on_steady = [this, change] { change([&] { ++steady_calls; }); }};
  }
};

inline std::unique_ptr<LineDriver> start_toy(LineLog& log, const std::string& address,
                                             unsigned baud = 115200) {
  wire::LineSettings settings;
  settings.baud = baud;
  auto line =
      LineDriver::start({.address = address,
                         .settings = settings,
                         .role = wire::Role::Host,
                         .listener = log.listener(),
                         .reopen_after = std::chrono::milliseconds(20),
                         .steady_after = std::chrono::milliseconds(300),
                         .make_discipline = [] { return std::make_unique<ToyDiscipline>(); }});
  return std::move(*line);
}

/// At most ToyDiscipline::kBuffer characters.
inline void send(LineDriver& line, const std::string& text, bool is_last = true) {
  line.post([text, is_last](wire::Discipline& end, wire::LineTime now) {
    (void)end.begin_send("", now);
    (void)end.offer(text, is_last, now);
  });
}

}  // namespace dripline::serial
