#pragma once

#include <cstdio>
#include <cstdlib>

namespace dripline {

/// A broken invariant of ours: never caused by outside data. Stays on in release builds and ends
/// the process, because going on could move a machine on wrong data.
inline void invariant(bool holds, const char* claim) {
  if (holds) return;
  std::fprintf(stderr, "dripline: broken invariant: %s\n", claim);
  std::abort();
}

}  // namespace dripline
