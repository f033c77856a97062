// The only translation unit that sees RESTinio and Asio: it takes half a minute to compile.
#include <restinio/all.hpp>
#include <restinio/tls.hpp>

#include <spdlog/spdlog.h>
#include <algorithm>
#include <thread>

#include "server/api/http_server.hpp"
#include "server/feeds/worker_pool.hpp"

namespace dripline::api {
namespace {

using namespace std::chrono_literals;

constexpr auto kReadLimit = 120s;   ///< for a whole request, also on a slow line
constexpr auto kWriteLimit = 60s;   ///< for one write to a client that does not read
constexpr auto kHandleLimit = 60s;  ///< longer than any handler waits

// One thread serves the sockets, but the last reference to a connection may be dropped on a
// handler's thread. The single-thread traits count connections without a mutex: never use them
// here.
struct PlainTraits : restinio::default_traits_t {
  using request_handler_t =
      std::function<restinio::request_handling_status_t(restinio::request_handle_t)>;
  static constexpr bool use_connection_count_limiter = true;
};
struct TlsTraits : restinio::default_tls_traits_t {
  using request_handler_t = PlainTraits::request_handler_t;
  static constexpr bool use_connection_count_limiter = true;
};

Result<Request> to_request(const restinio::request_t& from) {
  Request request;
  auto target = parse_target(from.header().request_target());
  if (!target) return fail(target.error());
  request.target = *std::move(target);
  request.method = from.header().method().c_str();
  from.header().for_each_field([&](const auto& field) {
    std::string name = field.name();
    std::ranges::transform(name, name.begin(), [](char c) {
      return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    request.headers[name] = field.value();
  });
  request.body = from.body();
  return request;
}

template <class Builder>
void append_headers(Builder& builder, const Response& response) {
  if (!response.content_type.empty()) {
    builder.append_header(restinio::http_field::content_type, response.content_type);
  }
  for (const auto& [name, value] : response.headers) builder.append_header(name, value);
}

restinio::http_status_line_t status_line(int status) {
  static const std::map<int, const char*> kReasons{{200, "OK"},
                                                   {201, "Created"},
                                                   {204, "No Content"},
                                                   {206, "Partial Content"},
                                                   {400, "Bad Request"},
                                                   {401, "Unauthorized"},
                                                   {404, "Not Found"},
                                                   {405, "Method Not Allowed"},
                                                   {409, "Conflict"},
                                                   {413, "Content Too Large"},
                                                   {416, "Range Not Satisfiable"},
                                                   {422, "Unprocessable Content"},
                                                   {500, "Internal Server Error"},
                                                   {504, "Gateway Timeout"}};
  const auto found = kReasons.find(status);
  const char* reason = found == kReasons.end() ? "Unknown" : found->second;
  return {restinio::http_status_code_t{static_cast<std::uint16_t>(status)}, reason};
}

void send_plain(const restinio::request_handle_t& to, Response response) {
  auto builder = to->create_response(status_line(response.status));
  append_headers(builder, response);
  builder.set_body(std::move(response.body));
  builder.done();
}

/// Pulls a body from its source, a piece at a time: the next one is made when the last one was
/// written. Kept alive by the callback it waits for.
template <class Output>
class BodyStream : public std::enable_shared_from_this<BodyStream<Output>> {
 public:
  using Builder = restinio::response_builder_t<Output>;
  BodyStream(Builder builder, BodySource source, feeds::WorkerPool& pool)
      : builder_(std::move(builder)), source_(std::move(source)), pool_(pool) {}

  void pull() {
    auto piece = source_();
    if (!piece) {
      // Without the end of the body the client notices that this is not all.
      spdlog::error("answer broken off: {}", piece.error().what);
      return;
    }
    if (!*piece) {
      builder_.done();
      return;
    }
    append(**std::move(piece));
    builder_.flush([self = this->shared_from_this()](const auto& ec) {
      if (!ec) self->pool_.post([self] { self->pull_on(); });
    });
  }

  /// The answer has begun: all that is left when a piece fails is to break it off.
  void pull_on() {
    try {
      pull();
    } catch (const std::exception& e) {
      spdlog::error("answer broken off: {}", e.what());
    }
  }

 private:
  void append(std::string text) {
    if constexpr (std::is_same_v<Output, restinio::chunked_output_t>) {
      if (!text.empty()) builder_.append_chunk(std::move(text));
    } else {
      builder_.append_body(std::move(text));
    }
  }

  Builder builder_;
  BodySource source_;
  feeds::WorkerPool& pool_;
};

void send_source(const restinio::request_handle_t& to, Response response, feeds::WorkerPool& pool) {
  if (response.source_length) {
    using Output = restinio::user_controlled_output_t;
    auto builder = to->create_response<Output>(status_line(response.status));
    append_headers(builder, response);
    builder.set_content_length(*response.source_length);
    std::make_shared<BodyStream<Output>>(std::move(builder), std::move(response.source), pool)
        ->pull();
    return;
  }
  using Output = restinio::chunked_output_t;
  auto builder = to->create_response<Output>(status_line(response.status));
  append_headers(builder, response);
  std::make_shared<BodyStream<Output>>(std::move(builder), std::move(response.source), pool)
      ->pull();
}

/// Writes a subscription's events, and a comment now and then so that both sides notice when the
/// other one is gone. Lives on the socket thread; its timer keeps it alive.
class EventStream : public std::enable_shared_from_this<EventStream> {
 public:
  using Builder = restinio::response_builder_t<restinio::chunked_output_t>;
  EventStream(asio::io_context& io, Builder builder, std::shared_ptr<EventSubscription> events,
              std::chrono::milliseconds heartbeat)
      : io_(io),
        timer_(io),
        builder_(std::move(builder)),
        events_(std::move(events)),
        heartbeat_(heartbeat) {}

  void begin() {
    events_->on_ready([this_weakly = weak_from_this(), &io = io_] {
      asio::post(io, [this_weakly] {
        if (const auto self = this_weakly.lock()) self->write_waiting();
      });
    });
    write(": events follow\n\n");
    beat();
  }

 private:
  void beat() {
    timer_.expires_after(heartbeat_);
    timer_.async_wait([self = shared_from_this()](const auto& ec) {
      if (ec || self->is_ended_) return;
      constexpr int kMaxSilence = 4;  // heartbeats during which not one write came to its end
      if (self->is_writing_ && ++self->silent_ >= kMaxSilence) return self->end();
      if (!self->is_writing_) self->write(": alive\n\n");
      self->beat();
    });
  }

  void write_waiting() {
    if (is_ended_ || is_writing_) return;
    if (events_->is_closed()) return end();
    std::string text = events_->take();
    if (!text.empty()) write(std::move(text));
  }

  void write(std::string text) {
    is_writing_ = true;
    builder_.append_chunk(std::move(text));
    builder_.flush([self = shared_from_this()](const auto& ec) {
      asio::post(self->io_, [self, failed = static_cast<bool>(ec)] {
        self->is_writing_ = false;
        self->silent_ = 0;
        if (failed) return self->end();
        self->write_waiting();
      });
    });
  }

  void end() {
    if (std::exchange(is_ended_, true)) return;
    events_->on_ready({});
    timer_.cancel();
    builder_.done();
  }

  asio::io_context& io_;
  asio::steady_timer timer_;
  Builder builder_;
  std::shared_ptr<EventSubscription> events_;
  const std::chrono::milliseconds heartbeat_;
  bool is_writing_ = false;
  bool is_ended_ = false;
  int silent_ = 0;
};

asio::ssl::context tls_context(const TlsFiles& files) {
  asio::ssl::context context(asio::ssl::context::tls_server);
  context.set_options(asio::ssl::context::default_workarounds | asio::ssl::context::no_tlsv1 |
                      asio::ssl::context::no_tlsv1_1);
  context.use_certificate_chain_file(files.certificate);
  context.use_private_key_file(files.key, asio::ssl::context::pem);
  return context;
}

template <class Traits>
class RestinioServer final : public HttpServer {
 public:
  RestinioServer(const HttpOptions& options, RequestHandler handler)
      : options_(options),
        handler_(std::move(handler)),
        pool_(options.handler_threads),
        server_(restinio::external_io_context(io_), settings()) {
    server_.open_sync();
    thread_ = std::thread([this] { serve(); });
  }

  ~RestinioServer() override {
    pool_.stop();
    asio::post(io_, [this] {
      server_.close_sync();
      io_.stop();
    });
    thread_.join();
  }

  std::uint16_t port() const override { return port_; }

 private:
  restinio::server_settings_t<Traits> settings() {
    restinio::server_settings_t<Traits> settings;
    settings.address(options_.address.host)
        .port(options_.address.port)
        .protocol(options_.address.is_ipv6 ? asio::ip::tcp::v6() : asio::ip::tcp::v4())
        .read_next_http_message_timelimit(kReadLimit)
        .write_http_response_timelimit(kWriteLimit)
        .handle_request_timeout(kHandleLimit)
        .max_parallel_connections(options_.max_connections)
        .incoming_http_msg_limits(restinio::incoming_http_msg_limits_t{}
                                      .max_url_size(kMaxTarget)
                                      .max_field_name_size(256)
                                      .max_field_value_size(8192)
                                      .max_field_count(100)
                                      .max_body_size(options_.max_body))
        .acceptor_post_bind_hook(
            [this](asio::ip::tcp::acceptor& acceptor) { port_ = acceptor.local_endpoint().port(); })
        .request_handler(
            [this](restinio::request_handle_t request) { return accept(std::move(request)); });
    if constexpr (std::is_same_v<Traits, TlsTraits>) {
      settings.tls_context(tls_context(*options_.tls));
    }
    return settings;
  }

  /// One connection's failure (want of memory, a mistake of ours) must not end all others.
  void serve() {
    for (;;) {
      try {
        io_.run();
        return;
      } catch (const std::exception& e) {
        spdlog::error("connection failed: {}", e.what());
      }
    }
  }

  restinio::request_handling_status_t accept(restinio::request_handle_t request) {
    pool_.post([this, request = std::move(request)] { answer(request); });
    return restinio::request_accepted();
  }

  void answer(const restinio::request_handle_t& request) {
    try {
      auto converted = to_request(*request);
      Response response =
          converted ? handler_(*std::move(converted)) : error_response(converted.error());
      if (response.events) {
        stream_events(request, std::move(response));
      } else if (response.source) {
        send_source(request, std::move(response), pool_);
      } else {
        send_plain(request, std::move(response));
      }
    } catch (const std::exception& e) {
      spdlog::error("answer not sent: {}", e.what());
    }
  }

  void stream_events(const restinio::request_handle_t& request, Response response) {
    auto builder =
        request->create_response<restinio::chunked_output_t>(status_line(response.status));
    append_headers(builder, response);
    builder.append_header(restinio::http_field::cache_control, "no-cache");
    builder.connection_close();
    asio::post(io_, [stream = std::make_shared<EventStream>(
                         io_, std::move(builder), std::move(response.events), options_.heartbeat)] {
      stream->begin();
    });
  }

  const HttpOptions options_;
  const RequestHandler handler_;
  asio::io_context io_{1};
  std::uint16_t port_ = 0;
  feeds::WorkerPool pool_;
  restinio::http_server_t<Traits> server_;
  std::thread thread_;
};

}  // namespace

Result<std::unique_ptr<HttpServer>> HttpServer::start(const HttpOptions& options,
                                                      RequestHandler handler) {
  if (auto safe = check_exposure(options.address, options.tls.has_value()); !safe) {
    return fail(safe.error());
  }
  try {
    std::unique_ptr<HttpServer> server;
    if (options.tls) {
      server = std::make_unique<RestinioServer<TlsTraits>>(options, std::move(handler));
    } else {
      server = std::make_unique<RestinioServer<PlainTraits>>(options, std::move(handler));
    }
    return server;
  } catch (const std::exception& e) {
    return fail(Errc::Io, "can not listen at {}: {}", options.address.text(), e.what());
  }
}

}  // namespace dripline::api
