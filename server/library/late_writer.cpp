#include "server/library/late_writer.hpp"

#include <utility>

#include "protocol/process/log.hpp"

namespace dripline::library {
namespace {

bool may_pass(Errc code) {
  return code == Errc::Io || code == Errc::Busy || code == Errc::Timeout;
}

}  // namespace

LateWriter::LateWriter(Options options)
    : options_(options), thread_([this](const std::stop_token& stop) { run(stop); }) {}

void LateWriter::write(std::string what, Write write, AtEnd at_end) {
  std::unique_lock lock(mutex_);
  Waiting waiting{++last_, std::move(what), std::move(write), at_end};
  if (is_ended_ || waiting_.size() >= options_.max_waiting) {
    lock.unlock();
    if (auto done = try_one(waiting); !done) log_loss(waiting, done.error());
    return;
  }
  const std::uint64_t number = waiting.number;
  waiting_.push_back(std::move(waiting));
  changed_.notify_all();
  changed_.wait_for(lock, options_.patience, [&] { return written_ >= number; });
}

Result<void> LateWriter::try_one(const Waiting& waiting) {
  auto done = waiting.write();
  if (done || may_pass(done.error().code)) return done;
  log_loss(waiting, done.error());
  return {};
}

void LateWriter::log_loss(const Waiting& waiting, const Error& error) {
  if (waiting.at_end == AtEnd::Kept && may_pass(error.code)) {
    process::log_warning("not written yet, and kept for the next start: {}: {}", waiting.what,
                         error.what);
    return;
  }
  process::log_error("lost, the store does not take it: {}: {}", waiting.what, error.what);
}

void LateWriter::give_up() {
  const Error away{Errc::Io, "the store is away, and the server ends"};
  for (const Waiting& waiting : waiting_) log_loss(waiting, away);
  waiting_.clear();
}

void LateWriter::run(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, stop, [this] { return !waiting_.empty(); });
    if (waiting_.empty()) return;  // it ends
    const Waiting next = waiting_.front();
    lock.unlock();
    const bool is_last_try = stop.stop_requested();
    const bool is_done = try_one(next).has_value();
    lock.lock();
    if (is_done) {
      waiting_.pop_front();
      written_ = next.number;
      changed_.notify_all();
    } else if (is_last_try) {
      return give_up();
    } else {
      changed_.wait_for(lock, stop, options_.retry, [] { return false; });
    }
  }
}

void LateWriter::end() {
  {
    const std::lock_guard lock(mutex_);
    if (std::exchange(is_ended_, true)) return;
  }
  thread_.request_stop();
  thread_.join();
}

}  // namespace dripline::library
