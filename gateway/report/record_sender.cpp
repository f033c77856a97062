#include "gateway/report/record_sender.hpp"

#include <algorithm>
#include <utility>

namespace dripline::report {

RecordSender::RecordSender(std::string machine, Outbox& outbox, SenderOptions options, Send send)
    : machine_(std::move(machine)), outbox_(outbox), options_(options), send_(std::move(send)) {
  go_back();
}

void RecordSender::go_back() {
  sent_ = outbox_.acknowledged();
}

void RecordSender::on_server(bool is_connected) {
  is_connected_ = is_connected;
  silences_ = 0;
  foreign_acks_ = 0;
  go_back();
}

void RecordSender::on_ack(const dds::RecordAck& ack, SteadyTime now) {
  const bool is_decided = foreign_acks_ >= options_.foreign_acks;  // poll begins a new epoch
  if (ack.epoch != outbox_.epoch() || is_decided) return;
  const std::uint64_t before = outbox_.acknowledged();
  // A server that repeatedly names less than another one confirmed has another history than ours.
  // One that names a number we never gave has records of ours that we have lost: waiting until our
  // numbers reach it would make it confirm records it never received.
  const bool is_ahead = ack.number > outbox_.last_number();
  const bool is_foreign = is_ahead || ack.number < before;
  foreign_acks_ = is_ahead ? options_.foreign_acks : is_foreign ? foreign_acks_ + 1 : 0;
  if (is_foreign || ack.number == before) return;
  outbox_.acknowledge(ack.number);
  sent_ = std::max(sent_, ack.number);
  silences_ = 0;
  deadline_ = now + options_.retry;
}

Result<void> RecordSender::poll(SteadyTime now) {
  next_poll_.reset();
  if (foreign_acks_ >= options_.foreign_acks) {
    if (const auto done = outbox_.begin_epoch(); !done) return done;
    foreign_acks_ = 0;
    epoch_changed_ = true;
    go_back();
  }
  if (now - last_flush_ >= options_.flush) {
    last_flush_ = now;
    if (const auto done = outbox_.flush(); !done) return done;
  }
  if (!is_connected_ || outbox_.unacknowledged() == 0) return {};
  const bool waits_for_ack = sent_ > outbox_.acknowledged();
  if (waits_for_ack && now >= deadline_) {
    ++silences_;
    go_back();
  }
  return send_window(now);
}

Result<void> RecordSender::send_window(SteadyTime now) {
  const std::uint64_t end =
      std::min(outbox_.acknowledged() + options_.window, outbox_.last_number());
  if (sent_ < end) {
    if (sent_ == outbox_.acknowledged()) {
      const auto wait = options_.retry * (1 << std::min(silences_, 6));
      deadline_ = now + std::min<std::chrono::milliseconds>(wait, options_.max_retry);
    }
    const auto records = outbox_.read(machine_, sent_, static_cast<std::size_t>(end - sent_));
    if (!records) return fail(records.error());
    for (const dds::Record& record : *records) {
      if (!send_(record)) {
        wait_until(now + options_.busy);
        break;
      }
      sent_ = record.number;
    }
  }
  wait_until(deadline_);
  return {};
}

void RecordSender::wait_until(SteadyTime time) {
  next_poll_ = next_poll_ ? std::min(*next_poll_, time) : time;
}

}  // namespace dripline::report
