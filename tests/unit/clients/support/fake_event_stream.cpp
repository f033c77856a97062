#include "tests/unit/clients/support/fake_event_stream.hpp"

#include <utility>

namespace dripline::test_support {

void FakeEventStream::publish(const std::string& text) {
  const std::lock_guard lock(mutex_);
  events_.push_back(text);
  changed_.notify_all();
}

void FakeEventStream::cut() {
  const std::lock_guard lock(mutex_);
  cuts_ = true;
  changed_.notify_all();
}

void FakeEventStream::stop() {
  const std::lock_guard lock(mutex_);
  is_stopped_ = true;
  changed_.notify_all();
}

bool FakeEventStream::send(httplib::DataSink& sink, std::size_t& next) {
  std::unique_lock lock(mutex_);
  if (next == 0) sink.write(": hello\n\n", 9);
  changed_.wait(lock, [&] { return is_stopped_ || cuts_ || next < events_.size(); });
  if (is_stopped_ || std::exchange(cuts_, false)) return false;
  const std::string text = events_[next++];
  lock.unlock();
  return sink.write(text.data(), text.size());
}

}  // namespace dripline::test_support
