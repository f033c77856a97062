#include "tests/support/line/test_line.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>
#include <array>
#include <atomic>
#include <cerrno>
#include <condition_variable>
#include <deque>
#include <optional>

#include "tests/support/patience.hpp"

namespace dripline::test_support {
namespace {

/// The test's settings for the characters; shared with the open channel.
struct Faults {
  std::mutex mutex;
  std::deque<wire::LineFault> waiting;
  std::optional<wire::LineFault> take() {
    const std::lock_guard lock(mutex);
    if (waiting.empty()) return std::nullopt;
    const auto fault = waiting.front();
    waiting.pop_front();
    return fault;
  }
};

class TestChannel final : public serial::Channel {
 public:
  TestChannel(int socket, std::shared_ptr<Faults> faults)
      : socket_(socket), faults_(std::move(faults)) {}
  ~TestChannel() override { ::close(socket_); }
  Result<serial::Received> read(std::span<std::byte> room) override {
    if (const auto fault = faults_->take()) return serial::Received{.bytes = 0, .fault = fault};
    const auto size = ::recv(socket_, room.data(), room.size(), MSG_DONTWAIT);
    if (size > 0) return serial::Received{.bytes = static_cast<std::size_t>(size), .fault = {}};
    if (size < 0 && errno == EAGAIN) return serial::Received{};
    return fail(Errc::Io, "the cable is pulled");
  }
  Result<std::size_t> write(std::span<const std::byte> bytes) override {
    const auto size = ::send(socket_, bytes.data(), bytes.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
    if (size >= 0) return static_cast<std::size_t>(size);
    if (errno == EAGAIN) return std::size_t{0};
    return fail(Errc::Io, "the cable is pulled");
  }
  std::optional<std::size_t> unsent() const override { return std::nullopt; }
  Result<std::optional<wire::InputLines>> input_lines() override { return wire::InputLines{}; }
  Result<void> set_output_lines(wire::OutputLines) override { return {}; }
  Result<void> apply(const wire::LineSettings&) override { return {}; }
  int descriptor() const override { return socket_; }
  std::string name() const override { return "test line"; }

 private:
  int socket_;
  std::shared_ptr<Faults> faults_;
};

}  // namespace

struct TestLine::Cable {
  ~Cable() {
    if (socket >= 0) ::close(socket);
  }
  std::mutex mutex;
  std::condition_variable changed;
  bool is_pulled = false;
  std::atomic<int> socket = -1;  ///< the control's end
  std::shared_ptr<Faults> faults = std::make_shared<Faults>();
};

TestLine::TestLine() : cable_(std::make_shared<Cable>()) {}
TestLine::~TestLine() = default;

Result<std::unique_ptr<serial::Channel>> TestLine::open() {
  const std::lock_guard lock(cable_->mutex);
  if (cable_->is_pulled) return fail(Errc::NotFound, "no cable");
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    return fail(Errc::Io, "no socket pair");
  }
  if (cable_->socket >= 0) ::close(cable_->socket);
  cable_->socket = ends[0];
  cable_->changed.notify_all();
  return std::unique_ptr<serial::Channel>(std::make_unique<TestChannel>(ends[1], cable_->faults));
}

bool TestLine::wait_open() {
  std::unique_lock lock(cable_->mutex);
  return cable_->changed.wait_for(lock, kPatience, [&] { return cable_->socket >= 0; });
}

std::string TestLine::read_for(std::chrono::milliseconds time) {
  std::string text;
  const auto end = std::chrono::steady_clock::now() + time;
  for (;;) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(
        end - std::chrono::steady_clock::now());
    pollfd entry{.fd = cable_->socket, .events = POLLIN, .revents = 0};
    if (left.count() <= 0 || ::poll(&entry, 1, static_cast<int>(left.count())) <= 0) return text;
    std::array<char, 4096> bytes{};
    const auto size = ::recv(cable_->socket, bytes.data(), bytes.size(), 0);
    if (size <= 0) return text;
    text.append(bytes.data(), static_cast<std::size_t>(size));
  }
}

std::string TestLine::read_until(std::string_view wanted) {
  std::string text;
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (text.find(wanted) == std::string::npos && std::chrono::steady_clock::now() < end) {
    text += read_for(std::chrono::milliseconds(5));
  }
  return text;
}

void TestLine::write(std::string_view text) {
  while (!text.empty()) {
    const auto size = ::send(cable_->socket, text.data(), text.size(), MSG_NOSIGNAL);
    if (size <= 0) return;
    text.remove_prefix(static_cast<std::size_t>(size));
  }
}

/// Told with the next characters, in front of them.
void TestLine::fault(wire::LineFault fault) {
  const std::lock_guard lock(cable_->faults->mutex);
  cable_->faults->waiting.push_back(fault);
}

void TestLine::pull() {
  const std::lock_guard lock(cable_->mutex);
  cable_->is_pulled = true;
  if (cable_->socket >= 0) ::close(cable_->socket);
  cable_->socket = -1;
}

void TestLine::put_back() {
  const std::lock_guard lock(cable_->mutex);
  cable_->is_pulled = false;
}

}  // namespace dripline::test_support
