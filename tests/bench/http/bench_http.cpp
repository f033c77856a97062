// The HTTP server alone: small requests over connections that stay open, and event streams. Prints
// one JSON object per figure. Server and clients share the machine, so the figures compare servers;
// they are no promise.
#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "server/api/events/event_hub.hpp"
#include "server/api/http_server.hpp"

namespace {

using namespace std::chrono_literals;
namespace api = dripline::api;
using Clock = std::chrono::steady_clock;

constexpr int kClients = 8;
constexpr auto kTime = 5s;
constexpr int kStreams = 100;
constexpr int kEvents = 5000;

int connect_to(std::uint16_t port) {
  const int fd = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (::connect(fd, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0) return fd;
  std::perror("connect");
  std::exit(1);
}

bool ask(int fd, const std::string& path, std::string& answer) {
  const std::string request = "GET " + path + " HTTP/1.1\r\nHost: localhost\r\n\r\n";
  if (::send(fd, request.data(), request.size(), MSG_NOSIGNAL) < 0) return false;
  answer.resize(4096);
  const auto size = ::recv(fd, answer.data(), answer.size(), 0);
  answer.resize(static_cast<std::size_t>(std::max<ssize_t>(size, 0)));
  return size > 0;
}

void figure(const char* name, double value, const char* unit) {
  std::printf("{\"figure\":\"%s\",\"value\":%.6g,\"unit\":\"%s\"}\n", name, value, unit);
  std::fflush(stdout);
}

void measure_requests(std::uint16_t port) {
  std::atomic<std::uint64_t> served{0};
  std::vector<std::thread> clients;
  clients.reserve(kClients);
  const auto start = Clock::now();
  for (int i = 0; i < kClients; ++i) {
    clients.emplace_back([&] {
      const int fd = connect_to(port);
      std::string answer;
      while (Clock::now() - start < kTime && ask(fd, "/small", answer)) ++served;
      ::close(fd);
    });
  }
  for (auto& client : clients) client.join();
  const std::chrono::duration<double> took = Clock::now() - start;
  figure("small requests, 8 connections", static_cast<double>(served) / took.count(), "requests/s");
}

/// Every stream reads every event; the publisher waits when the slowest is far after.
void measure_events(std::uint16_t port, api::EventHub& hub) {
  std::vector<pollfd> streams;
  std::vector<std::uint64_t> heard(kStreams, 0);
  std::string answer;
  for (int i = 0; i < kStreams; ++i) {
    const int fd = connect_to(port);
    ask(fd, "/events", answer);
    streams.push_back({.fd = fd, .events = POLLIN, .revents = 0});
  }
  const std::string data(400, 'x');
  const auto start = Clock::now();
  std::atomic<std::uint64_t> least{0};
  std::thread publisher([&] {
    for (std::uint64_t n = 0; n < kEvents; ++n) {
      while (n > least + 1000) std::this_thread::sleep_for(1ms);
      hub.publish({.kind = "record", .machine = "m", .data = data});
    }
  });
  std::string buffer(1 << 18, '\0');
  while (least < kEvents && Clock::now() - start < 60s) {
    if (::poll(streams.data(), streams.size(), 100) <= 0) continue;
    for (std::size_t i = 0; i < streams.size(); ++i) {
      if (streams[i].revents == 0) continue;
      const auto size = ::recv(streams[i].fd, buffer.data(), buffer.size(), 0);
      if (size <= 0) std::exit(1);
      heard[i] += static_cast<std::uint64_t>(
          std::count(buffer.begin(), buffer.begin() + size, 'd'));  // of "record" and "data"
    }
    least = *std::min_element(heard.begin(), heard.end()) / 2;
  }
  publisher.join();
  const std::chrono::duration<double> took = Clock::now() - start;
  for (const auto& stream : streams) ::close(stream.fd);
  figure("events of 400 bytes, 100 streams", kStreams * kEvents / took.count(), "events/s");
}

}  // namespace

int main() {
  api::EventHub hub;
  api::HttpOptions options;
  options.address = api::parse_http_address("127.0.0.1:0").value();
  auto handle = [&](const api::Request& request) {
    api::Response response;
    response.content_type = "application/json";
    response.body = R"({"status":"ok"})";
    if (request.target.segments.at(0) == "events") {
      response.content_type = "text/event-stream";
      response.events = hub.subscribe(std::nullopt);
    }
    return response;
  };
  auto server = api::HttpServer::start(options, {.handle = handle});
  if (!server) {
    std::fprintf(stderr, "%s\n", server.error().what.c_str());
    return 1;
  }
  measure_requests((*server)->port());
  measure_events((*server)->port(), hub);
  hub.close();
  return 0;
}
