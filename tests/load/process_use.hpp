#pragma once

#include <sys/types.h>
#include <cstdint>

namespace dripline::load {

/// What a process has taken so far, from /proc. Zeros: it is gone.
struct ProcessUse {
  double cpu_seconds = 0;
  std::uint64_t memory_bytes = 0;  ///< resident
  std::uint64_t threads = 0;
};
ProcessUse use_of(pid_t process);

}  // namespace dripline::load
