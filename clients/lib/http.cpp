#include "clients/lib/http.hpp"

#include <httplib.h>
#include <algorithm>

#include "protocol/pki/expected_host.hpp"

namespace dripline::client {
namespace {

constexpr std::size_t kNetworkPiece = 128 * 1024;

std::string lower(std::string text) {
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return text;
}

std::string_view reason(httplib::Error error) {
  switch (error) {
    case httplib::Error::Connection:
      return "nothing accepts a connection there";
    case httplib::Error::ConnectionTimeout:
      return "no answer to the connection in time";
    case httplib::Error::Read:
      return "the connection ended, or stayed silent too long, before the answer was complete";
    case httplib::Error::Write:
      return "the connection ended while sending";
    case httplib::Error::SSLServerVerification:
      return "its certificate is not trusted; expected one signed by the authority of --ca FILE";
    case httplib::Error::SSLLoadingCerts:
      return "the file of --ca cannot be loaded, expected PEM certificates";
    case httplib::Error::SSLConnection:
      return "no TLS there; expected an https server";
    case httplib::Error::Canceled:
      return "the exchange was ended from this side";
    default:
      return "the HTTP exchange failed";
  }
}

/// Of an address that checked_url has found good: without scheme, port and brackets.
std::string host_of(const std::string& url) {
  const std::string host = url.substr(url.find("://") + 3);
  if (host.starts_with('[')) return host.substr(1, host.find(']') - 1);
  return host.substr(0, host.find(':'));
}

/// Before there was a connection, nothing was sent over it.
bool is_before_sending(httplib::Error error) {
  using enum httplib::Error;
  return error == Connection || error == ConnectionTimeout || error == SSLConnection ||
         error == SSLLoadingCerts || error == SSLServerVerification;
}

/// Receives a body: into memory within a bound, or to the caller's function.
class BodyReceiver {
 public:
  BodyReceiver(const HttpRequest& request, HttpResponse& response)
      : request_(request), response_(response) {}

  bool on_head(const httplib::Response& head) {
    response_.status = head.status;
    for (const auto& [name, value] : head.headers) response_.headers[lower(name)] = value;
    return !is_success() || !request_.on_head || request_.on_head();
  }
  bool on_piece(const char* data, std::size_t size) {
    if (request_.on_body && is_success()) return request_.on_body({data, size});
    is_over_ = response_.body.size() + size > request_.max_body;
    if (!is_over_) response_.body.append(data, size);
    return !is_over_;
  }
  bool is_over() const { return is_over_; }

 private:
  bool is_success() const { return response_.status >= 200 && response_.status < 300; }
  const HttpRequest& request_;
  HttpResponse& response_;
  bool is_over_ = false;
};

class HttplibHttp final : public Http {
 public:
  HttplibHttp(const ServerAddress& address, const HttpOptions& options)
      : address_(address), client_(address.url, address.certificate, address.key) {
    client_.set_keep_alive(true);
    client_.set_tcp_nodelay(true);
    client_.set_url_encode(false);
    client_.set_connection_timeout(options.connect_timeout);
    client_.set_read_timeout(options.read_timeout);
    client_.set_write_timeout(options.read_timeout);
    if (address.ca_file) client_.set_ca_cert_path(*address.ca_file);
    // The library's own look takes a common name, too, and a bare `*`.
    SSL_CTX* const context = client_.ssl_context();
    if (context && pki::expect_host(SSL_CTX_get0_param(context), host_of(address.url)))
      is_host_expected_ = true;
  }

  Reply<HttpResponse> send(const HttpRequest& request) override {
    if (is_secure() && !is_host_expected_) return unreachable("it has no name", true);
    HttpResponse response;
    BodyReceiver receiver(request, response);
    const httplib::Request raw = make_request(request, receiver);
    const httplib::Result result = client_.send(raw);
    if (result) {
      // An answer without a body never reaches on_head.
      if (response.status == 0) receiver.on_head(*result);
      return response;
    }
    if (receiver.is_over()) {
      return failed(Failure::Kind::BadReply, Errc::LimitExceeded,
                    "the answer of {} to {} is longer than {} bytes", address_.url, request.path,
                    request.max_body);
    }
    const bool is_other_host = result.error() == httplib::Error::SSLServerVerification &&
                               pki::is_other_host(client_.get_openssl_verify_result());
    return unreachable(is_other_host ? "its certificate is for another host, expected its name or "
                                       "address as a subjectAltName"
                                     : reason(result.error()),
                       is_before_sending(result.error()));
  }

  void stop() override { client_.stop(); }

 private:
  bool is_secure() const { return address_.url.starts_with("https:"); }

  tl::unexpected<Failure> unreachable(std::string_view why, bool is_unsent) const {
    return failed({Failure::Kind::Unreachable, Errc::Timeout,
                   fmt::format("server {} is not reachable: {}", address_.url, why), is_unsent});
  }

  httplib::Request make_request(const HttpRequest& request, BodyReceiver& receiver) const {
    httplib::Request raw;
    raw.method = request.method;
    raw.path = request.path;
    raw.set_header("Accept-Encoding", "identity");  // a range is one of the unencoded bytes
    if (!address_.token.empty()) raw.set_header("Authorization", "Bearer " + address_.token);
    for (const auto& [name, value] : request.headers) raw.set_header(name, value);
    if (request.method == "PUT" || request.method == "POST") add_body(request, raw);
    raw.response_handler = [&receiver](const httplib::Response& head) {
      return receiver.on_head(head);
    };
    raw.content_receiver = [&receiver](const char* data, std::size_t size, std::uint64_t,
                                       std::uint64_t) { return receiver.on_piece(data, size); };
    return raw;
  }

  /// Sends the body from its place, in pieces, so that nothing is copied and progress is visible.
  static void add_body(const HttpRequest& request, httplib::Request& raw) {
    raw.set_header("Content-Type", request.content_type);
    if (request.body.empty())
      return;  // the library writes Content-Length: 0; a second one is an error
    raw.content_length_ = request.body.size();
    raw.content_provider_ = [&request](std::size_t offset, std::size_t length,
                                       httplib::DataSink& sink) {
      const std::size_t size = std::min(length, kNetworkPiece);
      if (!sink.write(request.body.data() + offset, size)) return false;
      return !request.on_sent || request.on_sent(offset + size);
    };
  }

  ServerAddress address_;
  httplib::Client client_;
  bool is_host_expected_ = false;
};

}  // namespace

std::unique_ptr<Http> open_http(const ServerAddress& address, const HttpOptions& options) {
  return std::make_unique<HttplibHttp>(address, options);
}

std::string url_encode(std::string_view text) {
  constexpr char kHex[] = "0123456789ABCDEF";
  std::string out;
  for (const char c : text) {
    const bool is_plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                          (c >= '0' && c <= '9') || c == '-' || c == '.' || c == '_' || c == '~';
    if (is_plain) {
      out += c;
      continue;
    }
    const auto byte = static_cast<unsigned char>(c);
    out += '%';
    out += kHex[byte >> 4];
    out += kHex[byte & 15];
  }
  return out;
}

}  // namespace dripline::client
