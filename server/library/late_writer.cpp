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

void LateWriter::write(std::string what, Write write) {
  std::unique_lock lock(mutex_);
  if (is_ended_ || waiting_.size() >= options_.max_waiting) {
    lock.unlock();
    static_cast<void>(try_one({.what = std::move(what), .write = std::move(write)}, true));
    return;
  }
  const std::uint64_t number = ++last_;
  waiting_.push_back({number, std::move(what), std::move(write)});
  changed_.notify_all();
  changed_.wait_for(lock, options_.patience, [&] { return written_ >= number; });
}

bool LateWriter::try_one(const Waiting& waiting, bool is_last_try) {
  const auto done = waiting.write();
  if (done) return true;
  if (!is_last_try && may_pass(done.error().code)) return false;
  process::log_error("lost, the store does not take it: {}: {}", waiting.what, done.error().what);
  return true;
}

void LateWriter::run(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, stop, [this] { return !waiting_.empty(); });
    if (waiting_.empty()) return;  // it ends
    const Waiting next = waiting_.front();
    lock.unlock();
    const bool is_done = try_one(next, stop.stop_requested());
    lock.lock();
    if (is_done) {
      waiting_.pop_front();
      written_ = next.number;
      changed_.notify_all();
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
