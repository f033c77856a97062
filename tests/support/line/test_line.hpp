#pragma once

#include <chrono>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>

#include "protocol/serial/line_driver.hpp"

namespace dripline::test_support {

/// A cable without a UART: LineDrivers open one end, the test plays the control at the other. It
/// can be pulled and put back. Any thread.
class TestLine {
 public:
  TestLine();
  ~TestLine();

  /// For serial::LineDriver::Parts::open.
  Result<std::unique_ptr<serial::Channel>> open();
  /// Everything that has come in, once it contains `text` or after a minute.
  std::string read_until(std::string_view text);
  /// What comes within that time, however little it is.
  std::string read_for(std::chrono::milliseconds time);
  void write(std::string_view text);
  /// The UART says this of the next character.
  void fault(wire::LineFault fault);
  void pull();
  void put_back();
  bool wait_open();

 private:
  struct Cable;
  std::shared_ptr<Cable> cable_;
};

}  // namespace dripline::test_support
