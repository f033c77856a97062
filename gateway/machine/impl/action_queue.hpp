#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gateway/machine/impl/action.hpp"

namespace dripline::machine::impl {

/// The queued actions in sequence: a ring of fixed size. Every action has a unique number, so that
/// a plan can name the actions it covers.
class ActionQueue {
 public:
  ActionQueue(std::size_t actions, std::size_t text_bytes) : ring_(actions), texts_(text_bytes) {}

  bool empty() const { return size_ == 0; }
  std::size_t size() const { return size_; }
  std::size_t capacity() const { return ring_.size(); }
  /// Numbers: of the oldest action, and of the next to come.
  std::uint64_t first() const { return first_; }
  std::uint64_t next() const { return first_ + size_; }

  Action& front() { return ring_[head_]; }
  const Action& front() const { return ring_[head_]; }
  Action& back() { return at(size_ - 1); }
  Action& at(std::size_t index) {
    const std::size_t place = head_ + index;
    return ring_[place < ring_.size() ? place : place - ring_.size()];
  }

  /// Not when full. `body` is a fresh BlockEnd to be replaced.
  Action& push(const interpreter::Origin& origin) {
    ++size_;
    Action& action = back();
    action.origin = origin;
    action.ends_block = false;
    action.lock = {};
    action.seconds = 0;
    return action;
  }
  void set_seconds(Action& action, double seconds) {
    action.seconds = seconds;
    seconds_ += seconds;
  }
  /// Takes back the one just pushed; it had no text.
  void drop_back() { seconds_ -= back().seconds, --size_; }
  void pop() {
    if (const auto* text = std::get_if<Text>(&front().body)) texts_.pop(text->piece);
    seconds_ -= front().seconds;
    if (++head_ == ring_.size()) head_ = 0;
    ++first_;
    if (--size_ == 0) seconds_ = 0;  // rounding errors do not add up
  }
  void clear() {
    first_ += size_;
    size_ = head_ = 0;
    seconds_ = 0;
    texts_.clear();
    probe.reset();
    alarm.reset();
  }

  double seconds() const { return seconds_; }
  TextRing& texts() { return texts_; }
  const TextRing& texts() const { return texts_; }

  /// At most one of each can wait.
  std::optional<interpreter::Probe> probe;
  std::optional<interpreter::Diagnostic> alarm;

 private:
  std::vector<Action> ring_;
  TextRing texts_;
  std::size_t head_ = 0, size_ = 0;
  std::uint64_t first_ = 0;
  double seconds_ = 0;
};

}  // namespace dripline::machine::impl
