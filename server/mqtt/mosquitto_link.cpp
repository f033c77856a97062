// The only user of libmosquitto. Its messages in flight end with each connection: a broker that
// lost its sessions would answer the rest of a QoS 2 handshake for a message that it does not have.
#include <mosquitto.h>
#include <mqtt_protocol.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <algorithm>
#include <array>
#include <mutex>
#include <system_error>

#include "protocol/base/descriptor.hpp"
#include "server/mqtt/broker_link.hpp"

namespace dripline::mqtt {
namespace {

constexpr int kKeepAliveSeconds = 20;
constexpr int kMaxPackets = 100;  ///< of one look at the socket
constexpr std::size_t kMaxPayload = 1024 * 1024;
/// libmosquitto does not report what it waits for in a TLS handshake.
constexpr std::chrono::milliseconds kLookConnecting{50};
/// ... and its keep-alive is looked after at each look.
constexpr std::chrono::milliseconds kLook{1000};

struct Freed {
  void operator()(::mosquitto* client) const { mosquitto_destroy(client); }
};
using Client = std::unique_ptr<::mosquitto, Freed>;

const char* c_text(const std::string& text) {
  return text.empty() ? nullptr : text.c_str();
}

/// A key with a passphrase would be asked for at a terminal.
int no_passphrase(char*, int, int, void*) {
  return 0;
}

class MosquittoLink final : public BrokerLink {
 public:
  MosquittoLink(MqttSettings settings, std::string client_id)
      : settings_(std::move(settings)),
        client_id_(std::move(client_id)),
        wake_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
    static std::once_flag once;  // the library counts, but is not safe on two threads
    std::call_once(once, [] { mosquitto_lib_init(); });
  }

  Result<void> open(const Message& will, const std::string& subscribed) override {
    progress_ = {};
    subscribed_ = subscribed;
    last_fault_.clear();
    client_.reset(mosquitto_new(client_id_.c_str(), true, this));
    if (!client_) return fail(Errc::Io, "mqtt: no client: {}", mosquitto_strerror(MOSQ_ERR_NOMEM));
    auto* client = client_.get();
    const int version = settings_.is_version_5 ? MQTT_PROTOCOL_V5 : MQTT_PROTOCOL_V311;
    mosquitto_int_option(client, MOSQ_OPT_PROTOCOL_VERSION, version);
    mosquitto_int_option(client, MOSQ_OPT_TCP_NODELAY, 1);
    listen();
    if (auto secured = secure(); !secured) return secured;
    const int set =
        mosquitto_will_set(client, will.topic.c_str(), static_cast<int>(will.payload.size()),
                           will.payload.data(), will.qos, will.is_retained);
    if (set != MOSQ_ERR_SUCCESS) return fail(Errc::Io, "mqtt: will: {}", text_of(set));
    const int begun =
        mosquitto_connect_async(client, settings_.host.c_str(), settings_.port, kKeepAliveSeconds);
    if (begun == MOSQ_ERR_SUCCESS) return {};
    return fail(Errc::Io, "{}: {}", settings_.broker, text_of(begun));
  }

  Result<std::uint64_t> publish(const Message& message) override {
    if (message.payload.size() > kMaxPayload) {
      return fail(Errc::LimitExceeded, "message of {} bytes for {}: at most {}",
                  message.payload.size(), message.topic, kMaxPayload);
    }
    int id = 0;
    const int done = mosquitto_publish_v5(
        client_.get(), &id, message.topic.c_str(), static_cast<int>(message.payload.size()),
        message.payload.data(), message.qos, message.is_retained, nullptr);
    if (done == MOSQ_ERR_SUCCESS) return static_cast<std::uint64_t>(id);
    if (done == MOSQ_ERR_OVERSIZE_PACKET || done == MOSQ_ERR_PAYLOAD_SIZE) {
      return fail(Errc::LimitExceeded, "{} takes no message of {} bytes ({})", settings_.broker,
                  message.payload.size(), message.topic);
    }
    return fail(Errc::Io, "{}: {}: {}", settings_.broker, message.topic, text_of(done));
  }

  Progress wait(std::chrono::milliseconds limit) override {
    if (!client_) return {.is_lost = true, .fault = settings_.broker + ": not open"};
    watch(std::min(limit, progress_.is_connected ? kLook : kLookConnecting));
    const int done = mosquitto_loop(client_.get(), 0, kMaxPackets);
    if (done != MOSQ_ERR_SUCCESS && !progress_.is_lost) lose(text_of(done));
    Progress now = progress_;
    progress_.acknowledged.clear();
    progress_.received.clear();
    return now;
  }

  void wake() override {
    const std::uint64_t one = 1;
    (void)!::write(wake_.get(), &one, sizeof one);
  }

  void close() override {
    if (!client_) return;
    mosquitto_disconnect(client_.get());  // written at once, when the socket takes it
    client_.reset();
  }
  void drop() override { client_.reset(); }

 private:
  static MosquittoLink& self(void* object) { return *static_cast<MosquittoLink*>(object); }

  void listen() {
    auto* client = client_.get();
    mosquitto_connect_v5_callback_set(
        client, [](::mosquitto*, void* object, int reason, int, const mosquitto_property*) {
          auto& link = self(object);
          link.progress_.is_connected = reason == 0;
          if (reason != 0) return link.lose("refused: " + link.reason_text(reason));
          if (!link.subscribed_.empty()) link.subscribe();
        });
    mosquitto_message_callback_set(
        client, [](::mosquitto*, void* object, const mosquitto_message* message) {
          auto& link = self(object);
          const bool is_wanted = link.subscribed_ == message->topic && !message->retain;
          if (is_wanted) link.receive(message->payload, message->payloadlen);
        });
    mosquitto_disconnect_v5_callback_set(
        client, [](::mosquitto*, void* object, int reason, const mosquitto_property*) {
          auto& link = self(object);
          if (!link.progress_.is_lost) link.lose(link.text_of(reason));
        });
    mosquitto_publish_v5_callback_set(
        client, [](::mosquitto*, void* object, int id, int reason, const mosquitto_property*) {
          constexpr int kFirstRefusal = 0x80;
          auto& link = self(object);
          link.progress_.acknowledged.push_back(
              {static_cast<std::uint64_t>(id),
               reason < kFirstRefusal ? "" : mosquitto_reason_string(reason)});
        });
    mosquitto_log_callback_set(client, [](::mosquitto*, void* object, int level, const char* text) {
      if (level == MOSQ_LOG_ERR) self(object).last_fault_ = text;
    });
  }

  void subscribe() {
    constexpr int kQos = 1;
    const int done = mosquitto_subscribe(client_.get(), nullptr, subscribed_.c_str(), kQos);
    if (done != MOSQ_ERR_SUCCESS) lose(text_of(done));
  }
  void receive(const void* payload, int size) {
    constexpr int kMaxSize = 64 * 1024;
    constexpr std::size_t kMaxWaiting = 16;
    if (size < 0 || size > kMaxSize || progress_.received.size() >= kMaxWaiting) return;
    progress_.received.emplace_back(static_cast<const char*>(payload),
                                    static_cast<std::size_t>(size));
  }

  Result<void> secure() {
    auto* client = client_.get();
    const auto password = read_password(settings_);
    if (!password) return fail(password.error());
    if (!settings_.user.empty())
      mosquitto_username_pw_set(client, settings_.user.c_str(), c_text(*password));
    if (!settings_.has_tls) return {};
    if (settings_.ca.empty()) mosquitto_int_option(client, MOSQ_OPT_TLS_USE_OS_CERTS, 1);
    // The library wants one of the two named even with the system's authorities.
    const char* folder = settings_.ca.empty() ? "/etc/ssl/certs" : nullptr;
    const int set =
        mosquitto_tls_set(client, c_text(settings_.ca), folder, c_text(settings_.certificate),
                          c_text(settings_.key), no_passphrase);
    if (set != MOSQ_ERR_SUCCESS) return fail(Errc::Denied, "mqtt: TLS: {}", text_of(set));
    return {};
  }

  void watch(std::chrono::milliseconds limit) {
    std::array<pollfd, 2> files{};
    files[0] = {.fd = wake_.get(), .events = POLLIN, .revents = 0};
    files[1].fd = mosquitto_socket(client_.get());
    files[1].events = POLLIN;
    if (mosquitto_want_write(client_.get())) files[1].events |= POLLOUT;
    (void)::poll(files.data(), files.size(), static_cast<int>(limit.count()));
    std::uint64_t count = 0;
    (void)!::read(wake_.get(), &count, sizeof count);
  }

  void lose(const std::string& why) {
    progress_.is_lost = true;
    progress_.is_connected = false;
    progress_.fault = fmt::format("{}: {}", settings_.broker, why);
  }

  /// What the library logged before is more than its error.
  std::string text_of(int error) const {
    const std::string text = error == MOSQ_ERR_ERRNO ? errno_text() : mosquitto_strerror(error);
    return last_fault_.empty() ? text : fmt::format("{} ({})", text, last_fault_);
  }
  static std::string errno_text() { return std::generic_category().message(errno); }
  std::string reason_text(int reason) const {
    return settings_.is_version_5 ? mosquitto_reason_string(reason)
                                  : mosquitto_connack_string(reason);
  }

  const MqttSettings settings_;
  const std::string client_id_;
  Descriptor wake_;
  Progress progress_;
  std::string last_fault_;
  std::string subscribed_;
  Client client_;  // last: its callbacks use the others
};

}  // namespace

std::unique_ptr<BrokerLink> make_mosquitto_link(MqttSettings settings, std::string client_id) {
  return std::make_unique<MosquittoLink>(std::move(settings), std::move(client_id));
}

}  // namespace dripline::mqtt
