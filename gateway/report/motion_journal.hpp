#pragma once

#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include "gateway/machine/given_action.hpp"
#include "gateway/report/progress.hpp"
#include "protocol/base/result.hpp"

namespace dripline::report {

/// The motion of the active run that a device was given and may have executed since it reported
/// last: a ring in a memory-mapped file, written before the device gets it, so that a gateway that
/// was killed finds out from where the axes rest what was executed. As RunJournal: it outlives the
/// end of the process at any instruction, not a power cut. One thread, one process.
class MotionJournal {
 public:
  /// Creates the file when there is none; one of another layout is taken as empty. Errors: Io.
  static Result<MotionJournal> open(const std::filesystem::path& file);
  MotionJournal(MotionJournal&& other) noexcept;
  MotionJournal& operator=(MotionJournal&&) = delete;
  ~MotionJournal();

  struct Entry {
    Progress place;  ///< when the block of the action has ended
    machine::GivenAction action;
  };
  /// A run begins (`run` at most kMaxRun bytes): nothing was given to the device yet.
  void begin(std::string_view run);
  void write(const Entry& entry);
  /// Of this run, what follows the end of the block `executed`, in its order; empty: the file has
  /// another run, or the ring was too small.
  std::vector<Entry> read(std::string_view run, std::uint64_t executed) const;

  static constexpr std::size_t kMaxRun = 40;
  static constexpr std::size_t kEntries = 16'384;  ///< more actions than a back end queues

 private:
  struct Slot {
    std::uint64_t before = 0;  ///< the number of the entry, counted from 1 over all runs
    Entry entry;
    std::uint64_t after = 0;  ///< the same
  };
  struct Pages {
    std::uint64_t layout = 0;
    std::uint64_t base = 0;  ///< the number before the run's first entry
    std::array<char, kMaxRun> run{};
    std::array<Slot, kEntries> slots;
  };
  explicit MotionJournal(Pages* pages) : pages_(pages) {}

  Pages* pages_;  ///< mapped; null when moved from
  std::uint64_t number_ = 0;
};

}  // namespace dripline::report
