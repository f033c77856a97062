#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "protocol/wire/discipline.hpp"
#include "tests/support/line/test_line.hpp"

namespace dripline::test_support {

/// The control's end of a protocol on a test line, in real time: it is moved on by `until`, on the
/// caller's thread.
class PlayedControl {
 public:
  PlayedControl(const wire::LineSettings& settings, TestLine& line);

  /// Until it is so, at most some seconds.
  bool until(const std::function<bool()>& is_so);
  /// Sends a whole text, at most 64 KiB. Errors: those of begin_send.
  Result<void> send(const std::string& text, const std::string& name);
  wire::Discipline& line() { return *discipline_; }
  wire::LineTime now() const { return std::chrono::steady_clock::now() - began_; }

  std::string received;               ///< of all transfers
  std::vector<std::string> programs;  ///< transfers received to their end, in order
  std::size_t sends = 0;              ///< that ended
  std::vector<Error> failures;

 private:
  void step();
  void take(wire::Event& event);

  TestLine& cable_;
  std::unique_ptr<wire::Discipline> discipline_;
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
  std::string program_;
  std::optional<std::string> to_send_;
};

}  // namespace dripline::test_support
