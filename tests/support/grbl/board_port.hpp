#pragma once

#include <atomic>
#include <functional>
#include <mutex>
#include <thread>

#include "tests/support/grbl/board.hpp"
#include "tests/support/line/pty.hpp"

namespace dripline::test_support {

/// The board of deploy/examples/grbl: it must be homed.
GrblBoard::Options example_board();

/// A board at the end of a pseudo terminal, in real time times `speed`, on a thread of its own.
class GrblBoardPort {
 public:
  explicit GrblBoardPort(GrblBoard::Options options, double speed = 1);
  ~GrblBoardPort();
  GrblBoardPort(const GrblBoardPort&) = delete;
  GrblBoardPort& operator=(const GrblBoardPort&) = delete;

  const std::string& path() const { return pty_.path(); }
  /// `work` with the board at rest between two of its steps.
  template <class Work>
  auto with(Work work) {
    const std::lock_guard lock(mutex_);
    return work(board_);
  }
  void unplug();
  void plug_in();

 private:
  void start();
  void stop();
  void run();

  std::mutex mutex_;
  GrblBoard board_;
  const double speed_;
  Pty pty_;
  std::atomic<bool> stops_ = false;
  std::thread thread_;
};

}  // namespace dripline::test_support
