#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "server/api/events/event_hub.hpp"
#include "server/api/http_server.hpp"
#include "tests/unit/server/api/raw_peer.hpp"

/// An HTTP server on loopback for clients that are hostile, broken or only slow.
namespace dripline::server_test {

inline constexpr std::string_view kToken = "Authorization: Bearer right\r\n";

inline std::string get(std::string_view path, std::string_view fields = kToken) {
  return fmt::format("GET {} HTTP/1.1\r\nHost: localhost\r\n{}\r\n", path, fields);
}

inline std::string post(std::string_view path, std::string_view body,
                        std::string_view fields = kToken) {
  return fmt::format("POST {} HTTP/1.1\r\nHost: h\r\n{}Content-Length: {}\r\n\r\n{}", path, fields,
                     body.size(), body);
}

/// Holds handlers until it is opened.
class Gate {
 public:
  void wait() {
    std::unique_lock lock(mutex_);
    ++waiting_;
    changed_.notify_all();
    changed_.wait(lock, [this] { return is_open_; });
  }
  void wait_for(int number) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, std::chrono::seconds(30), [&] { return waiting_ >= number; });
  }
  void open() {
    const std::lock_guard lock(mutex_);
    is_open_ = true;
    changed_.notify_all();
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  int waiting_ = 0;
  bool is_open_ = false;
};

/// `/health` and `/session` for everybody, the rest with the token: `/wait` (storage), `/machine`
/// (a machine), `/stop` (a machine, at once) and `/stop/wait`, `/events`, `/pieces`, and anything
/// else echoes its body.
class HttpAttack : public testing::Test {
 protected:
  void TearDown() override {
    gate_.open();
    hub_.close();
  }

  void start() {
    options_.address = api::parse_http_address("127.0.0.1:0").value();
    if (options_.max_body == 0) options_.max_body = 1 << 20;
    auto started = api::HttpServer::start(
        options_,
        {.handle = [this](const api::Request& request) { return answer(request); },
         .judge = [](api::Request& head) { return judge(head); },
         .waits_for_machine =
             [](const api::Request& r) {
               return r.target.segments.at(0) == "machine" || is_stop(r);
             },
         .may_stop = is_stop,
         .finds_run = [](const api::Request& r) { return r.target.segments.at(0) == "runs"; }});
    ASSERT_TRUE(started) << started.error().what;
    server_ = *std::move(started);
  }

  static bool is_stop(const api::Request& request) {
    return request.target.segments.at(0) == "stop";
  }
  static std::optional<api::Response> judge(api::Request& head) {
    api::Response response;
    if (head.target.segments.at(0) == "health") {
      response.body = "fine\n";
      return response;
    }
    if (head.target.segments.at(0) == "session") return std::nullopt;
    const std::string token = head.header("authorization");
    if (token == "Bearer right" || token == "Bearer other") {
      head.who.name = token;
      head.caller.emplace().user = token;
      return std::nullopt;
    }
    response.status = 401;
    return response;
  }

  api::Response answer(const api::Request& request) {
    const std::string what = request.target.segments.at(0);
    if (what == "wait" || what == "machine" || request.target.segments.back() == "wait")
      gate_.wait();
    api::Response response;
    if (what == "events") {
      response.content_type = "text/event-stream";
      response.events = hub_.subscribe(std::nullopt);
    } else if (what == "pieces") {
      response.source = [n = 0]() mutable -> Result<std::optional<std::string>> {
        if (++n > 3) return std::optional<std::string>();
        return std::optional("piece\n" + std::to_string(n));
      };
    } else {
      response.body = "served " + request.body + "\n";
    }
    return response;
  }

  RawPeer peer() { return RawPeer(server_->port()); }
  /// Sends text over a new connection; what comes back until `end`.
  std::string exchange(const std::string& text, std::string_view end = "\n\0") {
    RawPeer one = peer();
    EXPECT_TRUE(one.is_connected());
    one.send(text);
    return one.read_until(end);
  }
  std::string status_of(const std::string& text) {
    return exchange(text, "\r\n\r\n").substr(0, std::string_view("HTTP/1.1 200").size());
  }
  void expect_health() {
    EXPECT_NE(exchange(get("/health", ""), "fine\n").find(" 200 OK\r\n"), std::string::npos);
  }
  void expect_served() {
    EXPECT_NE(exchange(get("/x"), "served").find(" 200 OK\r\n"), std::string::npos);
  }
  std::vector<RawPeer> idle(int number) {
    std::vector<RawPeer> peers;
    peers.reserve(static_cast<std::size_t>(number));
    for (int i = 0; i < number; ++i) peers.push_back(peer());
    return peers;
  }

  api::HttpOptions options_;
  Gate gate_;
  api::EventHub hub_;
  std::unique_ptr<api::HttpServer> server_;
};

}  // namespace dripline::server_test
