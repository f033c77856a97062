#pragma once

#include <cstdint>
#include <functional>
#include <list>
#include <utility>

namespace dripline::api {

/// The memory that the request bodies of all connections may use together. On one thread.
class BodyMemory {
 public:
  explicit BodyMemory(std::uint64_t limit) : left_(limit) {}

  /// A share that is returned when it is destroyed.
  class Share {
   public:
    Share() = default;
    Share(BodyMemory& memory, std::uint64_t size) : memory_(&memory), size_(size) {}
    Share(Share&& other) noexcept
        : memory_(std::exchange(other.memory_, nullptr)), size_(other.size_) {}
    Share& operator=(Share&& other) noexcept {
      std::swap(memory_, other.memory_);
      std::swap(size_, other.size_);
      return *this;
    }
    ~Share() {
      if (memory_ != nullptr) memory_->give_back(size_);
    }

   private:
    BodyMemory* memory_ = nullptr;
    std::uint64_t size_ = 0;
  };

  bool has(std::uint64_t size) const { return size <= left_; }
  Share take(std::uint64_t size) {
    left_ -= size;
    return {*this, size};
  }

  /// `wake` is called whenever memory is returned, until it is removed.
  using Waiter = std::list<std::function<void()>>::iterator;
  Waiter wait(std::function<void()> wake) {
    return waiters_.insert(waiters_.end(), std::move(wake));
  }
  void remove(Waiter waiter) { waiters_.erase(waiter); }

 private:
  void give_back(std::uint64_t size) {
    left_ += size;
    for (const auto& wake : waiters_) wake();
  }
  std::uint64_t left_;
  std::list<std::function<void()>> waiters_;
};

}  // namespace dripline::api
