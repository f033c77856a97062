#include "server/api/impl/http_session.hpp"

#include <netinet/tcp.h>
#include <sys/socket.h>
#include <algorithm>
#include <boost/asio/awaitable.hpp>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/post.hpp>

#include "protocol/process/log.hpp"
#include "server/api/impl/body_reader.hpp"
#include "server/api/impl/http_head.hpp"
#include "server/api/impl/request_reader.hpp"
#include "server/api/impl/transport.hpp"

namespace dripline::api {
namespace {

using namespace std::chrono_literals;
namespace asio = boost::asio;
namespace http = boost::beast::http;
using asio::awaitable;
using boost::system::error_code;
using Clock = std::chrono::steady_clock;
using State = ConnectionTable::State;

constexpr std::size_t kSmallBody = 16 * 1024;  ///< written together with its head
constexpr auto kFarewell = 2s;                 ///< for TLS to be shut down
constexpr auto kDiscardLimit = 5s;             ///< for a refused body to be read away
constexpr std::uint64_t kDiscardSize = 8ull * 1024 * 1024;
constexpr int kStreamBuffer = 64 * 1024;  ///< bytes that the kernel buffers for a listener
/// From the first event that waits to the writing of all: those of a round go out together.
constexpr auto kEventGather = 10ms;

class Session final : public HttpSession, public std::enable_shared_from_this<Session> {
 public:
  Session(HttpShared& shared, std::unique_ptr<Transport> transport, bool is_reserve)
      : shared_(shared),
        limits_(shared.options.limits),
        transport_(std::move(transport)),
        is_reserve_(is_reserve),
        reader_(*transport_),
        woken_(shared.io),
        bodies_({shared, *transport_, reader_, woken_, is_closed_}),
        address_(transport_->peer_address()) {}

  void drain() override {
    keeps_alive_ = false;
    if (!is_owed_) close();
  }
  void close() override {
    is_closed_ = true;
    transport_->close();
    woken_.set();
  }
  void abandon() override {
    is_abandoned_ = true;
    woken_.set();
  }

  awaitable<void> serve(Seat& seat) {
    if (!co_await transport_->open(limits_.handshake)) co_return;
    certificate_ = transport_->certificate();
    bool continues = true;
    for (bool is_first = true; continues && may_continue(); is_first = false) {
      seat.set(is_known_ ? State::Idle : State::Opening);
      continues = co_await serve_request(is_first, seat);
    }
    if (!is_closed_) co_await transport_->say_goodbye(kFarewell);
  }

 private:
  using Parser = RequestReader::Parser;

  bool may_continue() const { return !is_closed_ && !shared_.is_stopping; }
  bool may_stop(const Request& request) const {
    return shared_.handlers.may_stop && shared_.handlers.may_stop(request);
  }
  bool finds_run(const Request& request) const {
    return shared_.handlers.finds_run && shared_.handlers.finds_run(request);
  }
  static Response no_seat() {
    return refusal(503, Errc::Busy, "the server has all the connections it can take");
  }

  /// True: another request may follow.
  awaitable<bool> serve_request(bool is_first, Seat& seat) {
    Parser parser;
    const auto patience = is_first ? limits_.head : limits_.idle;
    const error_code unread = co_await reader_.read_head(parser, patience, limits_.head);
    if (unread) {
      const auto refused = refusal_of(unread);
      if (refused) co_await refuse(*refused);
      co_return false;
    }
    keeps_alive_ = parser.keep_alive() && !is_reserve_;
    is_old_ = parser.get().version() < 11;
    auto request = to_request(parser.get().base());
    if (!request) {
      const int status = request.error().code == Errc::LimitExceeded ? 431 : 400;
      const Response refused = refusal(status, request.error().code, request.error().what);
      co_await refuse(refused);
      co_return false;
    }
    request->address = address_;
    request->certificate = certificate_;
    is_head_only_ = request->method == "HEAD";
    std::optional<Response> judged;
    if (shared_.handlers.judge) judged = shared_.handlers.judge(*request);
    const bool may_be_stop = may_stop(*request);
    if (!judged && is_reserve_ && !may_be_stop && !finds_run(*request)) judged = no_seat();
    if (judged) {
      if (parser.is_done()) co_return co_await send(*judged);
      co_await refuse(*judged);
      co_return false;
    }
    is_known_ = is_known_ || request->caller || !parser.content_length();
    // A stranger's connection, and one in the reserve, makes room until its request is whole.
    const bool is_kept = request->caller && !is_reserve_;
    if (is_kept) seat.set(State::Busy);
    BodyMemory::Share share;
    if (!parser.is_done()) {
      const auto refused = co_await bodies_.read(parser, *request, share);
      if (refused && refused->status != 0) co_await refuse(*refused);
      if (refused) co_return false;
      request->body = std::move(parser.get().body());
    }
    if (!is_kept && !seat.begin_request(may_be_stop)) {
      const Response refused = no_seat();
      co_await refuse(refused);
      co_return false;
    }
    if (!may_continue()) co_return false;
    is_owed_ = true;
    const bool continues = co_await answer_request(*std::move(request), seat);
    is_owed_ = false;
    co_return continues;
  }

  /// True: another request may follow.
  awaitable<bool> answer_request(Request request, Seat& seat) {
    auto answer = co_await handle(std::move(request));
    if (!answer) co_return false;
    is_owed_ = !answer->source && !answer->events && !answer->timed;  // those end with the server
    if (!is_owed_ && shared_.is_stopping)
      answer = refusal(503, Errc::Busy, "the server is stopping");
    if (answer->events) {
      co_await stream_events(*std::move(answer), seat);
      co_return false;
    }
    if (answer->timed && !is_head_only_) {
      co_await stream_parts(*std::move(answer), seat);
      co_return false;
    }
    if (answer->source) co_return co_await send_source(*std::move(answer));
    co_return co_await send(*answer);
  }

  enum class Thread { OfPool, Own, OfStop };
  Thread thread_of(const Request& request) const {
    const auto& waits = shared_.handlers.waits_for_machine;
    if (!waits || !waits(request)) return Thread::OfPool;
    return may_stop(request) ? Thread::OfStop : Thread::Own;
  }

  /// Runs `work` on a worker or on a thread of its own; nullopt when an answer is no longer needed.
  template <class T>
  awaitable<std::optional<T>> on_worker(std::function<T()> work, Thread thread) {
    const auto result = std::make_shared<std::optional<T>>();
    std::function<void()> task = [self = shared_from_this(), work = std::move(work),
                                  result]() mutable {
      std::optional<T> made;
      try {
        made = work();
      } catch (const std::exception& e) {  // no memory, or a defect of ours
        process::log_error("request failed: {}", e.what());
      }
      work = nullptr;
      auto& io = self->shared_.io;
      asio::post(io, [self = std::move(self), result, made = std::move(made)]() mutable {
        *result = std::move(made);
        self->is_answered_ = true;
        self->woken_.set();
      });
    };
    is_answered_ = false;
    if (thread == Thread::OfPool) {
      shared_.pool.post(std::move(task));
    } else if (!shared_.commands.run(std::move(task), thread == Thread::OfStop)) {
      co_return std::nullopt;
    }
    while (!is_answered_ && !is_abandoned_) co_await woken_.wait();
    co_return std::move(*result);
  }

  awaitable<std::optional<Response>> handle(Request request) {
    const Thread thread = thread_of(request);
    const auto held = std::make_shared<Request>(std::move(request));
    std::function<Response()> work = [this, held] {
      return shared_.handlers.handle(std::move(*held));
    };
    auto answer = co_await on_worker<Response>(std::move(work), thread);
    if (!answer && !is_closed_) {
      answer = refusal(503, Errc::Busy, "the server could not take this request now");
    }
    co_return answer;
  }

  awaitable<bool> send(const Response& response) {
    if (response.ends_connection) keeps_alive_ = false;
    const Framing framing{.length = response.body.size(), .keeps_alive = keeps_alive_};
    std::string text = head_text(response, framing);
    const bool has_body = !is_head_only_ && response.status != 204;
    const bool is_small = response.body.size() <= kSmallBody;
    if (has_body && is_small) text += response.body;
    bool is_sent = co_await write(text);
    if (is_sent && has_body && !is_small) is_sent = co_await write(response.body);
    co_return is_sent&& keeps_alive_;
  }

  /// Answers a request without using its body, and discards some of the body: closing at once would
  /// let the client's kernel drop the answer.
  awaitable<void> refuse(const Response& response) {
    keeps_alive_ = false;
    co_await send(response);
    error_code ignored;
    transport_->socket().shutdown(asio::ip::tcp::socket::shutdown_send, ignored);
    const auto end = Clock::now() + kDiscardLimit;
    std::uint64_t discarded = 0;
    while (may_continue() && discarded < kDiscardSize && Clock::now() < end) {
      const auto patience = std::min<Clock::time_point>(end, Clock::now() + kFarewell);
      const std::size_t size = co_await reader_.discard(patience);
      if (size == 0) break;
      discarded += size;
    }
  }

  awaitable<bool> send_source(Response response) {
    Framing framing;
    framing.length = response.source_length;
    framing.is_chunked = !response.source_length && !is_old_;
    framing.keeps_alive = keeps_alive_ && (framing.length || framing.is_chunked);
    const std::string head = head_text(response, framing);
    bool is_sent = co_await write(head);
    if (is_head_only_) co_return is_sent&& framing.keeps_alive;
    using Piece = Result<std::optional<std::string>>;
    const auto source = std::make_shared<BodySource>(std::move(response.source));
    std::function<Piece()> pull = [source] { return (*source)(); };
    while (is_sent) {
      auto piece = co_await on_worker<Piece>(pull, Thread::OfPool);
      if (!piece) co_return false;
      if (!*piece) {
        // The client notices the missing end of the body.
        process::log_error("answer broken off: {}", piece->error().what);
        co_return false;
      }
      if (!**piece) break;
      const std::string text = framing.is_chunked ? chunk_text(***piece) : std::move(***piece);
      is_sent = co_await write(text);
    }
    if (is_sent && framing.is_chunked) is_sent = co_await write("0\r\n\r\n");
    co_return is_sent&& framing.keeps_alive;
  }

  awaitable<bool> write(std::string_view text) { return transport_->write(text, limits_.write); }

  /// A place for a stream; otherwise the request is answered.
  awaitable<bool> begin_stream(Seat& seat) {
    keeps_alive_ = false;
    if (!seat.begin_stream()) {
      const Response refused = refusal(
          503, Errc::Busy, "too many event streams are open; fewer fit than other connections");
      co_await send(refused);
      co_return false;
    }
    // A listener that is gone or hung must not keep megabytes in the kernel.
    error_code ignored;
    transport_->socket().set_option(asio::socket_base::send_buffer_size(kStreamBuffer), ignored);
    watch_for_end();
    co_return true;
  }

  /// Writes the parts of a timed source when they are due.
  awaitable<void> stream_parts(Response response, Seat& seat) {
    if (!co_await begin_stream(seat)) co_return;
    const auto source = std::move(response.timed);
    const Framing framing{.is_chunked = !is_old_, .keeps_alive = false};
    const std::string head = head_text(response, framing);
    bool continues = co_await write(head);
    using Part = std::optional<std::string>;
    std::function<Part()> take = [source] { return source->take(); };
    while (continues && may_continue() && !is_left_) {
      const TimedSource::Due due = source->due();
      if (!due.is_now) {
        co_await woken_.wait(due.next);
        continue;
      }
      const auto part = co_await on_worker<Part>(take, Thread::OfPool);
      if (!part || !*part) break;
      const std::string text = framing.is_chunked ? chunk_text(**part) : **part;
      if (!text.empty()) continues = co_await write(text);
    }
    if (framing.is_chunked && continues && may_continue() && !is_left_) co_await write("0\r\n\r\n");
  }

  /// Writes a subscription's events, and a comment now and then so that both sides notice when the
  /// other one is gone.
  awaitable<void> stream_events(Response response, Seat& seat) {
    if (!co_await begin_stream(seat)) co_return;
    const auto events = std::move(response.events);
    events->on_ready([weakly = weak_from_this(), &io = shared_.io] {
      asio::post(io, [weakly] {
        if (const auto self = weakly.lock()) self->woken_.set();
      });
    });
    const Framing framing{.is_chunked = !is_old_, .keeps_alive = false};
    response.headers.emplace_back("Cache-Control", "no-cache");
    const std::string head = head_text(response, framing);
    std::string text = ": events follow\n\n";
    bool continues = co_await write(head);
    while (continues && may_continue() && !is_left_) {
      // A token that was revoked reads nothing more.
      if (response.is_allowed && !response.is_allowed()) break;
      const std::string chunk = framing.is_chunked ? chunk_text(text) : text;
      continues = co_await write(chunk);
      const auto beat = Clock::now() + shared_.options.heartbeat;
      for (text.clear(); continues && text.empty() && may_continue() && !is_left_;) {
        continues = !events->is_closed();
        if (continues) text = events->take();
        if (!continues || !text.empty()) break;
        const bool is_woken = co_await woken_.wait(beat);
        if (!is_woken) text = ": alive\n\n";
        if (is_woken && !events->is_closed() && !is_left_)
          co_await woken_.wait(Clock::now() + kEventGather);
      }
    }
    events->on_ready({});
    if (framing.is_chunked && may_continue() && !is_left_) co_await write("0\r\n\r\n");
  }

  /// A listener sends nothing more, so any input means its end. Peeks at the socket: reading
  /// through the stream would share the deadline of the writes.
  void watch_for_end() {
    transport_->socket().async_wait(asio::ip::tcp::socket::wait_read,
                                    [self = shared_from_this()](const error_code& ec) {
                                      if (ec) return;
                                      self->is_left_ = true;
                                      self->woken_.set();
                                    });
  }

  HttpShared& shared_;
  const HttpLimits& limits_;
  std::unique_ptr<Transport> transport_;
  const bool is_reserve_;
  RequestReader reader_;
  Signal woken_;
  BodyReader bodies_;
  const std::string address_;                               ///< of the client
  std::optional<identity::ClientCertificate> certificate_;  ///< of the client, verified
  bool is_known_ = false;  ///< it has sent what is not for strangers
  bool is_owed_ = false;   ///< a request is carried out, and its answer is not written yet
  bool is_closed_ = false;
  bool is_abandoned_ = false;
  bool is_answered_ = false;
  bool is_left_ = false;
  bool keeps_alive_ = true;
  bool is_old_ = false;
  bool is_head_only_ = false;
};

awaitable<void> run(HttpShared& shared, std::shared_ptr<Session> session, Seat seat) {
  try {
    co_await session->serve(seat);
  } catch (const std::exception& e) {  // the failure of one connection must not end the others
    process::log_error("connection failed: {}", e.what());
  }
  session->close();
  shared.sessions.erase(seat.id());
  if (shared.sessions.empty()) shared.last_answers.cancel();
}

}  // namespace

void start_session(HttpShared& shared, asio::ip::tcp::socket socket, asio::ssl::context* tls,
                   const ConnectionTable::Admission& admission) {
  Seat seat(shared.table, admission.id);
  error_code ignored;
  socket.set_option(asio::ip::tcp::no_delay(true), ignored);
  // A peer whose kernel no longer answers is dropped.
  const auto patience = static_cast<unsigned>(shared.options.limits.write.count());
  ::setsockopt(socket.native_handle(), IPPROTO_TCP, TCP_USER_TIMEOUT, &patience, sizeof patience);
  auto session = std::make_shared<Session>(shared, make_transport(std::move(socket), tls),
                                           admission.is_reserve);
  shared.sessions[admission.id] = session;
  asio::co_spawn(shared.io, run(shared, std::move(session), std::move(seat)),
                 [](const std::exception_ptr&) {});
}

}  // namespace dripline::api
