#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <thread>

#include "tests/support/line/pty.hpp"

namespace dripline::test_support {

/// A serial device server in raw mode: one TCP connection, and what goes through it comes out of a
/// port that a control is connected to. It can be switched off and on again.
class DeviceServer {
 public:
  DeviceServer();
  ~DeviceServer();
  std::string address() const { return "tcp://127.0.0.1:" + std::to_string(port_); }
  const std::string& control() const { return pty_.path(); }
  void switch_off();
  void switch_on();

 private:
  void serve();
  Pty pty_;
  std::uint16_t port_ = 0;
  int listener_ = -1;
  std::atomic<bool> stops_ = false;
  std::thread thread_;
};

}  // namespace dripline::test_support
