#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

#include "protocol/base/descriptor.hpp"
#include "protocol/base/result.hpp"

namespace dripline::machine::linuxcnc {

/// A program that LinuxCNC reads while it is written: a FIFO in a folder of its own. It is open for
/// reading here, too, so that neither side waits for the other at the opening, and a reader that
/// ends is no signal. Its name ends with the object, or before it.
class ProgramFifo {
 public:
  /// Errors: Io.
  static Result<ProgramFifo> create();
  ProgramFifo(ProgramFifo&& other) noexcept { *this = std::move(other); }
  ProgramFifo& operator=(ProgramFifo&& other) noexcept;
  ~ProgramFifo();

  const std::string& path() const { return path_; }
  /// Nothing of the text waits here or in the pipe. What LinuxCNC has read is not known.
  bool is_dry() const;
  /// Writes whole lines, as many as have room; the rest is kept.
  void write(std::string_view text);
  bool has_pending() const { return !pending_.empty(); }
  /// Once LinuxCNC has opened it: a gateway that is killed leaves no file.
  void remove_name();

 private:
  ProgramFifo() = default;
  explicit ProgramFifo(std::filesystem::path folder);

  std::filesystem::path folder_;
  std::string path_, pending_;
  Descriptor pipe_;
};

}  // namespace dripline::machine::linuxcnc
