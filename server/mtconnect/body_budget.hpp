#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <utility>

namespace dripline::mtconnect {

/// The memory that large documents that are sent to clients may use together. Any thread.
class BodyBudget {
 public:
  static constexpr std::uint64_t kSmall = 256ull * 1024;  ///< smaller ones are not counted

  explicit BodyBudget(std::uint64_t size) : left_(static_cast<std::int64_t>(size)) {}

  /// Returned when it is destroyed.
  class Share {
   public:
    Share() = default;
    Share(BodyBudget& budget, std::int64_t size) : budget_(&budget), size_(size) {}
    Share(Share&& other) noexcept
        : budget_(std::exchange(other.budget_, nullptr)), size_(other.size_) {}
    Share& operator=(Share&& other) noexcept {
      std::swap(budget_, other.budget_);
      std::swap(size_, other.size_);
      return *this;
    }
    ~Share() {
      if (budget_ != nullptr) budget_->left_ += size_;
    }

   private:
    BodyBudget* budget_ = nullptr;
    std::int64_t size_ = 0;
  };

  /// nullopt: too much is in progress.
  std::optional<Share> take(std::uint64_t bytes) {
    if (bytes < kSmall) return Share();
    const auto size = static_cast<std::int64_t>(bytes);
    if ((left_ -= size) >= 0) return Share(*this, size);
    left_ += size;
    return std::nullopt;
  }

 private:
  std::atomic<std::int64_t> left_;
};

}  // namespace dripline::mtconnect
