#pragma once

#include <chrono>

namespace dripline::test_support {

/// How long a test waits for what comes, before it fails: far longer than it takes, because many
/// tests share a computer. What must come within a time says its own limit.
inline constexpr std::chrono::seconds kPatience{60};

}  // namespace dripline::test_support
