#pragma once

#include <memory>
#include <utility>

namespace dripline {

/// A value or none, like std::optional, whose copies share it: copying costs a counter, however
/// large the value is. Each copy may be used by a thread of its own.
template <class T>
class Shared {
 public:
  Shared() = default;
  Shared(T value) : value_(std::make_shared<T>(std::move(value))) {}

  explicit operator bool() const { return value_ != nullptr; }
  bool has_value() const { return value_ != nullptr; }
  const T& operator*() const { return *value_; }
  const T* operator->() const { return value_.get(); }

  /// A new value, which no other copy has.
  T& emplace() {
    value_ = std::make_shared<T>();
    return *value_;
  }
  /// The value to be changed, of this copy alone; there must be one.
  T& edit() {
    if (value_.use_count() > 1) value_ = std::make_shared<T>(*value_);
    return *value_;
  }
  void reset() { value_.reset(); }

 private:
  std::shared_ptr<T> value_;
};

}  // namespace dripline
