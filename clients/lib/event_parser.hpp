#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/base/result.hpp"

namespace dripline::client {

struct ServerEvent {
  std::string name;  ///< `event:`; "message" when the server named none
  std::string data;  ///< `data:` lines joined by line ends
};

/// Reads a text/event-stream (WHATWG HTML, section 9.2) in pieces of any size. Comments,
/// ids and retry times are skipped. Pure; bounded: an event of more than 1 MiB is an error.
class EventParser {
 public:
  static constexpr std::size_t kMaxEvent = 1024 * 1024;

  /// The events that `bytes` completes. Errors: LimitExceeded; the parser must not be used after
  /// that.
  Result<std::vector<ServerEvent>> feed(std::string_view bytes);

 private:
  void take_line(std::string_view line, std::vector<ServerEvent>& events);
  std::string line_;
  bool skip_line_feed_ = false;  ///< the line ended with CR; an LF that follows belongs to it
  std::string name_;
  std::optional<std::string> data_;
};

}  // namespace dripline::client
