#pragma once

namespace dripline::test_support {

/// Whether a program under test may get a library preloaded: a sanitizer must come first.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kCanPreload = false;
#else
inline constexpr bool kCanPreload = true;
#endif

}  // namespace dripline::test_support
