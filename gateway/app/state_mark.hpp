#pragma once

#include <filesystem>
#include <utility>

#include "protocol/base/result.hpp"

namespace dripline::gateway {

/// One thing that is so or not, and outlives the process however that ends: a file that is there or
/// not. One thread.
class StateMark {
 public:
  /// Empty: nothing is kept.
  explicit StateMark(std::filesystem::path file) : file_(std::move(file)) {}

  /// Where that cannot be seen, it is.
  bool is_set() const;
  /// On disk when it returns. Errors: Io.
  Result<void> set() const;
  Result<void> clear() const;

 private:
  std::filesystem::path file_;
};

}  // namespace dripline::gateway
