#include "tests/support/grbl/board_port.hpp"

#include <poll.h>
#include <chrono>
#include <utility>

namespace dripline::test_support {

GrblBoard::Options example_board() {
  GrblBoard::Options options;
  options.max_rate = 3000;
  options.is_locked = true;
  options.homing_seconds = 3;
  options.is_zero_at_low_end = true;
  options.settings = {{20, "1"}, {23, "7"}, {131, "200.000"}, {132, "80.000"}};
  return options;
}

GrblBoardPort::GrblBoardPort(GrblBoard::Options options, double speed)
    : board_(std::move(options)), speed_(speed) {
  start();
}

GrblBoardPort::~GrblBoardPort() {
  stop();
}

void GrblBoardPort::start() {
  stops_ = false;
  thread_ = std::thread(&GrblBoardPort::run, this);
}

void GrblBoardPort::stop() {
  stops_ = true;
  if (thread_.joinable()) thread_.join();
}

void GrblBoardPort::unplug() {
  stop();
  pty_.unplug();
}

void GrblBoardPort::plug_in() {
  pty_.plug_in();
  start();
}

void GrblBoardPort::run() {
  auto last = std::chrono::steady_clock::now();
  while (!stops_) {
    pollfd entry{pty_.master(), POLLIN, 0};
    (void)::poll(&entry, 1, 1);
    const std::string in = pty_.read_available();
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - last).count();
    last = now;
    std::string out;
    {
      const std::lock_guard lock(mutex_);
      board_.receive(in);
      board_.pass(seconds * speed_);
      out = board_.take_output();
    }
    if (!out.empty()) pty_.write(out);
  }
}

}  // namespace dripline::test_support
