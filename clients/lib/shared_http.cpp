#include "clients/lib/shared_http.hpp"

#include <thread>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "clients/lib/request_age.hpp"

namespace dripline::client {
namespace {

using namespace std::chrono_literals;

constexpr HttpOptions kProbeOptions{.connect_timeout = 3000ms, .read_timeout = 3000ms};

bool only_reads(const HttpRequest& request) {
  return request.method == "GET" || request.method == "HEAD";
}

/// On every answer of a server that waits, which has done nothing then.
bool stands_by(const HttpResponse& response) {
  const auto role = response.headers.find("dripline-role");
  return role != response.headers.end() && role->second == "standby";
}

Failure without_library(const std::vector<std::string>& reasons) {
  return {Failure::Kind::Unreachable, Errc::Timeout,
          fmt::format("none of the servers has the library now: {}", fmt::join(reasons, "; "))};
}

/// A request that notes whether its caller has seen a part of the answer.
class Noted {
 public:
  explicit Noted(const HttpRequest& request) : request_(request) {
    if (request.on_head) {
      request_.on_head = [this, &request] {
        is_seen_ = true;
        return request.on_head();
      };
    }
    if (request.on_body) {
      request_.on_body = [this, &request](std::string_view piece) {
        is_seen_ = true;
        return request.on_body(piece);
      };
    }
  }
  Noted(const Noted&) = delete;
  Noted& operator=(const Noted&) = delete;

  const HttpRequest& request() const { return request_; }
  /// Whether another server may be asked after this failure.
  bool may_repeat(const Failure& failure) const {
    if (failure.kind != Failure::Kind::Unreachable || is_seen_) return false;
    return failure.is_not_taken || only_reads(request_);
  }

 private:
  HttpRequest request_;
  bool is_seen_ = false;
};

}  // namespace

SharedHttp::SharedHttp(std::vector<Member> members, std::chrono::milliseconds patience)
    : members_(std::move(members)), patience_(patience) {}

Reply<HttpResponse> SharedHttp::send(const HttpRequest& request) {
  const auto begun = std::chrono::steady_clock::now(), end = begun + patience_;
  has_standby_ = false;
  HttpRequest again = request;
  for (;;) {
    Reasons reasons(members_.size());
    if (auto answer = send_once(again, reasons)) return *std::move(answer);
    active_.reset();
    if (!has_standby_ || !wait_before_the_next_round(end)) return failed(without_library(reasons));
    again.headers = request.headers;
    add_age(again.headers, std::chrono::ceil<RequestAge>(std::chrono::steady_clock::now() - begun));
  }
}

/// False: there is none.
bool SharedHttp::wait_before_the_next_round(std::chrono::steady_clock::time_point end) {
  constexpr auto kRound = 500ms, kLook = 50ms;
  const auto next = std::chrono::steady_clock::now() + kRound;
  if (next > end) return false;
  while (!is_stopped_ && std::chrono::steady_clock::now() < next)
    std::this_thread::sleep_for(kLook);
  return !is_stopped_;
}

/// Nothing: no server has taken it.
std::optional<Reply<HttpResponse>> SharedHttp::send_once(const HttpRequest& request,
                                                         Reasons& reasons) {
  while (const auto chosen = choose(reasons)) {
    active_ = chosen;
    const Member& member = members_[*chosen];
    Noted noted(request);
    auto response = member.http->send(noted.request());
    if (response && !stands_by(*response)) return response;
    if (response) {
      has_standby_ = true;
      reasons[*chosen] = member.address.url + " stands by";
      continue;
    }
    Failure failure = response.error();
    reasons[*chosen] = failure.what;
    if (noted.may_repeat(failure)) continue;
    active_.reset();  // it is asked before the next one
    if (failure.kind == Failure::Kind::Unreachable && !only_reads(request))
      failure.what += "; it may have done what it was asked for, so no other server was asked";
    return failed(std::move(failure));
  }
  return std::nullopt;
}

/// The one that answered last, or else the first that says that it has the library.
std::optional<std::size_t> SharedHttp::choose(Reasons& reasons) {
  if (active_ && reasons[*active_].empty()) return active_;
  std::optional<std::size_t> unready;
  for (std::size_t i = 0; i < members_.size(); ++i) {
    if (!reasons[i].empty()) continue;
    const Role role = ask_role(i, reasons[i]);
    if (role == Role::Ready) return i;
    // One that is cut off from the database does not know yet that another has taken over.
    if (role == Role::Active && !unready) unready = i;
  }
  return unready;
}

SharedHttp::Role SharedHttp::ask_role(std::size_t member, std::string& reason) {
  HttpRequest request;
  request.path = "/api/v1/ready";
  const auto answer = members_[member].probe->send(request);
  const std::string& url = members_[member].address.url;
  if (!answer) {
    reason = answer.error().what;
    return Role::Other;
  }
  const auto json = nlohmann::json::parse(answer->body, nullptr, false);
  if (!json.is_object() || !json.contains("ready") || !json["ready"].is_boolean()) {
    reason =
        fmt::format("{} answered with status {}; is it a Dripline server?", url, answer->status);
    return Role::Other;
  }
  if (stands_by(*answer)) {
    has_standby_ = true;
    reason = url + " stands by";
    return Role::Other;
  }
  return json["ready"].get<bool>() ? Role::Ready : Role::Active;
}

void SharedHttp::stop() {
  is_stopped_ = true;
  for (const auto& member : members_) {
    member.probe->stop();
    member.http->stop();
  }
}

const ServerAddress* SharedHttp::answering() const {
  return active_ ? &members_[*active_].address : nullptr;
}

std::unique_ptr<Http> open_http(const std::vector<ServerAddress>& servers,
                                const HttpOptions& options) {
  if (servers.size() == 1) return open_http(servers.front(), options);
  std::vector<SharedHttp::Member> members;
  members.reserve(servers.size());
  for (const auto& address : servers) {
    ServerAddress nameless = address;
    nameless.token.clear();  // a probe needs none
    members.push_back({address, open_http(address, options), open_http(nameless, kProbeOptions)});
  }
  return std::make_unique<SharedHttp>(std::move(members));
}

}  // namespace dripline::client
