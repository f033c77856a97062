#include "gateway/app/panel/panel_socket.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>
#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <ctime>
#include <map>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "gateway/app/panel/shortage.hpp"
#include "protocol/base/descriptor.hpp"

namespace dripline::gateway {
namespace {

constexpr std::size_t kMaxAnswers = 16 * 1024;  ///< bytes that a connection does not read
constexpr int kBacklog = 8;

/// Of the computer, also while it is suspended.
using BootTime = std::chrono::milliseconds;
BootTime boot_now() {
  timespec now{};
  ::clock_gettime(CLOCK_BOOTTIME, &now);
  return std::chrono::duration_cast<BootTime>(std::chrono::seconds(now.tv_sec) +
                                              std::chrono::nanoseconds(now.tv_nsec));
}

/// The socket's thread looks so often, also when nothing comes: what it finds then is not older
/// than its last look, unless the process was frozen meanwhile.
constexpr BootTime kLook{500};

/// A socket's address has room for about a hundred bytes, a path may be longer: the folder is
/// named by a descriptor.
Result<sockaddr_un> address_in(const Descriptor& folder) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string path = fmt::format("/proc/self/fd/{}/{}", folder.get(), PanelSocket::kName);
  if (path.size() >= sizeof address.sun_path) return fail(Errc::Io, "{} is too long", path);
  std::memcpy(address.sun_path, path.c_str(), path.size() + 1);
  return address;
}

Descriptor open_folder(const std::filesystem::path& folder) {
  return Descriptor(::open(folder.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
}

const sockaddr* generic(const sockaddr_un& address) {
  return reinterpret_cast<const sockaddr*>(&address);
}

/// With its requests: they see that the other end has closed it.
class Socket {
 public:
  explicit Socket(Descriptor accepted) : descriptor_(std::move(accepted)) {}
  int get() const { return descriptor_.get(); }
  bool is_closed() const { return (events(0) & (POLLHUP | POLLERR)) != 0; }
  bool is_readable() const { return events(POLLIN) != 0; }

 private:
  int events(short wanted) const {
    pollfd polled{get(), wanted, 0};
    return ::poll(&polled, 1, 0) > 0 ? polled.revents : 0;
  }
  Descriptor descriptor_;
};

/// Empty: who sent a request after `silent_at` waits for its answer.
std::string why_late(const Socket& socket, BootTime silent_at) {
  const BootTime age = boot_now() - silent_at;
  if (socket.is_closed()) return "its sender waits no longer";
  if (age <= PanelSocket::kMaxAge) return {};
  return fmt::format(
      "it may be {:.1f} s old, more than {} s", std::chrono::duration<double>(age).count(),
      std::chrono::duration_cast<std::chrono::seconds>(PanelSocket::kMaxAge).count());
}

struct Connection {
  std::shared_ptr<Socket> socket;
  BootTime silent_at{};  ///< nothing that is not taken had come from it by then
  std::string received, to_send;
  bool is_asking = false;  ///< its last request is not answered yet
  bool is_closing = false;
  std::uint64_t last_heard = 0;
};

/// Answers from the gateway's thread that are not sent yet; requests keep it alive.
struct Answers {
  std::mutex mutex;
  std::vector<std::pair<std::uint64_t, std::string>> waiting;
  Descriptor wake;

  void give(std::uint64_t connection, std::string line) {
    const std::lock_guard lock(mutex);
    waiting.emplace_back(connection, std::move(line));
    signal();
  }
  void signal() const {
    const std::uint64_t one = 1;
    [[maybe_unused]] const auto written = ::write(wake.get(), &one, sizeof one);
  }
};

/// The first whole line, which is taken off; nothing: there is none.
std::optional<std::string> take_line(std::string& received) {
  const std::size_t end = received.find('\n');
  if (end == std::string::npos) return std::nullopt;
  std::string line = received.substr(0, end);
  received.erase(0, end + 1);
  if (!line.empty() && line.back() == '\r') line.pop_back();
  return line;
}

Result<Descriptor> listen_at(const std::filesystem::path& folder) {
  const auto refused = [&](const char* what) {
    return fail(Errc::Io, "panel socket in {}: {}: {}", folder.string(), what,
                std::generic_category().message(errno));
  };
  const Descriptor place = open_folder(folder);
  if (!place) return refused("folder");
  const auto address = address_in(place);
  if (!address) return fail(address.error());
  Descriptor socket(::socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  if (!socket) return refused("socket");
  ::unlinkat(place.get(), PanelSocket::kName,
             0);  // left by a former process; this one has locked the folder
  if (::fchmod(socket.get(), S_IRUSR | S_IWUSR) != 0)
    return refused("mode");  // in force when bound
  if (::bind(socket.get(), generic(*address), sizeof *address) != 0) return refused("bind");
  if (::fchmodat(place.get(), PanelSocket::kName, S_IRUSR | S_IWUSR, 0) != 0)
    return refused("mode");
  if (::listen(socket.get(), kBacklog) != 0) return refused("listen");
  return socket;
}

}  // namespace

class PanelSocket::Server {
 public:
  Server(Descriptor listening, std::function<void(PanelRequest)> on_request,
         std::shared_ptr<Answers> answers)
      : listening_(std::move(listening)),
        on_request_(std::move(on_request)),
        answers_(std::move(answers)),
        thread_([this] { serve(); }) {}
  ~Server() {
    is_stopping_ = true;
    answers_->signal();
    thread_.join();
  }
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

 private:
  void serve();
  void accept_one();
  void take_answers();
  void read(std::uint64_t id, Connection& connection);
  void ask(std::uint64_t id, Connection& connection);
  void close_idle();
  void hang_up(Connection& connection) const;
  static void close(const Connection& connection);
  void reply(Connection& connection, const std::string& line) const;
  void send(Connection& connection) const;

  Descriptor listening_;
  std::function<void(PanelRequest)> on_request_;
  std::shared_ptr<Answers> answers_;
  std::map<std::uint64_t, Connection> connections_;
  std::uint64_t last_id_ = 0, clock_ = 0;
  BootTime silent_at_ = boot_now();  ///< no new connection waited then
  Shortage shortage_;
  std::atomic<bool> is_stopping_{false};
  std::thread thread_;  ///< last: it uses all of the above
};

void PanelSocket::Server::serve() {
  while (!is_stopping_) {
    const BootTime looked = boot_now();
    std::vector<pollfd> polled{{listening_.get(), POLLIN, 0}, {answers_->wake.get(), POLLIN, 0}};
    std::vector<std::uint64_t> ids;
    for (const auto& [id, connection] : connections_) {
      const bool may_read = !connection.is_asking && !connection.is_closing;
      const int events = (may_read ? POLLIN : 0) | (connection.to_send.empty() ? 0 : POLLOUT);
      polled.push_back({connection.socket->get(), static_cast<short>(events), 0});
      ids.push_back(id);
    }
    if (::poll(polled.data(), polled.size(), static_cast<int>(kLook.count())) < 0) {
      if (errno != EINTR) shortage_.wait_out("poll");
      continue;  // nothing was looked at
    }
    for (std::size_t i = 0; i < ids.size(); ++i) {
      Connection& connection = connections_.at(ids[i]);
      const short events = polled[i + 2].revents;
      if ((events & POLLOUT) != 0) send(connection);
      const bool is_silent = (polled[i + 2].events & POLLIN) != 0 && (events & POLLIN) == 0;
      if (is_silent && connection.received.empty()) connection.silent_at = looked;
      if ((events & POLLIN) != 0) read(ids[i], connection);
      const bool is_gone = (events & (POLLERR | POLLNVAL)) != 0 ||
                           ((events & POLLHUP) != 0 && (events & POLLIN) == 0);
      if (is_gone) hang_up(connection);
    }
    if (polled[1].revents != 0) take_answers();
    std::erase_if(connections_, [](const auto& entry) {
      const bool is_over = entry.second.is_closing && entry.second.to_send.empty();
      if (is_over) close(entry.second);
      return is_over;
    });
    if (polled[0].revents != 0)
      accept_one();
    else
      silent_at_ = looked;
  }
}

void PanelSocket::Server::accept_one() {
  Descriptor socket(::accept4(listening_.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
  if (!socket && errno != EAGAIN && errno != EINTR && errno != ECONNABORTED)
    shortage_.wait_out("accept");  // it still waits to be accepted
  if (!socket) return;
  if (connections_.size() >= kMaxConnections) close_idle();
  Connection& connection = connections_[++last_id_];
  connection.socket = std::make_shared<Socket>(std::move(socket));
  connection.silent_at = silent_at_;
  connection.last_heard = ++clock_;
}

void PanelSocket::Server::close_idle() {
  const auto idle = std::min_element(
      connections_.begin(), connections_.end(),
      [](const auto& a, const auto& b) { return a.second.last_heard < b.second.last_heard; });
  hang_up(idle->second);
  close(idle->second);
  connections_.erase(idle);
}

/// It gets no answer, but the stops that it has sent take effect.
void PanelSocket::Server::hang_up(Connection& connection) const {
  if (connection.is_closing) return;
  constexpr std::size_t kMost = 16 * (kMaxPanelLine + 1);
  char bytes[512];
  while (connection.received.size() < kMost) {
    const auto count = ::read(connection.socket->get(), bytes, sizeof bytes);
    if (count <= 0) break;
    connection.received.append(bytes, static_cast<std::size_t>(count));
  }
  while (auto line = take_line(connection.received)) {
    auto command = parse_panel_command(*line);
    if (command && is_stop(*command))
      on_request_({.command = *std::move(command), .answer = [](const std::string&) {}});
  }
  connection.is_closing = true;
  connection.to_send.clear();
}

/// A request of it may be open, and have the socket: the other end sees now that it is over.
void PanelSocket::Server::close(const Connection& connection) {
  ::shutdown(connection.socket->get(), SHUT_RDWR);
}

void PanelSocket::Server::take_answers() {
  std::uint64_t count = 0;
  [[maybe_unused]] const auto drained = ::read(answers_->wake.get(), &count, sizeof count);
  std::vector<std::pair<std::uint64_t, std::string>> answers;
  {
    const std::lock_guard lock(answers_->mutex);
    answers.swap(answers_->waiting);
  }
  for (const auto& [id, line] : answers) {
    const auto found = connections_.find(id);
    if (found == connections_.end()) continue;  // it was closed
    found->second.is_asking = false;
    // What comes from now on was not sent while the answer was awaited.
    const BootTime looked = boot_now();
    if (found->second.received.empty() && !found->second.socket->is_readable())
      found->second.silent_at = looked;
    reply(found->second, line);
    ask(id, found->second);  // its next line may be here already
  }
}

void PanelSocket::Server::read(std::uint64_t id, Connection& connection) {
  char bytes[512];
  const auto count = ::read(connection.socket->get(), bytes, sizeof bytes);
  if (count < 0 && (errno == EAGAIN || errno == EINTR)) return;
  if (count <= 0) return hang_up(connection);
  connection.last_heard = ++clock_;
  connection.received.append(bytes, static_cast<std::size_t>(count));
  ask(id, connection);
}

/// Hands on the first whole line. A line that cannot be understood is answered here.
void PanelSocket::Server::ask(std::uint64_t id, Connection& connection) {
  while (!connection.is_asking && !connection.is_closing) {
    const auto line = take_line(connection.received);
    if (!line) {
      if (connection.received.size() <= kMaxPanelLine + 1) return;
      reply(connection, fmt::format("refused a line of more than {} bytes", kMaxPanelLine));
      connection.is_closing = true;
      return;
    }
    auto command = parse_panel_command(*line);
    if (!command) {
      reply(connection, "refused " + command.error().what);
      continue;
    }
    connection.is_asking = true;
    on_request_(
        {.command = *std::move(command),
         .answer = [answers = answers_,
                    id](std::string answer) { answers->give(id, std::move(answer)); },
         .why_late =
             [socket = std::weak_ptr<Socket>(connection.socket), silent_at = connection.silent_at] {
               const auto open = socket.lock();
               return open ? why_late(*open, silent_at) : std::string("its sender waits no longer");
             }});
  }
}

void PanelSocket::Server::reply(Connection& connection, const std::string& line) const {
  if (connection.to_send.size() + line.size() + 1 > kMaxAnswers) return hang_up(connection);
  connection.to_send += line + "\n";
  send(connection);
}

void PanelSocket::Server::send(Connection& connection) const {
  const auto count = ::send(connection.socket->get(), connection.to_send.data(),
                            connection.to_send.size(), MSG_NOSIGNAL);
  if (count > 0) {
    connection.to_send.erase(0, static_cast<std::size_t>(count));
  } else if (errno != EAGAIN && errno != EINTR) {
    connection.to_send.clear();
    hang_up(connection);
  }
}

PanelSocket::PanelSocket(std::unique_ptr<Server> server) : server_(std::move(server)) {}
PanelSocket::~PanelSocket() = default;

Result<std::unique_ptr<PanelSocket>> PanelSocket::open(
    const std::filesystem::path& folder, std::function<void(PanelRequest)> on_request) {
  auto listening = listen_at(folder);
  if (!listening) return fail(listening.error());
  auto answers = std::make_shared<Answers>();
  answers->wake = Descriptor(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC));
  if (!answers->wake)
    return fail(Errc::Io, "panel socket: {}", std::generic_category().message(errno));
  return std::unique_ptr<PanelSocket>(new PanelSocket(
      std::make_unique<Server>(*std::move(listening), std::move(on_request), std::move(answers))));
}

Result<std::string> ask_panel(const std::filesystem::path& folder, const std::string& line) {
  constexpr int kAnswerMs = 5000;
  const Descriptor place = open_folder(folder);
  if (!place)
    return fail(Errc::NotFound, "{}: {}", folder.string(), std::generic_category().message(errno));
  const auto address = address_in(place);
  if (!address) return fail(address.error());
  const Descriptor socket(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
  if (!socket || ::connect(socket.get(), generic(*address), sizeof *address) != 0) {
    return fail(Errc::NotFound, "no gateway answers in {}: {}", folder.string(),
                std::generic_category().message(errno));
  }
  const std::string request = line + "\n";
  if (::send(socket.get(), request.data(), request.size(), MSG_NOSIGNAL) !=
      static_cast<ssize_t>(request.size()))
    return fail(Errc::Io, "panel of {}: {}", folder.string(),
                std::generic_category().message(errno));
  std::string answer;
  while (answer.find('\n') == std::string::npos && answer.size() < kMaxAnswers) {
    pollfd polled{socket.get(), POLLIN, 0};
    if (::poll(&polled, 1, kAnswerMs) <= 0)
      return fail(
          Errc::Timeout,
          "no answer from the gateway of {} within 5 s: when it answers again, a stop still "
          "takes effect, and nothing else does",
          folder.string());
    char bytes[512];
    const auto count = ::read(socket.get(), bytes, sizeof bytes);
    if (count <= 0) return fail(Errc::Io, "the gateway of {} closed the panel", folder.string());
    answer.append(bytes, static_cast<std::size_t>(count));
  }
  return answer.substr(0, answer.find('\n'));
}

}  // namespace dripline::gateway
