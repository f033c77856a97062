// The MTConnect agent at its sockets: 20 devices of which 500 statuses a second change five
// values each. One client thread asks over four connections that stay open, or reads 100 streams
// at 100 ms. Prints one JSON object per figure. Agent and client share the machine, so the figures
// compare agents; they are no promise.
#include <arpa/inet.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "server/api/http_server.hpp"
#include "server/mtconnect/agent.hpp"

namespace {

using namespace std::chrono_literals;
using namespace dripline;
using Clock = std::chrono::steady_clock;

constexpr int kDevices = 20;
constexpr int kStatuses = 500;  ///< a second, of all devices
constexpr int kConnections = 4;
constexpr auto kTime = 5s;
constexpr int kStreams = 100;

void figure(const std::string& name, double value, const char* unit) {
  std::printf("{\"figure\":\"%s\",\"value\":%.6g,\"unit\":\"%s\"}\n", name.c_str(), value, unit);
  std::fflush(stdout);
}

double seconds(timeval time) {
  return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) / 1e6;
}
/// Of all threads of the process, the client's included.
double processor_time() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// Five values of a machine change with each status, as in a program that runs.
class Shop {
 public:
  explicit Shop(mtconnect::Agent& agent, int devices = kDevices) : agent_(agent) {
    constexpr std::uint16_t kAxes = 0b100111;
    for (int i = 0; i < devices; ++i) {
      machines::MachineView view;
      view.machine.name = "mill-" + std::to_string(i);
      view.machine.control = "fanuc";
      view.is_connected = true;
      view.status.emplace();
      view.status.edit().axes = kAxes;
      view.status.edit().modes.emplace();
      view.status.edit().modes->work_system = "G54";
      views_.push_back(view);
      agent_.observer().observe(view);
    }
  }
  void step() {
    auto& view = views_[static_cast<std::size_t>(count_++) % views_.size()];
    auto& status = view.status.edit();
    status.time =
        std::chrono::time_point_cast<std::chrono::microseconds>(std::chrono::system_clock::now());
    status.line++;
    status.position[0] += 0.125;
    status.position[1] -= 0.25;
    status.position[2] += 0.0625;
    status.feed_mm_per_min = 600 + status.position[2];
    agent_.observer().observe(view);
  }
  void begin() {
    thread_ = std::jthread([this](const std::stop_token& stop) {
      auto next = Clock::now();
      while (!stop.stop_requested()) {
        step();
        next += std::chrono::microseconds(1'000'000 / kStatuses);
        std::this_thread::sleep_until(next);
      }
    });
  }
  int count() const { return count_; }

 private:
  mtconnect::Agent& agent_;
  std::vector<machines::MachineView> views_;
  std::atomic<int> count_ = 0;
  std::jthread thread_;
};

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

void send_request(int fd, const std::string& target) {
  const std::string request = "GET " + target + " HTTP/1.1\r\nHost: localhost\r\n\r\n";
  if (::send(fd, request.data(), request.size(), MSG_NOSIGNAL) < 0) std::exit(1);
}

/// One connection with a request in progress.
struct Asking {
  int fd = -1;
  std::string buffer;
  std::size_t size = 0;  ///< of the whole answer; 0: its head is not there yet

  /// True: the answer is complete.
  bool read() {
    constexpr std::size_t kPiece = 256 * 1024;
    const std::size_t before = buffer.size();
    buffer.resize(before + kPiece);
    const auto got = ::recv(fd, &buffer[before], kPiece, 0);
    if (got <= 0) std::exit(1);
    buffer.resize(before + static_cast<std::size_t>(got));
    if (size == 0) {
      const auto end = buffer.find("\r\n\r\n");
      if (end == std::string::npos) return false;
      const auto length = buffer.find("Content-Length: ");
      if (length == std::string::npos || !buffer.starts_with("HTTP/1.1 200")) std::exit(1);
      size = end + 4 + std::strtoull(&buffer[length + 16], nullptr, 10);
    }
    return buffer.size() >= size;
  }
};

void measure_requests(std::uint16_t port, const std::string& target) {
  std::vector<Asking> asking(kConnections);
  std::vector<pollfd> waits;
  for (auto& one : asking) {
    one.fd = connect_to(port);
    waits.push_back({.fd = one.fd, .events = POLLIN, .revents = 0});
    send_request(one.fd, target);
  }
  std::uint64_t answers = 0;
  std::size_t size = 0;
  const auto begin = Clock::now();
  const double used = processor_time();
  while (Clock::now() - begin < kTime) {
    ::poll(waits.data(), waits.size(), 100);
    for (std::size_t i = 0; i < waits.size(); ++i) {
      if (waits[i].revents == 0 || !asking[i].read()) continue;
      ++answers;
      size = asking[i].size;
      asking[i] = {.fd = asking[i].fd, .buffer = {}, .size = 0};
      send_request(asking[i].fd, target);
    }
  }
  const std::chrono::duration<double> took = Clock::now() - begin;
  for (const auto& one : asking) ::close(one.fd);
  figure(target + " (" + std::to_string(size) + " bytes)",
         static_cast<double>(answers) / took.count(), "requests/s");
  figure(target + ": processor time of agent and client", (processor_time() - used) / took.count(),
         "cores");
}

std::uint64_t count(std::string_view text, std::string_view part) {
  std::uint64_t n = 0;
  for (auto at = text.find(part); at != std::string_view::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

/// Every stream reads every observation.
void measure_streams(std::uint16_t port, const Shop& shop) {
  std::vector<pollfd> waits;
  for (int i = 0; i < kStreams; ++i) {
    const int fd = connect_to(port);
    send_request(fd, "/sample?interval=100&count=10000&from=" + std::to_string(5 * shop.count()));
    waits.push_back({.fd = fd, .events = POLLIN, .revents = 0});
  }
  std::string buffer(1 << 18, '\0');
  const auto read_for = [&](std::chrono::seconds time, bool counts) {
    std::uint64_t parts = 0, bytes = 0;
    const auto begin = Clock::now();
    while (Clock::now() - begin < time) {
      ::poll(waits.data(), waits.size(), 10);
      for (const auto& wait : waits) {
        if (wait.revents == 0) continue;
        const auto got = ::recv(wait.fd, buffer.data(), buffer.size(), 0);
        if (got <= 0) std::exit(1);
        bytes += static_cast<std::uint64_t>(got);
        if (counts)
          parts += count({buffer.data(), static_cast<std::size_t>(got)}, "<MTConnectStreams ");
      }
    }
    return std::pair(parts, bytes);
  };
  read_for(2s, false);
  const double used = processor_time();
  const int before = shop.count();
  const auto begin = Clock::now();
  const auto [parts, bytes] = read_for(kTime, true);
  const std::chrono::duration<double> took = Clock::now() - begin;
  const std::string name = std::to_string(kStreams) + " streams at 100 ms";
  figure(name + ": parts", static_cast<double>(parts) / took.count() / kStreams, "parts/s each");
  figure(name + ": observed", 5 * (shop.count() - before) / took.count(), "observations/s");
  figure(name + ": bytes", static_cast<double>(bytes) / took.count() / 1e6, "MB/s");
  figure(name + ": processor time of agent and client", (processor_time() - used) / took.count(),
         "cores");
  for (const auto& wait : waits) ::close(wait.fd);
}

/// What a status costs that changes five values, without readers.
void measure_statuses(Shop& shop) {
  constexpr int kSteps = 200'000;
  const auto begin = Clock::now();
  for (int i = 0; i < kSteps; ++i) shop.step();
  const std::chrono::duration<double, std::micro> took = Clock::now() - begin;
  figure("a status that changes five values", took.count() / kSteps, "us");
}

/// A shop of 1,000 machines: what one request costs after something was observed.
void measure_thousand() {
  const SystemClock clock;
  mtconnect::Agent agent({.sender = "bench", .plant = "bench", .instance = 1}, clock);
  constexpr int kMachines = 1000;
  Shop shop(agent, kMachines);
  const auto ask = [&](const std::string& name, const std::string& path, int times) {
    std::chrono::duration<double, std::milli> took{};
    for (int i = 0; i < times; ++i) {
      shop.step();
      api::Request request;
      request.method = "GET";
      request.target.segments = {"current"};
      if (!path.empty()) request.target.query["path"] = path;
      const auto begin = Clock::now();
      if (agent.handle(request).status != 200) std::exit(1);
      took += Clock::now() - begin;
    }
    figure("1,000 machines: " + name, took.count() / times, "ms");
  };
  ask("/current", "", 20);
  ask("/current?path=, a new path", "//Linear[@name='X']//DataItem[@subType='ACTUAL']", 1);
  ask("/current?path=, known", "//Linear[@name='X']//DataItem[@subType='ACTUAL']", 20);
}

double resident_mb() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

}  // namespace

int main() {
  const SystemClock clock;
  mtconnect::Agent agent({.sender = "bench", .plant = "bench", .instance = 1}, clock);
  Shop shop(agent);
  measure_statuses(shop);
  figure("resident memory with a full buffer", resident_mb(), "MB");
  api::HttpOptions options;
  options.address = api::parse_http_address("127.0.0.1:0").value();
  options.is_open = true;
  constexpr unsigned kHandlers = 4;
  options.handler_threads = kHandlers;
  auto server = api::HttpServer::start(
      options, {.handle = [&](const api::Request& request) { return agent.handle(request); }});
  if (!server) {
    std::fprintf(stderr, "%s\n", server.error().what.c_str());
    return 1;
  }
  shop.begin();
  const auto port = (*server)->port();
  for (const char* target :
       {"/mill-0/current", "/current", "/sample?count=100", "/probe", "/current?path=//Axes"})
    measure_requests(port, target);
  constexpr int kBack = 20'000;  // it stays in the buffer while it is asked for
  measure_requests(port, "/current?at=" + std::to_string(5 * shop.count() - kBack));
  measure_streams(port, shop);
  figure("highest resident memory", resident_mb(), "MB");
  measure_thousand();
  return 0;
}
