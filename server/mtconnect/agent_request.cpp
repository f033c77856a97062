#include "server/mtconnect/agent_request.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <charconv>

namespace dripline::mtconnect {
namespace {

using Kind = AgentRequest::Kind;
constexpr std::int64_t kLongestMs = 3'600'000;

struct KindRow {
  std::string_view word;
  Kind kind;
};
constexpr std::array kKinds{KindRow{"probe", Kind::Probe}, KindRow{"current", Kind::Current},
                            KindRow{"sample", Kind::Sample}, KindRow{"assets", Kind::Assets},
                            KindRow{"asset", Kind::Assets}};

const KindRow* kind_of(std::string_view word) {
  const auto found = std::ranges::find(kKinds, word, &KindRow::word);
  return found == kKinds.end() ? nullptr : &*found;
}

tl::unexpected<AgentError> refuse(AgentError error) {
  return tl::unexpected<AgentError>(std::move(error));
}

/// Ids that are separated by `;` or `,`.
Asked<std::vector<std::string>> read_ids(std::string_view text) {
  std::vector<std::string> ids;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find_first_of(";,"), text.size());
    if (end > 0) ids.emplace_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (ids.size() > AgentRequest::kMaxAssetIds) {
      return refuse(
          {400, "TOO_MANY",
           fmt::format("at most {} asset ids in one request", AgentRequest::kMaxAssetIds)});
    }
  }
  if (ids.empty()) return refuse({400, "INVALID_REQUEST", "an asset id is missing"});
  return ids;
}

Asked<AgentRequest> read_path(const api::Target& target) {
  std::vector<std::string> segments = target.segments;
  std::erase(segments, "");
  AgentRequest request;
  if (!segments.empty() && kind_of(segments.front()) == nullptr) {
    request.device = segments.front();
    segments.erase(segments.begin());
  }
  if (segments.empty()) return request;
  const KindRow* row = kind_of(segments.front());
  const std::size_t most = row != nullptr && row->kind == Kind::Assets ? 2 : 1;
  if (row == nullptr || segments.size() > most) {
    return refuse({404, "INVALID_URI",
                   "the path must be /probe, /current, /sample or /assets, or the name of a device "
                   "and one of these"});
  }
  request.kind = row->kind;
  if (segments.size() == 2) {
    auto ids = read_ids(segments.back());
    if (!ids) return refuse(ids.error());
    request.asset_ids = *std::move(ids);
  }
  return request;
}

/// Reads the parameters; the first error stays.
class Parameters {
 public:
  explicit Parameters(const api::Target& target) : query_(target.query) {}

  std::string text(const char* name) const {
    const auto found = query_.find(name);
    return found == query_.end() ? std::string() : found->second;
  }
  std::optional<std::int64_t> number(const char* name) {
    const auto found = query_.find(name);
    if (found == query_.end()) return std::nullopt;
    const std::string& text = found->second;
    std::int64_t value = 0;
    const auto [end, ec] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (ec == std::errc() && end == text.data() + text.size()) return value;
    set({400, "INVALID_REQUEST", fmt::format("'{}' must be a whole number", name)});
    return std::nullopt;
  }
  std::optional<std::int64_t> number(const char* name, std::int64_t least, std::int64_t most) {
    const auto value = number(name);
    if (value && (*value < least || *value > most))
      set(out_of_range(fmt::format("'{}' must be from {} to {}", name, least, most)));
    return value;
  }
  std::optional<std::uint64_t> sequence(const char* name) {
    const auto value = number(name, 0, INT64_MAX);
    return value && *value >= 0 ? std::optional(static_cast<std::uint64_t>(*value)) : std::nullopt;
  }
  void set(AgentError error) {
    if (!error_) error_ = std::move(error);
  }
  const std::optional<AgentError>& error() const { return error_; }

 private:
  const std::map<std::string, std::string>& query_;
  std::optional<AgentError> error_;
};

void read_count(Parameters& parameters, AgentRequest& request, std::uint64_t buffer_size) {
  const auto most = static_cast<std::int64_t>(buffer_size);
  const bool may_be_negative = request.kind == Kind::Sample && !request.interval;
  const auto count = parameters.number("count", may_be_negative ? -most : 1, most);
  if (!count) return;
  if (*count == 0) parameters.set(out_of_range("'count' must not be 0"));
  request.count = *count;
}

void read_current(Parameters& parameters, AgentRequest& request) {
  request.at = parameters.sequence("at");
  if (request.at && request.interval)
    parameters.set({400, "INVALID_REQUEST", "'at' and 'interval' exclude each other"});
}

void read_assets(Parameters& parameters, AgentRequest& request) {
  request.asset_type = parameters.text("type");
  const std::string removed = parameters.text("removed");
  if (!removed.empty() && removed != "true" && removed != "false")
    parameters.set({400, "INVALID_REQUEST", "'removed' must be true or false"});
  request.with_removed = removed == "true";
  if (request.device.empty()) request.device = parameters.text("device");
}

}  // namespace

AgentError out_of_range(std::string text) {
  return {404, "OUT_OF_RANGE", std::move(text)};
}

Asked<AgentRequest> read_request(const api::Target& target, std::uint64_t buffer_size) {
  auto request = read_path(target);
  if (!request) return request;
  Parameters parameters(target);
  const bool is_streams = request->kind == Kind::Current || request->kind == Kind::Sample;
  if (is_streams) {
    request->path = parameters.text("path");
    if (request->path.size() > AgentRequest::kMaxPath) {
      parameters.set({400, "INVALID_PATH",
                      fmt::format("'path' has {} characters: at most {}", request->path.size(),
                                  AgentRequest::kMaxPath)});
    }
    if (const auto interval = parameters.number("interval", 0, kLongestMs))
      request->interval = std::chrono::milliseconds(*interval);
    if (const auto heartbeat = parameters.number("heartbeat", 1, kLongestMs))
      request->heartbeat = std::chrono::milliseconds(*heartbeat);
  }
  if (request->kind == Kind::Current) read_current(parameters, *request);
  if (request->kind == Kind::Assets) {
    read_assets(parameters, *request);
    read_count(parameters, *request, INT64_MAX);
  }
  if (request->kind == Kind::Sample) {
    request->from = parameters.sequence("from");
    read_count(parameters, *request, buffer_size);
  }
  if (parameters.error()) return refuse(*parameters.error());
  return request;
}

}  // namespace dripline::mtconnect
