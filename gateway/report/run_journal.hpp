#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "gateway/report/progress.hpp"
#include "protocol/base/result.hpp"

namespace dripline::report {

/// The counters of the active run, written at every executed block into a memory-mapped file: a
/// few stores, no system call, and yet what was written survives the end of the process at any
/// instruction, because the pages belong to the kernel. Two slots are written in turn, each with a
/// checksum over itself, so a torn one is detected and the one before is valid. After a power cut
/// the last `sync` is valid. One thread, one process.
class RunJournal {
 public:
  /// Creates the file when there is none; an invalid one is taken as empty. Errors: Io.
  static Result<RunJournal> open(const std::filesystem::path& file);
  RunJournal(RunJournal&& other) noexcept;
  RunJournal& operator=(RunJournal&&) = delete;
  ~RunJournal();

  struct Entry {
    std::string run;
    Progress progress;
  };
  /// What was written last; nullopt: no run.
  std::optional<Entry> read() const;

  /// A run begins (`run` at most kMaxRun bytes), all counters zero.
  void begin(std::string_view run);
  void write(const Progress& progress);
  /// No run any more.
  void clear();
  /// Makes what was written survive a power cut. Waits for the disk.
  Result<void> sync();

  static constexpr std::size_t kMaxRun = 40;

 private:
  static constexpr std::size_t kWords = 16;
  using Slot = std::array<std::uint64_t, kWords>;
  using Pages = std::array<Slot, 2>;
  explicit RunJournal(Pages* pages) : pages_(pages) {}
  void store();

  Pages* pages_;  ///< mapped; null when moved from
  std::array<char, kMaxRun> run_{};
  Progress progress_;
  std::uint64_t generation_ = 0;
};

}  // namespace dripline::report
