#pragma once

#include <functional>
#include <string>
#include <vector>

#include "gateway/report/outbox.hpp"
#include "protocol/base/clock.hpp"

namespace dripline::gateway {

/// The records of a machine on a line: staged, committed, and tried again while the disk refuses.
/// One thread.
class SerialRecords {
 public:
  struct Parts {
    std::string machine;
    report::Outbox& outbox;
    const Clock& clock;
  };
  explicit SerialRecords(Parts parts) : parts_(std::move(parts)) {}

  struct Entry {
    dds::RecordKind kind = dds::RecordKind::Message;
    std::string run = {}, device = {}, text = {};
  };
  void append(Entry entry);
  /// Called after the next commit that succeeds.
  void call_when_kept(std::function<void()> kept) { kept_.push_back(std::move(kept)); }
  /// Errors: those of the outbox; what is staged stays, and `poll` tries again.
  Result<void> commit();
  /// Tries again what is due.
  void poll(SteadyTime now);
  /// Drops what was staged since the last commit.
  void discard();
  /// Why the last commit failed; empty: it did not.
  const std::string& fault() const { return fault_; }
  bool has_staged() const { return parts_.outbox.has_staged_records(); }

 private:
  Parts parts_;
  std::vector<std::function<void()>> kept_;
  std::string fault_;
  SteadyTime next_try_{};
};

}  // namespace dripline::gateway
