#pragma once

#include <string>

#include "tests/support/line/line_simulator.hpp"

/// Seeded transfers over a bad line, and what must hold of each whatever happens.
namespace dripline::test_support {

/// How many runs one protocol gets: DRIPLINE_FAULT_RUNS, 10,000 unless set.
std::size_t fault_runs();
/// Where the seeds begin: DRIPLINE_FAULT_SEED, 1 unless set.
std::uint64_t first_fault_seed();

/// One direction of one protocol on lines of one badness.
struct FaultCase {
  wire::LineSettings settings;
  bool host_sends = true;
  LineFaults faults;
  double hold_rate = 0;  ///< of the receiving owner
  wire::LineTime hold_time = std::chrono::milliseconds(20);
  wire::LineTime limit = std::chrono::hours(1);  ///< virtual
  /// What the receiver shall get of a text; text as it was sent unless set.
  std::function<std::string(const std::string&)> expected;
  /// Makes a text of so many blocks; random_program unless set.
  std::function<std::string(FaultDice&, std::size_t)> program;
};

/// One transfer that has ended.
struct FaultRun {
  std::uint64_t seed = 0;
  std::string text;      ///< that was sent
  std::string expected;  ///< of the receiver
  LineSimulator::Outcome outcome = LineSimulator::Outcome::Idle;
  LineEnd* sender = nullptr;
  LineEnd* receiver = nullptr;
  LineSimulator::Direction forward, backward;  ///< from the sender, to the sender
  /// In words, for a failed test.
  std::string story() const;

  bool is_reported() const;  ///< an end reported a fault or a failure
  bool is_exact() const { return receiver->receptions == 1 && receiver->received == expected; }
  bool has_ended() const;  ///< each end is idle, or waits where the protocol lets it
};

/// Program text of a few blocks, another one for each seed.
std::string random_program(FaultDice& dice, std::size_t blocks);

/// Runs seeds first..first+count-1 and calls `check` after each.
void run_faults(const FaultCase& fault_case, std::uint64_t first, std::size_t count,
                const std::function<void(const FaultRun&)>& check);

}  // namespace dripline::test_support
