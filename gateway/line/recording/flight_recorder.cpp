#include "gateway/line/recording/flight_recorder.hpp"

#include <algorithm>
#include "protocol/process/log.hpp"

namespace dripline::line {
namespace {

using What = serial::LineTraffic::What;

bool has_bytes(What what) {
  return what == What::Sent || what == What::Received;
}

std::size_t cost(const PortTraffic& entry) {
  return sizeof(PortTraffic) + entry.bytes.capacity() + entry.text.capacity();
}

}  // namespace

FlightRecorder::FlightRecorder(Options options, const Clock& clock,
                               std::function<void(const PortTraffic&)> on_entry)
    : options_(std::move(options)), clock_(clock), on_entry_(std::move(on_entry)) {
  if (options_.folder.empty()) return;
  file_.emplace(options_.folder, options_.port);
  for (auto& entry : file_->read()) append(std::move(entry));
  untold_ = 0;
  first_ -= entries_.size();
  drop_old(clock_.now());
}

/// Whether it continues the open entry.
bool FlightRecorder::joins(const serial::LineTraffic& traffic, UtcTime now) const {
  return open_ && has_bytes(traffic.what) && open_->what == traffic.what &&
         open_->bytes.size() < kMaxEntry && now - open_->time < kMaxSpan;
}

void FlightRecorder::add(const serial::LineTraffic& traffic) {
  const UtcTime now = clock_.now();
  const std::lock_guard lock(mutex_);
  if (!joins(traffic, now)) close_open(now);
  const std::string_view bytes(reinterpret_cast<const char*>(traffic.bytes.data()),
                               traffic.bytes.size());
  if (traffic.what == What::Sent) sent_ += bytes.size();
  if (traffic.what == What::Received) received_ += bytes.size();
  if (traffic.what == What::Fault) ++faults_;
  if (open_) {
    open_->bytes += bytes;
    return;
  }
  PortTraffic entry{.port = options_.port,
                    .time = now,
                    .what = traffic.what,
                    .bytes = std::string(bytes),
                    .text = std::string(traffic.text)};
  if (has_bytes(traffic.what)) {
    open_ = std::move(entry);
  } else {
    append(std::move(entry));
  }
}

void FlightRecorder::close_open(UtcTime now) {
  if (open_) append(*std::move(open_));
  open_.reset();
  drop_old(now);
}

void FlightRecorder::append(PortTraffic entry) {
  bytes_ += cost(entry);
  entries_.push_back(std::move(entry));
  ++untold_;
}

void FlightRecorder::drop_old(UtcTime now) {
  while (!entries_.empty() &&
         (bytes_ > options_.max_bytes || now - entries_.front().time > options_.max_age)) {
    bytes_ -= cost(entries_.front());
    entries_.pop_front();
    ++first_;
  }
  untold_ = std::min(untold_, entries_.size());
}

void FlightRecorder::flush() {
  const std::lock_guard one_at_a_time(flushing_);
  const UtcTime now = clock_.now();
  std::vector<PortTraffic> fresh;
  {
    const std::lock_guard lock(mutex_);
    if (open_ && now - open_->time >= kMaxSpan) close_open(now);
    drop_old(now);
    fresh.assign(entries_.end() - static_cast<std::ptrdiff_t>(untold_), entries_.end());
    untold_ = 0;
  }
  if (fresh.empty()) return;
  for (const auto& entry : fresh) on_entry_(entry);
  if (!file_) return;
  if (auto written = file_->write(fresh); !written) {
    process::log_warning("port={}: {}", options_.port, written.error().what);
  }
}

void FlightRecorder::on_opened() {
  const std::lock_guard lock(mutex_);
  sent_ = received_ = faults_ = 0;
}

std::vector<PortTraffic> FlightRecorder::entries() const {
  const std::lock_guard lock(mutex_);
  std::vector<PortTraffic> entries(entries_.begin(), entries_.end());
  if (open_) entries.push_back(*open_);
  return entries;
}

FlightRecorder::Part FlightRecorder::entries_from(std::uint64_t number,
                                                  std::size_t max_entries) const {
  const std::lock_guard lock(mutex_);
  Part part{.first = std::clamp(number, first_, first_ + entries_.size()), .entries = {}};
  const auto begin = entries_.begin() + static_cast<std::ptrdiff_t>(part.first - first_);
  const auto size =
      std::min<std::size_t>(max_entries, static_cast<std::size_t>(entries_.end() - begin));
  part.entries.assign(begin, begin + static_cast<std::ptrdiff_t>(size));
  return part;
}

std::uint64_t FlightRecorder::next_number() const {
  const std::lock_guard lock(mutex_);
  return first_ + entries_.size();
}

std::uint64_t FlightRecorder::sent() const {
  const std::lock_guard lock(mutex_);
  return sent_;
}

std::uint64_t FlightRecorder::received() const {
  const std::lock_guard lock(mutex_);
  return received_;
}

std::uint64_t FlightRecorder::faults() const {
  const std::lock_guard lock(mutex_);
  return faults_;
}

}  // namespace dripline::line
