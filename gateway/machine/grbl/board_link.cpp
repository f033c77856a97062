#include "gateway/machine/grbl/board_link.hpp"

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <chrono>
#include <span>

#include "gateway/machine/grbl/grbl_machine.hpp"
#include "protocol/base/invariant.hpp"
#include "protocol/serial/channel.hpp"

namespace dripline::machine::grbl {

using namespace std::chrono_literals;

namespace {

constexpr auto kOpenLimit = 2000ms;
constexpr auto kReopenAfter = 1000ms;
constexpr int kTickMs = 5;
constexpr int kReadsPerTurn = 16;  ///< a board that floods the line must not delay a hold
constexpr auto kLastWords = 500ms;

/// One open line with what is still to be written. Real-time bytes overtake lines.
class Wire {
 public:
  explicit Wire(std::unique_ptr<serial::Channel> channel) : channel_(std::move(channel)) {}
  int descriptor() const { return channel_->descriptor(); }
  bool has_pending() const { return !real_time_.empty() || !lines_.empty(); }
  bool has_real_time() const { return !real_time_.empty(); }

  /// Errors: Io, the line is gone.
  Result<void> exchange(GrblMachine& machine) {
    std::array<std::byte, 1024> room;
    for (int i = 0; i < kReadsPerTurn; ++i) {
      const auto got = channel_->read(room);
      if (!got) return fail(got.error());
      take(machine.exchange(std::span(room).first(got->bytes)));
      if (got->bytes == 0 && !got->fault) break;
    }
    if (auto done = write(real_time_); !done || !real_time_.empty()) return done;
    return write(lines_);
  }

 private:
  void take(const BoardOutput& output) {
    if (output.drops_lines) lines_.clear();
    real_time_ += output.real_time;
    lines_ += output.lines;
  }
  Result<void> write(std::string& bytes) {
    if (bytes.empty()) return {};
    const auto taken = channel_->write(std::as_bytes(std::span(bytes)));
    if (!taken) return fail(taken.error());
    bytes.erase(0, *taken);
    return {};
  }

  std::unique_ptr<serial::Channel> channel_;
  std::string real_time_, lines_;
};

}  // namespace

Result<BoardAddress> parse_board_address(std::string_view text) {
  const std::size_t comma = text.find(',');
  BoardAddress address;
  address.channel = text.substr(0, comma);
  address.settings.baud = 115'200;
  address.settings.flow = wire::Flow::None;
  if (const auto parsed = serial::parse_address(address.channel); !parsed)
    return fail(parsed.error());
  if (comma == std::string_view::npos) return address;
  std::string form(text.substr(comma + 1));
  const bool is_number =
      std::all_of(form.begin(), form.end(), [](char c) { return c >= '0' && c <= '9'; });
  if (is_number) form += "n81";
  if (const auto done = wire::apply_short_form(form, address.settings); !done)
    return fail(done.error());
  return address;
}

BoardLink::BoardLink(GrblMachine& machine, std::string address)
    : machine_(machine),
      address_(std::move(address)),
      wake_(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
  invariant(wake_ >= 0, "an eventfd");
  thread_ = std::thread(&BoardLink::run, this);
}

BoardLink::~BoardLink() {
  stops_ = true;
  wake();
  thread_.join();
  ::close(wake_);
}

void BoardLink::wake() {
  const std::uint64_t one = 1;
  (void)!::write(wake_, &one, sizeof one);
}

void BoardLink::run() {
  std::optional<Wire> wire;
  auto next_open = std::chrono::steady_clock::now();
  const auto address = parse_board_address(address_);
  const auto lose = [&](const std::string& reason) {
    wire.reset();
    machine_.line_lost(reason);
    next_open = std::chrono::steady_clock::now() + kReopenAfter;
  };
  if (!address) return machine_.line_lost(address.error().what);
  while (!stops_) {
    if (!wire && machine_.may_open() && std::chrono::steady_clock::now() >= next_open) {
      auto channel = serial::open_channel(address->channel, address->settings, kOpenLimit);
      if (channel) {
        wire.emplace(std::move(*channel));
        machine_.line_opened();
      } else {
        lose(channel.error().what);
      }
    }
    std::array<pollfd, 2> entries{pollfd{wake_, POLLIN, 0},
                                  pollfd{wire ? wire->descriptor() : -1, POLLIN, 0}};
    if (wire && wire->has_pending()) entries[1].events |= POLLOUT;
    (void)::poll(entries.data(), entries.size(), wire ? kTickMs : 50);
    std::uint64_t count = 0;
    (void)!::read(wake_, &count, sizeof count);
    if (!wire) continue;
    if (const auto done = wire->exchange(machine_); !done) {
      lose(done.error().what);
    } else if (const std::string reason = machine_.reopen_reason(); !reason.empty()) {
      lose(reason);
    }
  }
  // What the board has must not go on without its gateway: a feed hold is the last thing it hears.
  if (!wire) return;
  machine_.line_closing();
  const auto limit = std::chrono::steady_clock::now() + kLastWords;
  while (wire->exchange(machine_) && wire->has_real_time() &&
         std::chrono::steady_clock::now() < limit) {
    pollfd entry{wire->descriptor(), POLLOUT, 0};
    (void)::poll(&entry, 1, kTickMs);
  }
}

}  // namespace dripline::machine::grbl
