#include <fcntl.h>
#include <httplib.h>
#include <sys/socket.h>
#include <algorithm>
#include <atomic>
#include <charconv>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <utility>

#include "protocol/base/descriptor.hpp"
#include "protocol/pki/expected_host.hpp"
#include "server/webhooks/connection_bytes.hpp"
#include "server/webhooks/delivery.hpp"

namespace dripline::webhooks {
namespace {

/// The socket of an exchange, for the thread that watches it. The number is one of its own: the
/// library may close its own at any moment, and that number may be given to another file.
class WatchedSocket {
 public:
  void set(int made) {
    Descriptor copy(::fcntl(made, F_DUPFD_CLOEXEC, 0));
    if (!copy) ::shutdown(made, SHUT_RDWR);  // what cannot be watched is not begun
    const std::lock_guard lock(mutex_);
    socket_ = std::move(copy);
  }
  std::uint64_t received() const {
    const std::lock_guard lock(mutex_);
    return bytes_received(socket_.get());
  }
  /// Ends whatever waits for it. The library's own stop waits until a handshake of TLS is over.
  void cut_off() const {
    const std::lock_guard lock(mutex_);
    if (socket_) ::shutdown(socket_.get(), SHUT_RDWR);
  }

 private:
  mutable std::mutex mutex_;
  Descriptor socket_;
};

/// While it lives, an exchange that takes too long, has a head without an end, or is not wanted
/// any more, is cut off. The library's own timeouts begin again with each byte of an answer, and
/// its lines have no limit.
class Deadline {
 public:
  Deadline(const WatchedSocket& socket, SteadyTime end, std::uint64_t max_bytes,
           const std::stop_token& stop)
      : watch_([this, &socket, end, max_bytes, stop](const std::stop_token& over) {
          constexpr std::chrono::milliseconds kLook{20};
          std::mutex mutex;
          std::condition_variable_any never;
          std::unique_lock lock(mutex);
          while (!over.stop_requested()) {
            if (socket.received() > max_bytes) is_too_long_ = true;
            const bool is_late = std::chrono::steady_clock::now() >= end;
            // Again at every look: before the connection is there, nothing can be cut off.
            if (stop.stop_requested() || is_late || is_too_long_) socket.cut_off();
            never.wait_for(lock, over, kLook, [] { return false; });
          }
        }) {}

  bool is_too_long() const { return is_too_long_; }

 private:
  std::atomic<bool> is_too_long_ = false;
  std::jthread watch_;
};

/// Of a URL that check_url has found good.
struct Place {
  std::string origin, host, path;
  int port = 0;
  bool is_secure = false;
};

Place place_of(const std::string& url) {
  constexpr int kHttp = 80, kHttps = 443;
  Place place;
  place.is_secure = url.starts_with("https:");
  const auto host_at = url.find("://") + 3;
  const auto path_at = url.find_first_of("/?", host_at);
  place.origin = url.substr(0, path_at);
  place.path = path_at == std::string::npos ? "/" : url.substr(path_at);
  if (place.path.front() == '?') place.path.insert(0, "/");
  place.host = place.origin.substr(host_at);
  const auto port_at = place.host.find(':', place.host.find(']') + 1);
  place.port = place.is_secure ? kHttps : kHttp;
  if (port_at != std::string::npos)
    std::from_chars(place.host.data() + port_at + 1, place.host.data() + place.host.size(),
                    place.port);
  place.host.resize(std::min(port_at, place.host.size()));
  if (place.host.starts_with('[')) place.host = place.host.substr(1, place.host.size() - 2);
  return place;
}

class HttplibSender final : public Sender {
 public:
  HttplibSender(std::chrono::milliseconds timeout, NameLookup lookup)
      : timeout_(timeout), lookup_(std::move(lookup)) {}

  Result<void> send(const Delivery& delivery, const std::stop_token& stop) override {
    const Place place = place_of(delivery.url);
    const SteadyTime end = std::chrono::steady_clock::now() + 3 * timeout_;
    const auto addresses = addresses_of(place.host, lookup_, end, stop);
    if (!addresses) return fail(Errc::Timeout, "{}: {}", place.origin, addresses.error().what);
    WatchedSocket socket;
    const Deadline deadline(socket, end, kMaxExchange, stop);
    for (const std::string& address : *addresses) {
      Exchange exchange;
      const auto answer = attempt({delivery, place, address, socket}, exchange);
      if (deadline.is_too_long() && exchange.status == 0)
        return fail(Errc::LimitExceeded, "{}: the head of its answer has more than {} bytes",
                    place.origin, kMaxExchange);
      if (!answer && exchange.received <= kMaxAnswer) {
        if (stop.stop_requested() || std::chrono::steady_clock::now() >= end)
          return fail(Errc::Timeout, "{}: no answer in time", place.origin);
        if (is_unreached(answer.error()) && &address != &addresses->back()) continue;
        return fail(refusal(answer.error(), place.origin, exchange));
      }
      if (answer) exchange.status = answer->status;
      if (exchange.status >= 200 && exchange.status < 300) return {};
      return fail(Errc::Conflict, "{} answered with status {}", place.origin, exchange.status);
    }
    return fail(Errc::Timeout, "{}: no address", place.origin);
  }

 private:
  static constexpr std::size_t kMaxAnswer = 64 * 1024;
  /// All bytes of the connection, those of TLS and of the answer's head with them: far more than
  /// any receiver has to say.
  static constexpr std::uint64_t kMaxExchange = 1024 * 1024;

  struct Exchange {
    std::size_t received = 0;    ///< of the answer's text
    int status = 0;              ///< it counts where the text was too long to be read to its end
    bool is_other_host = false;  ///< whose certificate it has shown
  };
  struct Attempt {
    const Delivery& delivery;
    const Place& place;
    const std::string& address;
    WatchedSocket& socket;
  };

  static bool is_unreached(httplib::Error error) {
    return error == httplib::Error::Connection || error == httplib::Error::ConnectionTimeout;
  }

  httplib::Result attempt(const Attempt& what, Exchange& exchange) const {
    if (!what.place.is_secure) {
      httplib::ClientImpl client(what.place.host, what.place.port);
      return attempt_by(client, what, exchange);
    }
    httplib::SSLClient client(what.place.host, what.place.port);
    // The library's own look takes a common name, too, and a bare `*`.
    SSL_CTX* const context = client.ssl_context();
    if (!context || !pki::expect_host(SSL_CTX_get0_param(context), what.place.host))
      return {nullptr, httplib::Error::SSLConnection};
    auto answer = attempt_by(client, what, exchange);
    exchange.is_other_host = pki::is_other_host(client.get_openssl_verify_result());
    return answer;
  }

  httplib::Result attempt_by(httplib::ClientImpl& client, const Attempt& what,
                             Exchange& exchange) const {
    client.set_hostname_addr_map({{what.place.host, what.address}});
    client.set_follow_location(false);
    client.set_url_encode(false);
    client.set_connection_timeout(timeout_);
    client.set_read_timeout(timeout_);
    client.set_write_timeout(timeout_);
    client.set_socket_options([&what](int made) { what.socket.set(made); });
    httplib::Request request = request_of(what.delivery, what.place.path);
    // The answer's text is of no use here, and may be long.
    request.content_receiver = [&exchange](const char*, std::size_t size, std::uint64_t,
                                           std::uint64_t) {
      exchange.received += size;
      return exchange.received <= kMaxAnswer;
    };
    request.response_handler = [&exchange](const httplib::Response& head) {
      exchange.status = head.status;
      return true;
    };
    return client.send(request);
  }

  static httplib::Request request_of(const Delivery& delivery, const std::string& path) {
    httplib::Request request;
    request.method = "POST";
    request.path = path;
    request.headers = {{"Dripline-Event", delivery.kind},
                       {"Dripline-Delivery", delivery.id},
                       {"Dripline-Timestamp", delivery.timestamp},
                       {"Dripline-Signature", delivery.signature},
                       {"User-Agent", "dripline-webhook"}};
    request.set_header("Content-Type", "application/json");
    request.body = delivery.body;
    return request;
  }

  static Error refusal(httplib::Error error, const std::string& origin, const Exchange& exchange) {
    const bool is_untrusted = error == httplib::Error::SSLServerVerification;
    if (is_untrusted && exchange.is_other_host)
      return {Errc::Denied, origin + ": its certificate is for another host (subjectAltName)"};
    if (is_untrusted) return {Errc::Denied, origin + ": its certificate is not trusted"};
    switch (error) {
      case httplib::Error::Connection:
      case httplib::Error::ConnectionTimeout:
        return {Errc::Timeout, origin + ": no connection"};
      case httplib::Error::Read:
      case httplib::Error::Canceled:
        return {Errc::Timeout, origin + ": no answer in time"};
      default:
        return {Errc::Timeout, fmt::format("{}: {}", origin, httplib::to_string(error))};
    }
  }

  const std::chrono::milliseconds timeout_;
  const NameLookup lookup_;
};

}  // namespace

std::unique_ptr<Sender> make_http_sender(std::chrono::milliseconds timeout, NameLookup lookup) {
  return std::make_unique<HttplibSender>(timeout, std::move(lookup));
}

}  // namespace dripline::webhooks
