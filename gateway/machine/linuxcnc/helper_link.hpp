#pragma once

#include <atomic>
#include <string>
#include <thread>

#include "protocol/base/descriptor.hpp"
#include "protocol/base/result.hpp"

namespace dripline::machine::linuxcnc {

class LinuxCncMachine;

/// The thread that carries bytes between a machine and LinuxCNC: starts the helper process and
/// reads and writes its lines, keeps a FIFO for each program, and starts the helper again a second
/// after it has ended. Woken by the owner, so that a hold leaves at once.
class HelperLink {
 public:
  /// `machine` outlives it.
  HelperLink(LinuxCncMachine& machine, std::string ini);
  ~HelperLink();
  HelperLink(const HelperLink&) = delete;
  HelperLink& operator=(const HelperLink&) = delete;

  void wake();

 private:
  void run();

  LinuxCncMachine& machine_;
  const std::string ini_;
  Descriptor wake_;
  std::atomic<bool> stops_ = false;
  std::thread thread_;
};

/// The INI file of the running LinuxCNC. Errors: Syntax (empty), NotFound (no such file).
Result<void> check_ini_path(const std::string& path);

}  // namespace dripline::machine::linuxcnc
