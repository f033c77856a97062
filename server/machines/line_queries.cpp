#include "server/machines/line_queries.hpp"

#include <utility>

#include "server/machines/identifiers.hpp"

namespace dripline::machines {

Result<dds::LineData> LineQueries::ask(dds::LineRequest request, std::chrono::milliseconds limit) {
  const auto end = std::chrono::steady_clock::now() + limit;
  request.session = session_of_(request.machine);
  if (request.session == 0)
    return fail(Errc::Timeout, "machine '{}' is not connected", request.machine);
  request.id = make_command_id();
  std::unique_lock lock(mutex_);
  waiting_[request.id] = {.machine = request.machine, .data = {}};
  Result<dds::LineData> answer =
      fail(Errc::Timeout, "machine '{}' did not answer {} within {} s", request.machine,
           dds::to_string(request.action), std::chrono::duration<double>(limit).count());
  while (std::chrono::steady_clock::now() < end && !is_stopping_) {
    lock.unlock();
    // Lost, or not accepted: the next round tries again.
    const auto written = endpoint_.write(request);
    lock.lock();
    if (!written && written.error().code == Errc::Unsupported) {
      answer = fail(written.error());
      break;
    }
    const auto next = std::min(end, std::chrono::steady_clock::now() + kRepeat);
    const Waiting& waiting = waiting_.at(request.id);
    changed_.wait_until(lock, next, [&] { return waiting.data.has_value() || is_stopping_; });
    if (!waiting.data) continue;
    auto data = std::exchange(waiting_.at(request.id).data, std::nullopt);
    if (data->status == dds::LineResult::NotYet) {
      changed_.wait_until(lock, next, [this] { return is_stopping_; });
      continue;
    }
    if (data->status == dds::LineResult::Refused) {
      answer = fail(Errc::Busy, "machine '{}': {}", request.machine, data->reason);
    } else {
      answer = *std::move(data);
    }
    break;
  }
  waiting_.erase(request.id);
  if (is_stopping_) return fail(Errc::Io, "the server is stopping");
  return answer;
}

void LineQueries::on_data(dds::LineData data) {
  {
    const std::lock_guard lock(mutex_);
    const auto found = waiting_.find(data.id);
    if (found == waiting_.end() || found->second.machine != data.machine) return;
    found->second.data = std::move(data);
  }
  changed_.notify_all();
}

void LineQueries::stop() {
  {
    const std::lock_guard lock(mutex_);
    is_stopping_ = true;
  }
  changed_.notify_all();
}

}  // namespace dripline::machines
