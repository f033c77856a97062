#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>

#include "protocol/dds/endpoint.hpp"

namespace dripline::machines {

/// Asks gateways beside a control about their line, and waits for the answers. A request is
/// repeated until it is answered; a gateway does each once. Any thread.
class LineQueries {
 public:
  static constexpr std::chrono::milliseconds kRepeat{300};
  static constexpr std::chrono::milliseconds kLimit{5000};

  /// `session_of`: of the machine's present gateway; 0: none.
  LineQueries(dds::ServerEndpoint& endpoint,
              std::function<std::uint64_t(const std::string& machine)> session_of)
      : endpoint_(endpoint), session_of_(std::move(session_of)) {}

  /// Any thread but DDS's. Errors: Busy (refused: the gateway's reason), Timeout (no gateway, or no
  /// answer in time), Io (the server is stopping), those of the endpoint.
  Result<dds::LineData> ask(dds::LineRequest request, std::chrono::milliseconds limit = kLimit);
  /// On a DDS thread.
  void on_data(dds::LineData data);
  /// Callers that wait get an error.
  void stop();

 private:
  struct Waiting {
    std::string machine;
    std::optional<dds::LineData> data;
  };
  dds::ServerEndpoint& endpoint_;
  const std::function<std::uint64_t(const std::string&)> session_of_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::map<std::string, Waiting> waiting_;
  bool is_stopping_ = false;
};

}  // namespace dripline::machines
