#include "clients/lib/event_stream.hpp"

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>
#include <utility>

#include "clients/lib/api_json.hpp"
#include "clients/lib/impl/request.hpp"
#include "clients/lib/shared_http.hpp"

namespace dripline::client {

namespace {

using namespace std::chrono_literals;
constexpr std::size_t kMaxWaiting = 1024;
constexpr auto kFirstDelay = 100ms;
constexpr auto kLongestDelay = 2000ms;

template <class T>
std::optional<StreamItem> item_of(const nlohmann::json& json) {
  auto value = from_json<T>(json);
  if (!value) return std::nullopt;
  return StreamItem(std::move(*value));
}

std::optional<StreamItem> lost_of(const nlohmann::json& json) {
  if (!json.is_object() || !json.contains("lost") || !json["lost"].is_number_unsigned()) return {};
  return TrafficLost{json["lost"].get<std::uint64_t>()};
}

std::string events_path(const std::string& machine) {
  return impl::with_query(impl::path_of("events"), "machine", machine);
}

/// nullopt for an event whose kind or form this version does not know.
std::optional<StreamItem> decode(const ServerEvent& event) {
  auto json = parse_json(event.data);
  if (!json) return std::nullopt;
  if (event.name == "machine") return item_of<Machine>(*json);
  if (event.name == "run") return item_of<Run>(*json);
  if (event.name == "record") return item_of<Record>(*json);
  if (event.name == "port") return item_of<Port>(*json);
  if (event.name == "traffic") return item_of<Traffic>(*json);
  if (event.name == "lost") return lost_of(*json);
  return std::nullopt;
}

/// A server's refusal of the stream, as a failure.
Failure refused(const HttpResponse& response, const std::string& url) {
  const bool is_denied = response.status == 401 || response.status == 403;
  if (is_denied) {
    return {Failure::Kind::Denied, Errc::Denied,
            fmt::format("server {} does not accept the token", url)};
  }
  return {Failure::Kind::Unreachable, Errc::Io,
          fmt::format("server {} gives no events (status {})", url, response.status)};
}

}  // namespace

class EventStream::Impl {
 public:
  Impl(const std::vector<ServerAddress>& servers, std::string path)
      : first_(servers.front()),
        path_(std::move(path)),
        http_(open_http(servers, {5000ms, 60000ms})) {
    thread_ = std::thread([this] { run(); });
  }

  ~Impl() {
    {
      const std::lock_guard lock(mutex_);
      is_stopped_ = true;
    }
    changed_.notify_all();
    // A stop has no effect on a request that is about to begin: repeat until it has ended.
    while (!wait_until_over(50ms)) http_->stop();
    thread_.join();
  }

  std::optional<StreamItem> next(std::chrono::milliseconds timeout) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, timeout, [this] { return !waiting_.empty(); });
    if (waiting_.empty()) return std::nullopt;
    StreamItem item = std::move(waiting_.front());
    waiting_.pop_front();
    changed_.notify_all();
    return item;
  }

 private:
  void run() {
    auto delay = kFirstDelay;
    while (!is_stopped()) {
      had_data_ = false;
      const auto ended = read_once();
      if (had_data_) delay = kFirstDelay;
      const bool is_denied = ended.kind == Failure::Kind::Denied;
      push(StreamLost{ended});
      if (is_denied || !pause(delay)) break;
      delay = std::min<std::chrono::milliseconds>(delay * 2, kLongestDelay);
    }
    const std::lock_guard lock(mutex_);
    is_over_ = true;
    changed_.notify_all();
  }

  Failure read_once() {
    EventParser parser;
    HttpRequest request;
    request.path = path_;
    request.headers.emplace_back("Accept", "text/event-stream");
    request.on_head = [this] { return push(StreamOpened{}); };
    request.on_body = [&](std::string_view bytes) { return take(parser, bytes); };
    auto response = http_->send(request);
    if (!response) return response.error();
    if (response->status < 200 || response->status >= 300) return refused(*response, url());
    return {Failure::Kind::Unreachable, Errc::Io,
            fmt::format("server {} ended the stream of events", url())};
  }

  bool take(EventParser& parser, std::string_view bytes) {
    had_data_ = true;
    auto events = parser.feed(bytes);
    if (!events) return false;
    for (const auto& event : *events) {
      auto item = decode(event);
      if (item && !push(std::move(*item))) return false;
    }
    return !is_stopped();
  }

  bool push(StreamItem item) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return is_stopped_ || waiting_.size() < kMaxWaiting; });
    if (is_stopped_) return false;
    waiting_.push_back(std::move(item));
    changed_.notify_all();
    return true;
  }

  bool pause(std::chrono::milliseconds delay) {
    std::unique_lock lock(mutex_);
    return !changed_.wait_for(lock, delay, [this] { return is_stopped_; });
  }
  bool wait_until_over(std::chrono::milliseconds delay) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, delay, [this] { return is_over_; });
  }
  bool is_stopped() {
    const std::lock_guard lock(mutex_);
    return is_stopped_;
  }

  const std::string& url() const {
    const ServerAddress* const answering = http_->answering();
    return answering != nullptr ? answering->url : first_.url;
  }

  ServerAddress first_;
  std::string path_;
  std::unique_ptr<Http> http_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<StreamItem> waiting_;
  bool is_stopped_ = false, is_over_ = false;
  bool had_data_ = false;  ///< used by the thread only
  std::thread thread_;
};

EventStream::EventStream(const ServerAddress& address, const std::string& machine)
    : EventStream(std::vector<ServerAddress>{address}, machine) {}
EventStream::EventStream(const std::vector<ServerAddress>& servers, const std::string& machine)
    : impl_(std::make_unique<Impl>(servers, events_path(machine))) {}
EventStream::EventStream(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
EventStream::~EventStream() = default;

EventStream EventStream::of_port(const std::vector<ServerAddress>& servers,
                                 const std::string& port) {
  return EventStream(std::make_unique<Impl>(servers, impl::path_of("ports", port) + "/traffic"));
}

std::optional<StreamItem> EventStream::next(std::chrono::milliseconds timeout) {
  return impl_->next(timeout);
}

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
