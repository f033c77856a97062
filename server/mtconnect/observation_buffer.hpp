#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "protocol/base/clock.hpp"
#include "protocol/base/result.hpp"

namespace dripline::mtconnect {

enum class Level : std::uint8_t { Normal, Warning, Fault, Unavailable };

/// One state of a condition. Normal without a code clears all its states, with a code that one.
struct ConditionState {
  Level level = Level::Unavailable;
  std::string native_code, text;
  UtcTime time;  ///< this and the next are the buffer's
  std::uint64_t sequence = 0;
};

/// What was observed: a value, a state of a condition, or that there is none (UNAVAILABLE).
struct NewObservation {
  std::uint32_t item = 0;  ///< Model::items
  UtcTime time;
  std::optional<std::string> value;  ///< absent: UNAVAILABLE; of a condition not used
  std::optional<ConditionState> condition = {};
  bool is_discrete = false;  ///< kept also when the value is the one before
};

/// An observation with its number. Immutable.
struct Observation {
  std::uint64_t sequence = 0;
  std::uint32_t item = 0;
  UtcTime time;
  std::optional<std::string> value;
  std::shared_ptr<const ConditionState> condition;  ///< nullptr: not of a condition
  /// The states that are active since, this one included, oldest first; of a condition only.
  std::vector<std::shared_ptr<const ConditionState>> active;
};
using ObservationPointer = std::shared_ptr<const Observation>;

/// Data items by their place in Model::items.
class ItemSet {
 public:
  void add(std::uint32_t item) {
    if (item >= bits_.size()) bits_.resize(item + 1);
    if (!bits_[item]) ++size_;
    bits_[item] = true;
  }
  bool has(std::uint32_t item) const { return item < bits_.size() && bits_[item]; }
  std::size_t size() const { return size_; }

 private:
  std::vector<bool> bits_;
  std::size_t size_ = 0;
};

/// The last observations of all data items, numbered from 1 without gaps, and the state that they
/// led to. When the ring is full the oldest make room; what they were goes into the state before
/// the oldest, so that the state at any number in the ring is known. Any thread.
class ObservationBuffer {
 public:
  static constexpr std::size_t kCapacity = 131'072;
  static constexpr std::size_t kMaxActive = 32;  ///< states of one condition; the oldest goes

  /// `capacity`: at least 1.
  explicit ObservationBuffer(std::size_t capacity = kCapacity);

  /// Sequence numbers; first = next: there is none.
  struct Range {
    std::uint64_t first = 1, next = 1;
  };
  /// Adds them in their order; those that change nothing are left out, unless they are discrete.
  void add(std::span<const NewObservation> observations);
  std::size_t capacity() const { return capacity_; }
  /// The number of the next observation, without waiting.
  std::uint64_t next() const { return next_.load(std::memory_order_acquire); }
  Range range() const;

  struct State {
    std::vector<ObservationPointer> latest;  ///< by data item; nullptr: none was observed yet
    Range range;
  };
  State latest() const;
  /// After the observation `sequence`. Errors: LimitExceeded (it is not in the ring).
  Result<State> at(std::uint64_t sequence) const;

  struct Query {
    std::optional<std::uint64_t> from = {};  ///< absent: the first, or the last when `count` < 0
    std::int64_t count = 100;                ///< negative: backward from `from`; not 0
    const ItemSet* items = nullptr;          ///< nullptr: all; not kept
  };
  struct Answer {
    std::vector<ObservationPointer> observations;  ///< ascending
    std::uint64_t next = 1;                        ///< to be asked for next
    Range range;
  };
  /// Errors: LimitExceeded (`from` is neither in the ring nor the next number).
  Result<Answer> sample(const Query& query) const;

 private:
  const ObservationPointer& in_ring(std::uint64_t sequence) const {
    return ring_[sequence % capacity_];
  }
  Range range_locked() const;
  void add_one(const NewObservation& made);
  void set(std::vector<ObservationPointer>& state, ObservationPointer observation);

  const std::size_t capacity_;
  mutable std::mutex mutex_;
  std::vector<ObservationPointer> ring_;    ///< by sequence modulo capacity
  std::vector<std::uint32_t> ring_items_;   ///< their data items: looked through in one go
  std::vector<ObservationPointer> latest_;  ///< by data item
  std::vector<ObservationPointer> before_;  ///< the state before the first in the ring
  std::atomic<std::uint64_t> next_ = 1;
};

}  // namespace dripline::mtconnect
