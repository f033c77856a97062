#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "protocol/dds/endpoint.hpp"
#include "tests/support/patience.hpp"

namespace dripline::test_support {

/// What was written through a fake endpoint. Outlives it, so tests can look afterwards.
struct WrittenMessages {
  std::mutex mutex;
  std::condition_variable changed;
  std::vector<dds::RecordAck> acks;
  std::vector<dds::Command> commands;
  std::vector<dds::BlockData> blocks;
  std::vector<dds::LineRequest> line_requests;
  std::vector<std::string> renewed;  ///< machines whose statuses get another reader
  std::atomic<int> refusals{0};      ///< so many writes of blocks fail with Timeout
  std::function<void(const dds::Command&)>
      on_command;  ///< plays the gateway, on the writer's thread
  std::function<void(const dds::LineRequest&)> on_line_request = {};  ///< likewise

  /// Waits until `holds` is true, at most a minute. The lock is held while it is asked.
  bool wait(const std::function<bool()>& holds) {
    std::unique_lock lock(mutex);
    return changed.wait_for(lock, kPatience, holds);
  }
};

class FakeServerEndpoint final : public dds::ServerEndpoint {
 public:
  explicit FakeServerEndpoint(std::shared_ptr<WrittenMessages> written)
      : written_(std::move(written)) {}

  Result<void> write(const dds::RecordAck& message) override {
    return keep(written_->acks, message);
  }
  Result<void> write(const dds::Command& message) override {
    auto kept = keep(written_->commands, message);
    if (written_->on_command) written_->on_command(message);
    return kept;
  }
  Result<void> write(const dds::BlockData& message) override {
    if (written_->refusals > 0) {
      --written_->refusals;
      return fail(Errc::Timeout, "the queue is full");
    }
    return keep(written_->blocks, message);
  }
  Result<void> write(const dds::LineRequest& message) override {
    auto kept = keep(written_->line_requests, message);
    if (written_->on_line_request) written_->on_line_request(message);
    return kept;
  }
  void renew_status(const std::string& machine) override {
    // NOLINTNEXTLINE(bugprone-unused-return-value): it is always kept
    (void)keep(written_->renewed, machine).has_value();
  }
  dds::Rejected rejected() const override { return {}; }

 private:
  template <class Message>
  Result<void> keep(std::vector<Message>& list, const Message& message) {
    {
      const std::lock_guard lock(written_->mutex);
      list.push_back(message);
    }
    written_->changed.notify_all();
    return {};
  }
  std::shared_ptr<WrittenMessages> written_;
};

}  // namespace dripline::test_support
