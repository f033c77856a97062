#pragma once

#include <functional>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "protocol/base/clock.hpp"
#include "protocol/base/result.hpp"
#include "server/api/events/event_hub.hpp"

namespace dripline::api {

/// Returns a long body piece by piece; nullopt after the last one. Called on one worker at a time.
using BodySource = std::function<Result<std::optional<std::string>>()>;

/// A body without an end that is made part by part, at times that it names.
class TimedSource {
 public:
  virtual ~TimedSource() = default;
  /// On the socket thread; must not wait.
  struct Due {
    bool is_now = false;
    SteadyTime next;  ///< when to ask again
  };
  virtual Due due() = 0;
  /// On a worker, one call at a time. An empty text: nothing after all. nullopt: it has ended.
  virtual std::optional<std::string> take() = 0;
};

/// The answer of a handler. The body is `body`, or comes from `source` or `timed`, or is the stream
/// `events`.
struct Response {
  int status = 200;
  std::string content_type;
  std::vector<std::pair<std::string, std::string>> headers;
  std::string body;
  bool ends_connection = false;  ///< the client's next request takes a new one
  BodySource source;
  std::optional<std::uint64_t> source_length;  ///< if known
  std::shared_ptr<EventSubscription> events;
  std::shared_ptr<TimedSource> timed;
  std::function<bool()> is_allowed;  ///< asked while `events` are sent; false ends them
};

Response json_response(int status, const nlohmann::json& value);
/// A JSON text that is made already.
Response json_text_response(std::string text);
Response no_content();
/// `{"error":{"code","message"}}` with the status that belongs to the code.
Response error_response(const Error& error);
Response error_response(int status, const Error& error);
int http_status(Errc code);
std::string to_text(const nlohmann::json& value);

}  // namespace dripline::api
