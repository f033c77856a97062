#pragma once

#include <cstdint>
#include <string>

namespace dripline::report {

/// The progress of a run: the three counters, and the place of the block executed last.
struct Progress {
  std::uint64_t sent = 0;      ///< bytes of the program received
  std::uint64_t accepted = 0;  ///< blocks interpreted
  std::uint64_t executed = 0;  ///< blocks finished by the machine
  std::uint64_t line = 0;
  std::int64_t sequence = -1;
  std::uint64_t offset = 0;
  std::uint64_t path = 0;  ///< hash of everything that was sent to the machine up to that block; 0:
                           ///< not known
  friend bool operator==(const Progress&, const Progress&) = default;
};

/// The active run, as it was started.
struct ActiveRun {
  std::string run, program, revision, control;
  std::uint64_t size = 0;
};

}  // namespace dripline::report
