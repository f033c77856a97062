#pragma once

#include <cstdint>
#include <functional>
#include <list>
#include <map>
#include <string>
#include <utility>

namespace dripline::api {

/// The memory that the larger request bodies of all connections may use together, and those of one
/// caller half of it. A small body needs none, and so waits for no other: the number of connections
/// bounds what these take. A stop has a small body. On one thread.
class BodyMemory {
 public:
  explicit BodyMemory(std::uint64_t limit) : limit_(limit), left_(limit) {}

  static constexpr std::uint64_t kSmall = 16 * 1024;

  /// A share that is returned when it is destroyed.
  class Share {
   public:
    Share() = default;
    Share(BodyMemory& memory, std::uint64_t size, std::string caller)
        : memory_(&memory), size_(size), caller_(std::move(caller)) {}
    Share(Share&& other) noexcept
        : memory_(std::exchange(other.memory_, nullptr)),
          size_(other.size_),
          caller_(std::move(other.caller_)) {}
    Share& operator=(Share&& other) noexcept {
      std::swap(memory_, other.memory_);
      std::swap(size_, other.size_);
      std::swap(caller_, other.caller_);
      return *this;
    }
    ~Share() {
      if (memory_ != nullptr) memory_->give_back(size_, caller_);
    }

   private:
    BodyMemory* memory_ = nullptr;
    std::uint64_t size_ = 0;
    std::string caller_;
  };

  bool has(std::uint64_t size, const std::string& caller) const {
    if (size <= kSmall) return true;
    const auto held = held_.find(caller);
    return size <= left_ && (held == held_.end() || held->second + size <= limit_ / 2);
  }
  /// Where `has` is true.
  Share take(std::uint64_t size, const std::string& caller) {
    if (size <= kSmall) return {};
    left_ -= size;
    held_[caller] += size;
    return {*this, size, caller};
  }

  /// `wake` is called whenever memory is returned, until it is removed.
  using Waiter = std::list<std::function<void()>>::iterator;
  Waiter wait(std::function<void()> wake) {
    return waiters_.insert(waiters_.end(), std::move(wake));
  }
  void remove(Waiter waiter) { waiters_.erase(waiter); }

 private:
  void give_back(std::uint64_t size, const std::string& caller) {
    left_ += size;
    const auto held = held_.find(caller);
    held->second -= size;
    if (held->second == 0) held_.erase(held);
    for (const auto& wake : waiters_) wake();
  }

  const std::uint64_t limit_;
  std::uint64_t left_;
  std::map<std::string, std::uint64_t> held_;  ///< of callers that have some
  std::list<std::function<void()>> waiters_;
};

}  // namespace dripline::api
