#include <httplib.h>
#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "server/webhooks/connection_bytes.hpp"
#include "server/webhooks/delivery.hpp"

namespace dripline::webhooks {
namespace {

/// While it lives, an exchange that takes too long, has a head without an end, or is not wanted
/// any more, is cut off. The library's own timeouts begin again with each byte of an answer, and
/// its lines have no limit.
class Deadline {
 public:
  Deadline(httplib::Client& client, const std::atomic<int>& socket, std::chrono::milliseconds limit,
           std::uint64_t max_bytes, const std::stop_token& stop)
      : watch_([this, &client, &socket, limit, max_bytes, stop](const std::stop_token& over) {
          constexpr std::chrono::milliseconds kLook{20};
          const auto end = std::chrono::steady_clock::now() + limit;
          std::mutex mutex;
          std::condition_variable_any never;
          std::unique_lock lock(mutex);
          while (!over.stop_requested()) {
            if (bytes_received(socket) > max_bytes) is_too_long_ = true;
            const bool is_late = std::chrono::steady_clock::now() >= end;
            // Again at every look: before the connection is there, nothing can be cut off.
            if (stop.stop_requested() || is_late || is_too_long_) client.stop();
            never.wait_for(lock, over, kLook, [] { return false; });
          }
        }) {}

  bool is_too_long() const { return is_too_long_; }

 private:
  std::atomic<bool> is_too_long_ = false;
  std::jthread watch_;
};

class HttplibSender final : public Sender {
 public:
  explicit HttplibSender(std::chrono::milliseconds timeout) : timeout_(timeout) {}

  Result<void> send(const Delivery& delivery, const std::stop_token& stop) override {
    const auto path_at = delivery.url.find_first_of("/?", delivery.url.find("://") + 3);
    const std::string origin = delivery.url.substr(0, path_at);
    std::string path = path_at == std::string::npos ? "/" : delivery.url.substr(path_at);
    if (path.front() == '?') path.insert(0, "/");
    httplib::Client client(origin);
    client.set_follow_location(false);
    client.set_url_encode(false);
    client.set_connection_timeout(timeout_);
    client.set_read_timeout(timeout_);
    client.set_write_timeout(timeout_);
    std::atomic<int> socket = -1;
    client.set_socket_options([&socket](int made) { socket = made; });
    const httplib::Headers headers{{"Dripline-Event", delivery.kind},
                                   {"Dripline-Delivery", delivery.id},
                                   {"Dripline-Timestamp", delivery.timestamp},
                                   {"Dripline-Signature", delivery.signature},
                                   {"User-Agent", "dripline-webhook"}};
    // The answer's text is of no use here, and may be long.
    std::size_t received = 0;
    httplib::Request request;
    request.method = "POST";
    request.path = path;
    request.headers = headers;
    request.set_header("Content-Type", "application/json");
    request.body = delivery.body;
    request.content_receiver = [&received](const char*, std::size_t size, std::uint64_t,
                                           std::uint64_t) {
      received += size;
      return received <= kMaxAnswer;
    };
    int status = 0;  // it counts where the text was too long to be read to its end
    request.response_handler = [&status](const httplib::Response& head) {
      status = head.status;
      return true;
    };
    bool is_too_long = false;
    const auto answer = [&] {
      const Deadline deadline(client, socket, 3 * timeout_, kMaxExchange, stop);
      auto sent = client.send(request);
      is_too_long = deadline.is_too_long();
      return sent;
    }();
    if (is_too_long && status == 0)
      return fail(Errc::LimitExceeded, "{}: the head of its answer has more than {} bytes", origin,
                  kMaxExchange);
    if (!answer && received <= kMaxAnswer) return fail(refusal(answer.error(), origin));
    if (answer) status = answer->status;
    if (status >= 200 && status < 300) return {};
    return fail(Errc::Conflict, "{} answered with status {}", origin, status);
  }

 private:
  static constexpr std::size_t kMaxAnswer = 64 * 1024;
  /// All bytes of the connection, those of TLS and of the answer's head with them: far more than
  /// any receiver has to say.
  static constexpr std::uint64_t kMaxExchange = 1024 * 1024;

  static Error refusal(httplib::Error error, const std::string& origin) {
    const bool is_untrusted = error == httplib::Error::SSLServerVerification;
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
};

}  // namespace

std::unique_ptr<Sender> make_http_sender(std::chrono::milliseconds timeout) {
  return std::make_unique<HttplibSender>(timeout);
}

}  // namespace dripline::webhooks
