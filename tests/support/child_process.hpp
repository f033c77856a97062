#pragma once

#include <sys/types.h>
#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tests/support/patience.hpp"

namespace dripline::test_support {

/// A real program under test. Its output goes to a file; it is killed when the object ends. Not
/// thread-safe.
class ChildProcess {
 public:
  /// `command[0]` is a path. Dies with the test process.
  ChildProcess(const std::vector<std::string>& command, std::filesystem::path output);
  ~ChildProcess();
  ChildProcess(ChildProcess&& other) noexcept;
  ChildProcess& operator=(ChildProcess&& other) noexcept;

  pid_t pid() const { return pid_; }
  void signal(int number) const;
  /// Kills it with SIGKILL and waits for its end.
  void kill();
  /// Its exit status (128 + signal when killed), or nullopt when it has not ended in time.
  std::optional<int> wait(std::chrono::milliseconds limit = kPatience);
  bool is_running();
  std::string output() const;
  /// Highest resident memory so far, in bytes (VmHWM).
  std::uint64_t peak_memory() const;

 private:
  pid_t pid_ = -1;
  std::optional<int> status_;
  std::filesystem::path output_;
};

/// Runs a command to its end and returns its exit status and output. A limit passed kills it:
/// status 137.
struct Finished {
  int status = 0;
  std::string output;
};
Finished run_to_end(const std::vector<std::string>& command, const std::filesystem::path& output,
                    std::chrono::milliseconds limit = kPatience);

/// Polls every few milliseconds until `holds()`; false when the limit passes first.
template <class Predicate>
bool eventually(Predicate holds, std::chrono::milliseconds limit = kPatience);
void wait_a_little();

template <class Predicate>
bool eventually(Predicate holds, std::chrono::milliseconds limit) {
  const auto end = std::chrono::steady_clock::now() + limit;
  while (!holds()) {
    if (std::chrono::steady_clock::now() > end) return false;
    wait_a_little();
  }
  return true;
}

}  // namespace dripline::test_support
