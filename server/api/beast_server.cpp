#include <openssl/ssl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <algorithm>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/redirect_error.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <thread>

#include "protocol/base/clock.hpp"
#include "protocol/process/log.hpp"
#include "server/api/http_server.hpp"
#include "server/api/impl/http_session.hpp"

namespace dripline::api {
namespace {

using namespace std::chrono_literals;
namespace asio = boost::asio;
namespace ssl = boost::asio::ssl;
using asio::ip::tcp;
using boost::system::error_code;

/// A group may read the key, as Debian's ssl-cert does; others must neither read nor write it.
Result<void> check_key_mode(const std::string& file) {
  struct stat facts {};
  if (::stat(file.c_str(), &facts) != 0) return {};  // reading it gives the better error
  if ((facts.st_mode & (S_IRWXO | S_IWGRP)) == 0) return {};
  return fail(Errc::Denied, "TLS key {} can be read or changed by others: chmod 600 it", file);
}

/// A client without a certificate is served as before; one with a certificate of another authority
/// is refused in the handshake. Errors: Io.
Result<void> ask_for_certificates(SSL_CTX* context, const std::string& authority) {
  constexpr std::string_view kSession = "dripline";  // of sessions that are resumed
  STACK_OF(X509_NAME)* const names = SSL_load_client_CA_file(authority.c_str());
  if (names == nullptr)
    return fail(Errc::Io, "authority of clients {}: it cannot be read as PEM", authority);
  SSL_CTX_set_client_CA_list(context, names);  // which owns them now
  if (SSL_CTX_load_verify_file(context, authority.c_str()) != 1)
    return fail(Errc::Io, "authority of clients {}: it cannot be used", authority);
  SSL_CTX_set_session_id_context(context, reinterpret_cast<const unsigned char*>(kSession.data()),
                                 kSession.size());
  SSL_CTX_set_verify(context, SSL_VERIFY_PEER, nullptr);
  return {};
}

/// TLS 1.2 and 1.3, only ciphers with forward secrecy. Errors: Denied (others may read the key), Io
/// (a file cannot be read, the key is not the certificate's).
Result<ssl::context> tls_context(const TlsFiles& files) {
  if (auto safe = check_key_mode(files.key); !safe) return fail(safe.error());
  ssl::context context(ssl::context::tls_server);
  SSL_CTX* const native = context.native_handle();
  context.set_options(ssl::context::default_workarounds | ssl::context::single_dh_use |
                      SSL_OP_NO_RENEGOTIATION | SSL_OP_CIPHER_SERVER_PREFERENCE);
  SSL_CTX_set_min_proto_version(native, TLS1_2_VERSION);
  if (SSL_CTX_set_cipher_list(native, "ECDHE+AESGCM:ECDHE+CHACHA20") != 1) {
    return fail(Errc::Io, "this OpenSSL has no TLS 1.2 ciphers with forward secrecy");
  }
  error_code error;
  if (context.use_certificate_chain_file(files.certificate, error); error) {
    return fail(Errc::Io, "certificate {}: {}", files.certificate, error.message());
  }
  if (context.use_private_key_file(files.key, ssl::context::pem, error); error) {
    return fail(Errc::Io, "key {}: {}", files.key, error.message());
  }
  if (files.client_authority.empty()) return context;
  if (auto asked = ask_for_certificates(native, files.client_authority); !asked)
    return fail(asked.error());
  return context;
}

constexpr auto kLastAnswers = 2s;          ///< for the writing of what was answered, at the end
constexpr auto kOutOfDescriptors = 100ms;  ///< pause before the next attempt
constexpr auto kLogInterval = 60s;
constexpr std::uint64_t kLogBurst = 5;  ///< lines about refused connections in each interval

/// Connections must not use the descriptors that storage and DDS need.
ConnectionTable::Limits seats(const HttpLimits& wanted) {
  constexpr std::size_t kOthers = 96;
  constexpr std::size_t kFewest = 16;
  ConnectionTable::Limits limits{.connections = wanted.connections,
                                 .per_address = wanted.per_address,
                                 .reserve = wanted.reserve,
                                 .streams = wanted.event_streams,
                                 .streams_per_address = std::max<std::size_t>(
                                     1, std::min(wanted.event_streams, wanted.per_address / 2))};
  rlimit files{};
  if (::getrlimit(RLIMIT_NOFILE, &files) == 0 &&
      files.rlim_cur < wanted.connections + wanted.reserve + kOthers) {
    const std::size_t left =
        std::max<std::size_t>(files.rlim_cur > kOthers ? files.rlim_cur - kOthers : 0, kFewest);
    limits.reserve = std::min(wanted.reserve, left / 8);
    limits.connections = left - limits.reserve;
    process::log_warning("{} open files allowed: at most {} connections instead of {}",
                         files.rlim_cur, limits.connections, wanted.connections);
  }
  limits.per_address = std::min(limits.per_address, limits.connections);
  limits.streams = std::min(limits.streams, std::max<std::size_t>(1, limits.connections / 2));
  return limits;
}

/// The owner of an IPv6 network has all its addresses.
std::string address_key(const asio::ip::address& address) {
  if (address.is_v4()) return address.to_string();
  const auto v6 = address.to_v6();
  if (v6.is_v4_mapped()) return asio::ip::make_address_v4(asio::ip::v4_mapped, v6).to_string();
  const auto bytes = v6.to_bytes();
  constexpr int kNetworkBytes = 8;
  return {reinterpret_cast<const char*>(bytes.data()), kNetworkBytes};
}

bool is_out_of_resources(const error_code& error) {
  const int code = error.value();
  return code == EMFILE || code == ENFILE || code == ENOBUFS || code == ENOMEM;
}

class BeastServer final : public HttpServer {
 public:
  BeastServer(const HttpOptions& options, HttpHandlers handlers,
              std::optional<asio::ssl::context> tls)
      : shared_(options, std::move(handlers), seats(options.limits)),
        tls_(std::move(tls)),
        acceptor_(shared_.io) {
    const tcp::endpoint endpoint(asio::ip::make_address(options.address.host),
                                 options.address.port);
    acceptor_.open(endpoint.protocol());
    acceptor_.set_option(tcp::acceptor::reuse_address(true));
    acceptor_.bind(endpoint);
    acceptor_.listen(asio::socket_base::max_listen_connections);
    port_ = acceptor_.local_endpoint().port();
    asio::co_spawn(shared_.io, accept(), [](const std::exception_ptr&) {});
    thread_ = std::thread([this] { serve(); });
  }

  /// First closes the listener and the connections that no answer is owed to, then waits for
  /// running handlers and, for kLastAnswers, until what they answer is written.
  // NOLINTNEXTLINE(bugprone-exception-escape): without memory to post a handler it cannot end
  ~BeastServer() override {
    asio::post(shared_.io, [this] {
      shared_.is_stopping = true;
      error_code ignored;
      acceptor_.close(ignored);
      for_each_session([](HttpSession& session) { session.drain(); });
    });
    shared_.pool.stop();
    shared_.commands.wait();
    asio::post(shared_.io, [this] {
      for_each_session([](HttpSession& session) { session.abandon(); });
      work_.reset();
      await_last_answers();
    });
    thread_.join();
  }

  std::uint16_t port() const override { return port_; }

 private:
  template <class Action>
  void for_each_session(Action action) {
    for (const auto& [id, weak] : shared_.sessions) {
      if (const auto session = weak.lock()) action(*session);
    }
  }

  /// The handlers have answered, and what they answered has been posted here before.
  void await_last_answers() {
    if (shared_.sessions.empty()) return;
    shared_.last_answers.expires_after(kLastAnswers);
    shared_.last_answers.async_wait([this](const error_code& ec) {
      if (ec) return;
      for_each_session([](HttpSession& session) { session.close(); });
    });
  }

  /// The failure of one connection (no memory, a defect of ours) must not end the others.
  void serve() {
    for (;;) {
      try {
        shared_.io.run();
        return;
      } catch (const std::exception& e) {
        process::log_error("connection failed: {}", e.what());
      }
    }
  }

  asio::awaitable<void> accept() {
    asio::steady_timer pause(shared_.io);
    while (!shared_.is_stopping) {
      tcp::socket socket(shared_.io);
      error_code error;
      co_await acceptor_.async_accept(socket, asio::redirect_error(asio::use_awaitable, error));
      if (shared_.is_stopping) co_return;
      if (!error) {
        admit(std::move(socket));
        continue;
      }
      complain("connection not accepted: " + error.message());
      if (!is_out_of_resources(error)) continue;
      close_evicted(shared_.table.evict_any());
      pause.expires_after(kOutOfDescriptors);
      error_code ignored;
      co_await pause.async_wait(asio::redirect_error(asio::use_awaitable, ignored));
    }
  }

  /// Never throws for what a client does: it is gone already, or over its bound.
  void admit(tcp::socket socket) {
    try {
      error_code error;
      const auto peer = socket.remote_endpoint(error);
      if (error) return;
      const auto admission = shared_.table.admit(address_key(peer.address()));
      if (admission.evicted || admission.is_reserve) {
        complain(fmt::format("connections are full address={}: {}", peer.address().to_string(),
                             admission.is_reserve ? "only health and stops are answered"
                                                  : "the longest silent one is closed"));
      }
      close_evicted(admission.evicted);
      start_session(shared_, std::move(socket), tls_ ? &*tls_ : nullptr, admission);
    } catch (const std::exception& e) {
      complain(fmt::format("connection not served: {}", e.what()));
    }
  }

  void close_evicted(std::optional<ConnectionTable::Id> id) {
    if (!id) return;
    const auto found = shared_.sessions.find(*id);
    if (found == shared_.sessions.end()) return;
    if (const auto session = found->second.lock()) session->close();
  }

  void complain(const std::string& what) {
    const auto left_out = log_limit_.pass(std::chrono::steady_clock::now());
    if (!left_out) return;
    if (*left_out > 0) {
      process::log_warning("{} ({} such lines left out before)", what, *left_out);
    } else {
      process::log_warning("{}", what);
    }
  }

  HttpShared shared_;
  std::optional<asio::ssl::context> tls_;
  tcp::acceptor acceptor_;
  RateLimit log_limit_{kLogBurst, kLogInterval};
  std::uint16_t port_ = 0;
  asio::executor_work_guard<asio::io_context::executor_type> work_{shared_.io.get_executor()};
  std::thread thread_;
};

}  // namespace

Result<std::unique_ptr<HttpServer>> HttpServer::start(const HttpOptions& options,
                                                      HttpHandlers handlers) {
  if (auto safe = check_exposure(options.address, options.tls.has_value());
      !safe && !options.is_open) {
    return fail(safe.error());
  }
  std::optional<asio::ssl::context> tls;
  if (options.tls) {
    auto made = tls_context(*options.tls);
    if (!made) return fail(made.error());
    tls = *std::move(made);
  }
  try {
    return std::unique_ptr<HttpServer>(
        std::make_unique<BeastServer>(options, std::move(handlers), std::move(tls)));
  } catch (const std::exception& e) {
    return fail(Errc::Io, "cannot listen at {}: {}", options.address.text(), e.what());
  }
}

}  // namespace dripline::api
