#include "tests/support/postgresql/database_cable.hpp"

#include <fmt/format.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstring>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

namespace dripline::test {
namespace {

using SteadyClock = std::chrono::steady_clock;

constexpr int kTickMs = 20;
constexpr std::size_t kPacket = 1448;  ///< of a slow cable

/// What one direction of a cable may pass now.
class Allowance {
 public:
  void begin_turn(double bytes_per_second) {
    constexpr double kBurst = 0.1;  // seconds
    const auto now = SteadyClock::now();
    const std::chrono::duration<double> passed = now - std::exchange(turned_, now);
    has_limit_ = bytes_per_second > 0;
    bytes_ =
        std::min(bytes_ + passed.count() * bytes_per_second, kPacket + kBurst * bytes_per_second);
  }
  std::size_t most() const {
    constexpr std::size_t kAll = 65536;
    if (!has_limit_) return kAll;
    return bytes_ < kPacket ? 0 : kPacket;
  }
  void use(std::size_t bytes) {
    if (has_limit_) bytes_ -= static_cast<double>(bytes);
  }

 private:
  SteadyClock::time_point turned_ = SteadyClock::now();
  bool has_limit_ = false;
  double bytes_ = 0;
};

/// False: this side has ended.
bool pass(int from, int to, Allowance& allowance) {
  std::array<char, 65536> bytes{};
  if (allowance.most() == 0) return true;
  const auto got = ::recv(from, bytes.data(), allowance.most(), MSG_DONTWAIT);
  if (got < 0) return errno == EAGAIN || errno == EINTR;
  if (got == 0) return false;
  allowance.use(static_cast<std::size_t>(got));
  for (ssize_t sent = 0; sent < got;) {
    const auto more =
        ::send(to, bytes.data() + sent, static_cast<std::size_t>(got - sent), MSG_NOSIGNAL);
    if (more <= 0) return false;
    sent += more;
  }
  return true;
}

int connect_to(const std::string& socket_path) {
  const int socket = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::strncpy(address.sun_path, socket_path.c_str(), sizeof address.sun_path - 1);
  if (::connect(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0)
    return socket;
  ::close(socket);
  return -1;
}

}  // namespace

struct DatabaseCable::Pump {
  struct Link {
    int client = -1, database = -1;
  };
  std::string path;
  int listener = -1;
  std::uint16_t port = 0;
  std::atomic<bool> is_pulled = false;
  std::atomic<std::uint64_t> rate = 0;
  Allowance up, down;
  std::vector<Link> links;
  std::jthread thread;

  void listen() {
    listener = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    if (::bind(listener, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
        ::listen(listener, 32) != 0 ||
        ::getsockname(listener, reinterpret_cast<sockaddr*>(&address), &size) != 0)
      throw std::runtime_error("no port for the cable");
    port = ntohs(address.sin_port);
  }

  void turn() {
    if (is_pulled) {
      std::this_thread::sleep_for(std::chrono::milliseconds(kTickMs));
      return;
    }
    std::vector<pollfd> wanted{{.fd = listener, .events = POLLIN, .revents = 0}};
    for (const Link& link : links) {
      wanted.push_back({.fd = link.client, .events = POLLIN, .revents = 0});
      wanted.push_back({.fd = link.database, .events = POLLIN, .revents = 0});
    }
    ::poll(wanted.data(), wanted.size(), kTickMs);
    if (is_pulled) return;
    const std::uint64_t limit = rate;
    up.begin_turn(static_cast<double>(limit));
    down.begin_turn(static_cast<double>(limit));
    if (limit > 0) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));  // what waits is there to be read
      if (!links.empty()) std::rotate(links.begin(), links.begin() + 1, links.end());
    }
    for (Link& link : links) {
      if (pass(link.client, link.database, up) && pass(link.database, link.client, down)) continue;
      ::close(link.client);
      ::close(link.database);
      link = {};
    }
    std::erase_if(links, [](const Link& link) { return link.client < 0; });
    if ((wanted.front().revents & POLLIN) == 0) return;
    const int client = ::accept4(listener, nullptr, nullptr, SOCK_CLOEXEC);
    const int database = client < 0 ? -1 : connect_to(path);
    if (database >= 0) {
      links.push_back({client, database});
    } else if (client >= 0) {
      ::close(client);
    }
  }

  ~Pump() {
    thread = {};
    for (const Link& link : links) {
      ::close(link.client);
      ::close(link.database);
    }
    ::close(listener);
  }
};

DatabaseCable::DatabaseCable(const std::string& url) : pump_(new Pump) {
  const auto name = url.find("@/") + 2;
  const auto query = url.find("?host=");
  pump_->path = url.substr(query + 6) + "/.s.PGSQL.5432";
  pump_->listen();
  url_ = fmt::format("postgresql://dripline@127.0.0.1:{}/{}?sslmode=disable", pump_->port,
                     url.substr(name, query - name));
  pump_->thread = std::jthread([raw = pump_.get()](const std::stop_token& stop) {
    while (!stop.stop_requested()) raw->turn();
  });
}

DatabaseCable::~DatabaseCable() = default;

void DatabaseCable::pull() {
  pump_->is_pulled = true;
}

void DatabaseCable::set_rate(std::uint64_t bytes_per_second) {
  pump_->rate = bytes_per_second;
}

void DatabaseCable::plug() {
  pump_->is_pulled = false;
}

}  // namespace dripline::test
