#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "gateway/line/port_view.hpp"
#include "protocol/base/result.hpp"

namespace dripline::line {

/// One entry as a line of JSON, in the form in which the API sends recordings: {"port": "com3",
/// "time": "2026-11-21T07:40:06.123456Z", "what": "sent", "bytes": "0d0a", "text": ""}.
std::string to_recording_line(const PortTraffic& entry);
/// Errors: Syntax.
Result<PortTraffic> parse_recording_line(std::string_view line);

/// The recording of one port on disk: `PORT.jsonl` and, before it, `PORT.old.jsonl`, each of at
/// most kMaxFile bytes and a line. One thread.
class RecordingFile {
 public:
  static constexpr std::uintmax_t kMaxFile = 4 * 1024 * 1024;
  RecordingFile(const std::filesystem::path& folder, const std::string& port);

  /// What is there, oldest first; lines that were cut off by a kill are left out.
  std::vector<PortTraffic> read() const;
  /// Appends, and hands it to the system. Errors: Io.
  Result<void> write(const std::vector<PortTraffic>& entries);

 private:
  Result<void> open();
  std::filesystem::path current_;
  std::filesystem::path old_;
  std::ofstream out_;
  std::uintmax_t size_ = 0;
};

}  // namespace dripline::line
