#include "tests/support/rest_client.hpp"

#include <httplib.h>
#include <csignal>

#include "tests/support/network_namespace.hpp"

namespace dripline::test_support {
namespace {

httplib::Client connect(const std::string& url, const std::string& token) {
  httplib::Client client(url);
  client.set_bearer_token_auth(token);
  client.set_read_timeout(30);
  client.enable_server_certificate_verification(false);  // a test's own, where there is one
  return client;
}

RestClient::Reply reply(const httplib::Result& result) {
  if (!result) return {};
  return {result->status, result->body, {result->headers.begin(), result->headers.end()}};
}

}  // namespace

RestClient::RestClient(std::string url, std::string token, std::string network)
    : url_(std::move(url)), token_(std::move(token)), network_(std::move(network)) {
  std::signal(SIGPIPE, SIG_IGN);  // a server that is gone fails the request, not the test's process
}

RestClient::Reply RestClient::get(const std::string& path,
                                  const std::multimap<std::string, std::string>& headers) const {
  const InNetwork inside(network_);
  return reply(connect(url_, token_).Get(path, httplib::Headers(headers.begin(), headers.end())));
}

RestClient::Reply RestClient::post(const std::string& path, const nlohmann::json& body) const {
  return post_text(path, body.dump());
}

RestClient::Reply RestClient::post_text(const std::string& path, const std::string& body) const {
  const InNetwork inside(network_);
  return reply(connect(url_, token_).Post(path, body, "application/json"));
}

RestClient::Reply RestClient::put_bytes(const std::string& path, const std::string& bytes) const {
  const InNetwork inside(network_);
  return reply(connect(url_, token_).Put(path, bytes, "application/octet-stream"));
}

RestClient::Reply RestClient::remove(const std::string& path) const {
  const InNetwork inside(network_);
  return reply(connect(url_, token_).Delete(path));
}

}  // namespace dripline::test_support
