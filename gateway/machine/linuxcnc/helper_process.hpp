#pragma once

#include <sys/types.h>
#include <string>
#include <utility>

#include "protocol/base/descriptor.hpp"
#include "protocol/base/result.hpp"

namespace dripline::machine::linuxcnc {

/// The helper as a process with its lines on a socket. It aborts what it has started when the
/// socket is closed, also by the kernel; a destructor closes it and waits for its end, a second at
/// most.
class HelperProcess {
 public:
  /// Errors: Io.
  static Result<HelperProcess> start(const std::string& ini);
  HelperProcess(HelperProcess&& other) noexcept
      : pid_(std::exchange(other.pid_, -1)), socket_(std::move(other.socket_)) {}
  HelperProcess& operator=(HelperProcess&& other) noexcept {
    std::swap(pid_, other.pid_);
    socket_ = std::move(other.socket_);
    return *this;
  }
  ~HelperProcess();

  int descriptor() const { return socket_.get(); }
  /// Appends what has come. False: the helper has ended.
  bool read(std::string& to);
  /// Writes as much as has room, erases it from `from`. False: the helper has ended.
  bool write(std::string& from);

 private:
  HelperProcess(pid_t pid, Descriptor socket) : pid_(pid), socket_(std::move(socket)) {}
  pid_t pid_ = -1;
  Descriptor socket_;
};

}  // namespace dripline::machine::linuxcnc
