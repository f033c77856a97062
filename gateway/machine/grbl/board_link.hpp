#pragma once

#include <atomic>
#include <string>
#include <thread>

#include "protocol/base/result.hpp"
#include "protocol/wire/line_settings.hpp"

namespace dripline::machine::grbl {

class GrblMachine;

/// The thread that carries bytes between a machine and its board: opens the line, reads, writes,
/// and opens it again a second after it was lost, unless the machine has a fault. Woken by the
/// owner, so that a hold leaves at once.
class BoardLink {
 public:
  /// `machine` outlives it.
  BoardLink(GrblMachine& machine, std::string address);
  ~BoardLink();
  BoardLink(const BoardLink&) = delete;
  BoardLink& operator=(const BoardLink&) = delete;

  void wake();

 private:
  void run();
  GrblMachine& machine_;
  const std::string address_;
  int wake_ = -1;  ///< an eventfd
  std::atomic<bool> stops_ = false;
  std::thread thread_;
};

/// "/dev/ttyACM0", "tcp://host:port", "rfc2217://host:port", each followed by ",BAUD" or a short
/// form as ",57600n81" where it is not 115200n81. Errors: Syntax, LimitExceeded.
struct BoardAddress {
  std::string channel;
  wire::LineSettings settings;
};
Result<BoardAddress> parse_board_address(std::string_view text);

}  // namespace dripline::machine::grbl
