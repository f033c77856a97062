#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tests/support/child_process.hpp"
#include "tests/support/temporary_folder.hpp"

namespace dripline::test_support {

/// A real LinuxCNC with the simulated mill of deploy/examples/linuxcnc, and a witness of its own: a
/// component that samples the motors' positions and the line in motion every millisecond. Output 1
/// is wired to input 2.
///
/// Only one can run in a system, so the test program must be in namespaces of its own
/// (linuxcnc_main.cpp).
class LinuxCnc {
 public:
  /// Empty: it can run here. Otherwise why the test is skipped.
  static std::string missing();

  LinuxCnc();
  ~LinuxCnc();
  LinuxCnc(const LinuxCnc&) = delete;
  LinuxCnc& operator=(const LinuxCnc&) = delete;

  /// The tool table, before the start.
  void set_tools(const std::string& table) const;
  /// Adds lines to a section of its INI file, before the start.
  void add_to_ini(const std::string& section, const std::string& lines) const;
  /// The numbers of the INI file stay, and count in inches.
  void count_in_inches() const;
  /// A function M100 to M199 that writes its arguments to `arguments_of`, before the start.
  void add_function(int code) const;
  /// Of its last call; empty: none.
  std::string arguments_of(int code) const;
  /// Waits until it is up; failures are those of gtest. Once more after its end.
  void start();
  void stop();
  /// Kills one of its processes: "milltask", "rtapi_app". Or sends it another signal: "-STOP".
  void kill(const std::string& process, const std::string& signal = "-9") const;
  std::string ini() const { return folder_.path() / "mill.ini"; }
  std::string log() const;

  struct Sample {
    long line = 0;  ///< in motion
    std::array<double, 3> at{};
  };
  /// Everything since the start or `reset`, without repetitions.
  std::vector<Sample> samples() const;
  void reset();
  /// Where the axes were when the line in motion changed, and where they are now.
  std::vector<std::array<double, 3>> ends() const;
  std::array<double, 3> position() const;
  /// They have not moved for `time` of LinuxCNC's own, which counts its periods of 1 ms; on a
  /// computer with much to do that takes longer. What was killed rests when nothing more comes.
  bool rests(std::chrono::milliseconds time = std::chrono::milliseconds(300)) const;

 private:
  std::uintmax_t line_bytes() const;

  TemporaryFolder folder_;
  std::uintmax_t begin_ = 0;  ///< in the witness's file
  std::optional<ChildProcess> process_;
};

}  // namespace dripline::test_support
