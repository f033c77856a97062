#include "server/api/impl/transport.hpp"

#include "server/api/impl/peer_certificate.hpp"

#include <boost/asio/redirect_error.hpp>
#include <boost/asio/ssl/stream.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core/stream_traits.hpp>
#include <boost/beast/core/tcp_stream.hpp>

namespace dripline::api {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
using asio::awaitable;
using boost::system::error_code;

using TlsStream = asio::ssl::stream<beast::tcp_stream>;

template <class Stream>
class StreamTransport final : public Transport {
 public:
  template <class... Arguments>
  explicit StreamTransport(asio::ip::tcp::socket socket, Arguments&... arguments)
      : stream_(beast::tcp_stream(std::move(socket)), arguments...) {}

  awaitable<bool> open(Limit limit) override {
    error_code error;
    if constexpr (kIsTls) {
      tcp().expires_after(limit);
      co_await stream_.async_handshake(asio::ssl::stream_base::server, into(error));
    }
    co_return !error;
  }

  awaitable<std::size_t> read(asio::mutable_buffer to, Time until) override {
    error_code error;
    tcp().expires_at(until);
    const std::size_t size = co_await stream_.async_read_some(to, into(error));
    co_return error ? 0 : size;
  }

  awaitable<bool> write(std::string_view text, Limit limit) override {
    error_code error;
    while (!text.empty() && !error) {
      const std::string_view piece = text.substr(0, kWritePiece);
      tcp().expires_after(limit);
      co_await asio::async_write(stream_, asio::buffer(piece), into(error));
      text.remove_prefix(piece.size());
    }
    co_return !error;
  }

  awaitable<void> say_goodbye(Limit limit) override {
    error_code ignored;
    if constexpr (kIsTls) {
      tcp().expires_after(limit);
      co_await stream_.async_shutdown(into(ignored));
    }
    socket().shutdown(asio::ip::tcp::socket::shutdown_both, ignored);
    co_return;
  }

  asio::ip::tcp::socket& socket() override { return tcp().socket(); }

  std::optional<identity::ClientCertificate> certificate() override {
    if constexpr (kIsTls) return peer_certificate(stream_.native_handle());
    return std::nullopt;
  }

 private:
  static constexpr bool kIsTls = std::is_same_v<Stream, TlsStream>;
  static auto into(error_code& error) { return asio::redirect_error(asio::use_awaitable, error); }
  beast::tcp_stream& tcp() { return beast::get_lowest_layer(stream_); }
  Stream stream_;
};

}  // namespace

void Transport::close() {
  error_code ignored;
  socket().close(ignored);
}

std::string Transport::peer_address() {
  error_code error;
  const auto peer = socket().remote_endpoint(error);
  if (error) return {};
  const auto& address = peer.address();
  if (address.is_v6() && address.to_v6().is_v4_mapped())
    return asio::ip::make_address_v4(asio::ip::v4_mapped, address.to_v6()).to_string();
  return address.to_string();
}

std::unique_ptr<Transport> make_transport(asio::ip::tcp::socket socket, asio::ssl::context* tls) {
  if (tls != nullptr) return std::make_unique<StreamTransport<TlsStream>>(std::move(socket), *tls);
  return std::make_unique<StreamTransport<beast::tcp_stream>>(std::move(socket));
}

}  // namespace dripline::api
