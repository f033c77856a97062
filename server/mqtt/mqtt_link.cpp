#include <poll.h>
#include <sys/eventfd.h>
#include <algorithm>
#include <array>
#include <optional>

#include "protocol/base/descriptor.hpp"
#include "server/mqtt/broker_link.hpp"
#include "server/mqtt/broker_socket.hpp"
#include "server/mqtt/client_session.hpp"
#include "server/mqtt/tls_client.hpp"

namespace dripline::mqtt {
namespace {

constexpr std::uint16_t kKeepAliveSeconds = 20;
constexpr int kMaxPieces = 16;  ///< of one look at the socket
/// The keep-alive is looked after at each look.
constexpr std::chrono::milliseconds kLook{1000};

/// The session over a socket, with TLS between them or without.
class MqttLink final : public BrokerLink {
 public:
  MqttLink(MqttSettings settings, std::string client_id, NameLookup lookup)
      : settings_(std::move(settings)),
        client_id_(std::move(client_id)),
        lookup_(std::move(lookup)),
        wake_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {}

  Result<void> open(const Message& will, const std::string& subscribed) override {
    drop();
    const auto password = read_password(settings_);
    if (!password) return fail(password.error());
    if (settings_.has_tls) {
      auto tls = TlsClient::make(settings_);
      if (!tls) return fail(tls.error());
      tls_.emplace(std::move(*tls));
    }
    session_.emplace(Introduction{.client_id = client_id_,
                                  .user = settings_.user,
                                  .password = *password,
                                  .keep_alive = kKeepAliveSeconds,
                                  .is_version_5 = settings_.is_version_5});
    if (auto begun = session_->begin(will, subscribed, clock_.steady_now()); !begun) return begun;
    if (auto opened = socket_.open(settings_.host, settings_.port, lookup_); !opened)
      return fail(opened.error().code, "{}: {}", settings_.broker, opened.error().what);
    return {};
  }

  Result<std::uint64_t> publish(const Message& message) override {
    if (!session_) return fail(Errc::Io, "{}: not open", settings_.broker);
    auto number = session_->publish(message);
    if (!number) return fail(number.error().code, "{} {}", settings_.broker, number.error().what);
    return number;
  }

  Progress wait(std::chrono::milliseconds limit) override {
    if (!session_) return {.is_lost = true, .fault = settings_.broker + ": not open"};
    watch(std::min(limit, kLook));
    const auto done = exchange();
    Progress progress{.is_connected = done && session_->is_connected(),
                      .is_lost = !done,
                      .acknowledged = session_->take_acknowledged(),
                      .received = session_->take_received()};
    if (!done) progress.fault = fmt::format("{}: {}", settings_.broker, done.error().what);
    return progress;
  }

  void wake() override {
    const std::uint64_t one = 1;
    (void)!::write(wake_.get(), &one, sizeof one);
  }

  void close() override {
    if (session_ && socket_.is_connected()) {
      session_->leave();
      (void)send();  // what the socket takes at once
      if (tls_) tls_->close();
      (void)send();
    }
    drop();
  }

  void drop() override {
    session_.reset();
    tls_.reset();
    socket_ = BrokerSocket();
    encrypted_.clear();
    taken_ = 0;
  }

 private:
  Result<void> exchange() {
    const auto connected = socket_.connect();
    if (!connected) return fail(connected.error());
    if (!*connected) return {};
    const auto received = receive();
    if (!received) return received;
    if (auto looked = session_->look(clock_.steady_now()); !looked) return looked;
    return send();
  }

  /// What has come is taken before the end of the connection is reported.
  Result<void> receive() {
    for (int i = 0; i < kMaxPieces; ++i) {
      std::string bytes;
      const auto got = socket_.receive(bytes);
      if (!got) return fail(got.error());
      if (!*got) return {};
      std::string plain;
      Result<void> opened;
      if (tls_) opened = tls_->receive(bytes, plain);
      auto taken = session_->receive(tls_ ? plain : bytes, clock_.steady_now());
      if (!taken) return taken;
      if (!opened) {
        (void)send();  // TLS says why
        return opened;
      }
    }
    return {};
  }

  /// A piece after the other; what is acknowledged as written is with the kernel.
  Result<void> send() {
    while (true) {
      if (auto encrypted = fill(); !encrypted) return encrypted;
      const std::string_view bytes = tls_ ? std::string_view(encrypted_) : next_piece();
      if (bytes.empty()) return {};
      const auto sent = socket_.send(bytes);
      if (!sent) return fail(sent.error());
      if (*sent == 0) return {};
      if (!tls_) {
        session_->written(*sent, clock_.steady_now());
        continue;
      }
      encrypted_.erase(0, *sent);
      if (encrypted_.empty()) session_->written(std::exchange(taken_, 0), clock_.steady_now());
    }
  }

  Result<void> fill() {
    if (!tls_ || !encrypted_.empty()) return {};
    encrypted_ = tls_->take_output();
    if (!encrypted_.empty() || !tls_->is_open()) return {};
    const auto piece = next_piece();
    if (auto sent = tls_->send(piece); !sent) return sent;
    taken_ = piece.size();
    encrypted_ = tls_->take_output();
    return {};
  }

  std::string_view next_piece() const { return session_->output().substr(0, BrokerSocket::kPiece); }

  bool wants_to_send() const {
    if (socket_.is_looking_up()) return false;
    if (!socket_.is_connected() || !encrypted_.empty()) return true;
    return (!tls_ || tls_->is_open()) && !session_->output().empty();
  }

  void watch(std::chrono::milliseconds limit) {
    std::array<pollfd, 2> files{};
    files[0] = {.fd = wake_.get(), .events = POLLIN, .revents = 0};
    files[1] = {.fd = socket_.descriptor(), .events = POLLIN, .revents = 0};
    if (wants_to_send()) files[1].events = POLLIN | POLLOUT;
    (void)::poll(files.data(), files.size(), static_cast<int>(limit.count()));
    std::uint64_t count = 0;
    (void)!::read(wake_.get(), &count, sizeof count);
  }

  const MqttSettings settings_;
  const std::string client_id_;
  const NameLookup lookup_;
  const SystemClock clock_;
  Descriptor wake_;
  BrokerSocket socket_;
  std::optional<TlsClient> tls_;
  std::optional<ClientSession> session_;
  std::string encrypted_;  ///< of TLS, to be sent
  std::size_t taken_ = 0;  ///< bytes of the session in it
};

}  // namespace

std::unique_ptr<BrokerLink> make_mqtt_link(MqttSettings settings, std::string client_id,
                                           NameLookup lookup) {
  return std::make_unique<MqttLink>(std::move(settings), std::move(client_id), std::move(lookup));
}

}  // namespace dripline::mqtt
