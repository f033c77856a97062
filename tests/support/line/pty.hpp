#pragma once

#include <atomic>
#include <string>
#include <thread>

#include "tests/support/temporary_folder.hpp"

namespace dripline::test_support {

/// A pseudo-terminal in the place of a serial port: the code under test opens `path()`, the test is
/// at the other end, `master()`, which does not block. The path stays the same when it is unplugged
/// and plugged in again.
class Pty {
 public:
  Pty();
  ~Pty();
  Pty(const Pty&) = delete;
  Pty& operator=(const Pty&) = delete;

  const std::string& path() const { return path_; }
  const std::string& device() const { return device_; }  ///< what the path leads to now
  int master() const { return master_; }
  /// Another descriptor of the port itself, to look at its settings.
  int slave() const { return slave_; }

  /// The adapter is removed: a process with the port open sees a hang-up, and the path is gone.
  void unplug();
  void plug_in();

  void write(std::string_view text) const;
  /// What has arrived by now.
  std::string read_available() const;
  /// Reads until `size` characters have come or nothing more did for two seconds.
  std::string read(std::size_t size) const;

 private:
  TemporaryFolder folder_;
  std::string path_, device_;
  int master_ = -1, slave_ = -1;
};

/// Two ports joined by a null modem cable: what goes into one comes out of the other.
class PtyCable {
 public:
  PtyCable();
  ~PtyCable();
  const std::string& host() const { return host_.path(); }
  const std::string& control() const { return control_.path(); }
  /// The host's adapter is pulled out and plugged in again.
  void unplug();
  void plug_in();
  void unplug_control();
  /// Characters that have passed from host to control.
  std::uint64_t passed() const { return passed_; }

 private:
  void relay();
  void start();
  void stop();
  Pty host_, control_;
  std::atomic<bool> stops_ = false;
  std::atomic<std::uint64_t> passed_ = 0;
  std::thread thread_;
};

}  // namespace dripline::test_support
