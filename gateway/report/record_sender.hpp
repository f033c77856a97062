#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "gateway/report/outbox.hpp"
#include "protocol/base/clock.hpp"

namespace dripline::report {

struct SenderOptions {
  /// Records sent and not acknowledged; well below what the network holds for a live peer.
  std::uint64_t window = 128;
  std::chrono::milliseconds retry{
      500};  ///< silence after which all of them are sent again; doubles
  std::chrono::milliseconds max_retry{5000};
  std::chrono::milliseconds busy{5};  ///< before a repetition of what the network did not take
  std::chrono::milliseconds flush{1000};
  int foreign_acks = 3;  ///< in a row that name less than was acknowledged before: a new epoch
};

/// Sends committed records until they are acknowledged: go-back-N. Records are numbered and the
/// server stores each number once, so sending again is always safe. Pure but for the outbox: time
/// comes in, records go out through a callback. One thread.
class RecordSender {
 public:
  /// False: not taken, try later.
  using Send = std::function<bool(const dds::Record&)>;
  /// `outbox` must outlive it.
  RecordSender(std::string machine, Outbox& outbox, SenderOptions options, Send send);

  void on_server(bool is_connected);
  void on_ack(const dds::RecordAck& ack, SteadyTime now);
  /// Sends what is due. Errors: those of the outbox.
  Result<void> poll(SteadyTime now);
  /// When poll has something to do without anything else happening.
  std::optional<SteadyTime> next_poll() const { return next_poll_; }
  /// Once after the outbox began a new epoch: announce it.
  bool take_epoch_change() { return std::exchange(epoch_changed_, false); }

 private:
  Result<void> send_window(SteadyTime now);
  void wait_until(SteadyTime time);
  void go_back();

  std::string machine_;
  Outbox& outbox_;
  SenderOptions options_;
  Send send_;
  bool is_connected_ = false, epoch_changed_ = false;
  std::uint64_t sent_ = 0;  ///< up to and with this number
  int silences_ = 0, foreign_acks_ = 0;
  SteadyTime deadline_{}, last_flush_{};
  std::optional<SteadyTime> next_poll_;
};

}  // namespace dripline::report
