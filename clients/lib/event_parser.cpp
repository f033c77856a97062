#include "clients/lib/event_parser.hpp"

#include <utility>

namespace dripline::client {

Result<std::vector<ServerEvent>> EventParser::feed(std::string_view bytes) {
  std::vector<ServerEvent> events;
  while (!bytes.empty()) {
    if (std::exchange(skip_line_feed_, false) && bytes.front() == '\n') {
      bytes.remove_prefix(1);
      continue;
    }
    const auto end = bytes.find_first_of("\r\n");
    const std::size_t size = end == std::string_view::npos ? bytes.size() : end;
    if (line_.size() + size + (data_ ? data_->size() : 0) > kMaxEvent) {
      return fail(Errc::LimitExceeded, "an event is longer than {} bytes", kMaxEvent);
    }
    line_.append(bytes.substr(0, size));
    if (end == std::string_view::npos) break;
    take_line(line_, events);
    line_.clear();
    skip_line_feed_ = bytes[end] == '\r';
    bytes.remove_prefix(end + 1);
  }
  return events;
}

void EventParser::take_line(std::string_view line, std::vector<ServerEvent>& events) {
  if (line.empty()) {
    if (data_) events.push_back({name_.empty() ? "message" : name_, std::move(*data_)});
    name_.clear();
    data_.reset();
    return;
  }
  const auto colon = line.find(':');
  const std::string_view field = line.substr(0, colon);
  std::string_view value = colon == std::string_view::npos ? "" : line.substr(colon + 1);
  if (value.starts_with(' ')) value.remove_prefix(1);
  if (field == "event") name_ = value;
  if (field != "data") return;
  if (data_) {
    *data_ += '\n';
    *data_ += value;
  } else {
    data_ = value;
  }
}

}  // namespace dripline::client
