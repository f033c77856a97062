#pragma once

#include <atomic>
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "clients/lib/http.hpp"

namespace dripline::client {

/// Several servers of one library, of which one has it and the others stand by: a request goes to
/// the one that has it. Which that is, is asked (GET /api/v1/ready) before the first request and
/// whenever the last one's server stands by or does not answer. A request that changes something is
/// repeated at another server only where the first one cannot have taken it; one that reads,
/// unless a part of its answer has been passed on. While one is a standby, it may be
/// taking the library over: they are asked again for some seconds. Failures: those of Http;
/// Unreachable names each server and why it was not the one.
class SharedHttp final : public Http {
 public:
  struct Member {
    ServerAddress address;
    std::unique_ptr<Http> http;
    std::unique_ptr<Http> probe;  ///< to ask which it is: a server that is frozen costs a moment
  };
  /// `patience`: for how long servers are asked again while one of them is a standby: it may be
  /// taking over.
  explicit SharedHttp(std::vector<Member> members,
                      std::chrono::milliseconds patience = std::chrono::seconds(15));

  Reply<HttpResponse> send(const HttpRequest& request) override;
  void stop() override;
  const ServerAddress* answering() const override;

 private:
  /// Of each server why it is not asked; empty: it may be.
  using Reasons = std::vector<std::string>;
  std::optional<Reply<HttpResponse>> send_once(const HttpRequest& request, Reasons& reasons);
  std::optional<std::size_t> choose(Reasons& reasons);
  bool wait_before_the_next_round(std::chrono::steady_clock::time_point end);
  enum class Role { Ready, Active, Other };
  Role ask_role(std::size_t member, std::string& reason);

  const std::vector<Member> members_;
  const std::chrono::milliseconds patience_;
  std::optional<std::size_t> active_;  ///< that answered last
  bool has_standby_ = false;           ///< one of those that were asked for this request
  std::atomic<bool> is_stopped_ = false;
};

/// Of one server what the other open_http gives. `servers` is not empty.
std::unique_ptr<Http> open_http(const std::vector<ServerAddress>& servers,
                                const HttpOptions& options = {});

}  // namespace dripline::client
