#pragma once

#include "tests/support/sanitized.hpp"

namespace dripline::test_support {

/// Whether a program under test may get a library preloaded: a sanitizer must come first.
inline constexpr bool kCanPreload = !kIsSanitized;

}  // namespace dripline::test_support
