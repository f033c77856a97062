#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace dripline::test_support {

/// A plain HTTP client for tests, independent of our own client library, so that a shared mistake
/// cannot hide.
class RestClient {
 public:
  struct Reply {
    int status = 0;  ///< 0: no answer
    std::string body;
    std::map<std::string, std::string> headers = {};  ///< names as the server writes them
    nlohmann::json json() const { return nlohmann::json::parse(body, nullptr, false); }
  };

  /// `network`: path of the network namespace that it asks from; empty: the caller's.
  RestClient(std::string url, std::string token, std::string network = {});
  const std::string& url() const { return url_; }
  Reply get(const std::string& path,
            const std::multimap<std::string, std::string>& headers = {}) const;
  Reply post(const std::string& path, const nlohmann::json& body) const;
  Reply post_text(const std::string& path, const std::string& body) const;
  Reply put_bytes(const std::string& path, const std::string& bytes) const;
  Reply remove(const std::string& path) const;

 private:
  std::string url_;
  std::string token_;
  std::string network_;
};

}  // namespace dripline::test_support
