#include <httplib.h>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "server/webhooks/delivery.hpp"

namespace dripline::webhooks {
namespace {

/// While it lives, an exchange that takes too long, or is not wanted any more, is cut off. The
/// library's own timeouts begin again with each byte of an answer.
class Deadline {
 public:
  Deadline(httplib::Client& client, std::chrono::milliseconds limit, const std::stop_token& stop)
      : watch_([&client, limit, stop](const std::stop_token& over) {
          constexpr std::chrono::milliseconds kLook{50};
          const auto end = std::chrono::steady_clock::now() + limit;
          std::mutex mutex;
          std::condition_variable_any never;
          std::unique_lock lock(mutex);
          while (!over.stop_requested()) {
            // Again at every look: before the connection is there, nothing can be cut off.
            if (stop.stop_requested() || std::chrono::steady_clock::now() >= end) client.stop();
            never.wait_for(lock, over, kLook, [] { return false; });
          }
        }) {}

 private:
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
    const auto answer = [&] {
      const Deadline deadline(client, 3 * timeout_, stop);
      return client.send(request);
    }();
    if (!answer && received <= kMaxAnswer) return fail(refusal(answer.error(), origin));
    if (answer) status = answer->status;
    if (status >= 200 && status < 300) return {};
    return fail(Errc::Conflict, "{} answered with status {}", origin, status);
  }

 private:
  static constexpr std::size_t kMaxAnswer = 64 * 1024;

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
