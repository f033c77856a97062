#include "server/mtconnect/observation_buffer.hpp"

#include <algorithm>

#include "protocol/base/invariant.hpp"

namespace dripline::mtconnect {
namespace {

bool is_quiet(Level level) {
  return level == Level::Normal || level == Level::Unavailable;
}

using States = std::vector<std::shared_ptr<const ConditionState>>;

/// The active states after `state`. A code that is not empty concerns that state alone.
States active_after(const Observation* before, const std::shared_ptr<const ConditionState>& state) {
  if (before == nullptr || (is_quiet(state->level) && state->native_code.empty())) return {state};
  States active;
  for (const auto& other : before->active) {
    if (!is_quiet(other->level) && other->native_code != state->native_code)
      active.push_back(other);
  }
  if (!is_quiet(state->level) || active.empty()) active.push_back(state);
  if (active.size() > ObservationBuffer::kMaxActive) active.erase(active.begin());
  return active;
}

bool is_same(const ConditionState& a, const ConditionState& b) {
  return a.level == b.level && a.native_code == b.native_code && a.text == b.text;
}

bool changes(const Observation* before, const NewObservation& made) {
  if (before == nullptr || made.is_discrete) return true;
  if (!made.condition) return before->value != made.value;
  if (is_quiet(made.condition->level) && made.condition->native_code.empty())
    return before->active.size() != 1 || !is_same(*before->active.front(), *made.condition);
  return std::ranges::none_of(before->active,
                              [&](const auto& state) { return is_same(*state, *made.condition); });
}

}  // namespace

ObservationBuffer::ObservationBuffer(std::size_t capacity)
    : capacity_(capacity), ring_(capacity), ring_items_(capacity) {
  invariant(capacity > 0, "an observation buffer has room");
}

void ObservationBuffer::set(std::vector<ObservationPointer>& state,
                            ObservationPointer observation) {
  const std::size_t item = observation->item;
  if (item >= state.size()) state.resize(item + 1);
  state[item] = std::move(observation);
}

void ObservationBuffer::add(std::span<const NewObservation> observations) {
  const std::lock_guard lock(mutex_);
  for (const auto& made : observations) add_one(made);
}

void ObservationBuffer::add_one(const NewObservation& made) {
  const Observation* before = made.item < latest_.size() ? latest_[made.item].get() : nullptr;
  if (!changes(before, made)) return;
  const std::uint64_t sequence = next_.load(std::memory_order_relaxed);
  auto observation = std::make_shared<Observation>();
  observation->sequence = sequence;
  observation->item = made.item;
  observation->time = made.time;
  observation->value = made.value;
  if (made.condition) {
    auto state = std::make_shared<ConditionState>(*made.condition);
    state->time = made.time;
    state->sequence = sequence;
    observation->condition = std::move(state);
    observation->active = active_after(before, observation->condition);
  }
  ObservationPointer& place = ring_[sequence % capacity_];
  if (place) set(before_, std::move(place));
  place = observation;
  ring_items_[sequence % capacity_] = made.item;
  set(latest_, std::move(observation));
  next_.store(sequence + 1, std::memory_order_release);
}

ObservationBuffer::Range ObservationBuffer::range_locked() const {
  const std::uint64_t next = next_.load(std::memory_order_relaxed);
  return {next > capacity_ ? next - capacity_ : 1, next};
}

ObservationBuffer::Range ObservationBuffer::range() const {
  const std::lock_guard lock(mutex_);
  return range_locked();
}

ObservationBuffer::State ObservationBuffer::latest() const {
  const std::lock_guard lock(mutex_);
  return {latest_, range_locked()};
}

Result<ObservationBuffer::State> ObservationBuffer::at(std::uint64_t sequence) const {
  const std::lock_guard lock(mutex_);
  const Range range = range_locked();
  if (sequence < range.first || sequence >= range.next) {
    return fail(Errc::LimitExceeded, "'at' must be from {} to {}", range.first, range.next - 1);
  }
  State state{before_, range};
  // Each item's last observation is copied once.
  std::vector<std::uint64_t> last(latest_.size(), 0);
  for (std::uint64_t i = range.first; i <= sequence; ++i) last[ring_items_[i % capacity_]] = i;
  state.latest.resize(latest_.size());
  for (std::size_t item = 0; item < last.size(); ++item) {
    if (last[item] != 0) state.latest[item] = in_ring(last[item]);
  }
  return state;
}

Result<ObservationBuffer::Answer> ObservationBuffer::sample(const Query& query) const {
  const std::lock_guard lock(mutex_);
  const Range range = range_locked();
  const bool is_backward = query.count < 0;
  const std::uint64_t last = std::max(range.first, range.next - 1);
  const std::uint64_t from = query.from.value_or(is_backward ? last : range.first);
  if (from < range.first || from > range.next) {
    return fail(Errc::LimitExceeded, "'from' must be from {} to {}", range.first, range.next);
  }
  const auto wanted = static_cast<std::uint64_t>(is_backward ? -query.count : query.count);
  Answer answer;
  answer.range = range;
  const auto take = [&](std::uint64_t sequence) {
    if (query.items == nullptr || query.items->has(ring_items_[sequence % capacity_]))
      answer.observations.push_back(in_ring(sequence));
  };
  std::uint64_t at = from;
  if (is_backward) {
    if (at == range.next) --at;
    while (at >= range.first && answer.observations.size() < wanted) take(at--);
    std::ranges::reverse(answer.observations);
    // What is asked for next in this direction; the first when there is nothing before it.
    answer.next = std::max(at, range.first);
  } else {
    while (at < range.next && answer.observations.size() < wanted) take(at++);
    answer.next = at;
  }
  return answer;
}

}  // namespace dripline::mtconnect
