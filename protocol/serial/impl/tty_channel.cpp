#include "protocol/serial/impl/channels.hpp"

#include <fcntl.h>
#include <linux/serial.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <array>
#include <cerrno>
#include <filesystem>
#include <system_error>

#include "protocol/base/descriptor.hpp"
#include "protocol/serial/impl/port_lock.hpp"
#include "protocol/serial/impl/tty_settings.hpp"

namespace dripline::serial {
namespace {

/// A pty has neither rate nor parity: it always has 8 bits.
bool is_pty(int descriptor) {
  constexpr unsigned kFirst = 136, kLast = 143;  // major numbers of pty ends
  struct stat status {};
  if (::fstat(descriptor, &status) != 0) return false;
  const unsigned number = major(status.st_rdev);
  return number >= kFirst && number <= kLast;
}

/// The failure of a call on an open port. After a hang-up a read says "end of file" or EIO,
/// whichever comes first, and every other call says EIO: all are one thing to a user.
tl::unexpected<Error> lost(const std::string& path, int error) {
  return fail(
      Errc::Io, "{}: {}", path,
      error == 0 || error == EIO ? std::string("hung up") : std::generic_category().message(error));
}

class TtyChannel final : public Channel {
 public:
  TtyChannel(std::string path, Descriptor descriptor, PortLock lock, const termios& former)
      : path_(std::move(path)),
        descriptor_(std::move(descriptor)),
        lock_(std::move(lock)),
        former_(former),
        is_pty_(is_pty(descriptor_.get())) {
    has_counters_ = ::ioctl(descriptor_.get(), TIOCGICOUNT, &counters_) == 0;
  }
  ~TtyChannel() override {
    if (has_serial_flags_) ::ioctl(descriptor_.get(), TIOCSSERIAL, &serial_);
    ::tcsetattr(descriptor_.get(), TCSANOW, &former_);
  }

  Result<Received> read(std::span<std::byte> room) override;
  Result<std::size_t> write(std::span<const std::byte> bytes) override;
  std::optional<std::size_t> unsent() const override;
  Result<std::optional<wire::InputLines>> input_lines() override;
  Result<void> set_output_lines(wire::OutputLines lines) override;
  Result<void> apply(const wire::LineSettings& settings) override;
  int descriptor() const override { return descriptor_.get(); }
  std::string name() const override { return path_; }

 private:
  Result<void> fill_raw();
  wire::LineFault kind_of_fault();
  std::optional<wire::LineFault> overrun();
  void ask_for_low_latency();

  std::string path_;
  Descriptor descriptor_;
  PortLock lock_;  ///< released before the descriptor is closed
  termios former_;
  bool is_pty_;
  bool has_parity_ = false;
  std::array<std::uint8_t, 256> raw_{};
  std::size_t raw_begin_ = 0, raw_end_ = 0;
  ParityMarks marks_;
  serial_icounter_struct counters_{};
  bool has_counters_ = false;
  serial_struct serial_{};
  bool has_serial_flags_ = false;
};

Result<void> TtyChannel::fill_raw() {
  const ssize_t got = ::read(descriptor_.get(), raw_.data(), raw_.size());
  if (got > 0) {
    raw_begin_ = 0;
    raw_end_ = static_cast<std::size_t>(got);
    return {};
  }
  if (got < 0 && (errno == EAGAIN || errno == EINTR)) return {};
  return lost(path_, got == 0 ? 0 : errno);
}

Result<Received> TtyChannel::read(std::span<std::byte> room) {
  if (raw_begin_ == raw_end_) {
    if (const auto done = fill_raw(); !done) return fail(done.error());
  }
  Received received;
  while (raw_begin_ < raw_end_ && received.bytes < room.size()) {
    const auto item = marks_.feed(raw_[raw_begin_++]);
    if (!item) continue;
    if (const auto* faulty = std::get_if<ParityMarks::Faulty>(&*item)) {
      received.fault = faulty->is_break ? wire::LineFault::Break : kind_of_fault();
      return received;
    }
    room[received.bytes++] = std::byte{std::get<std::uint8_t>(*item)};
  }
  if (received.bytes > 0) received.fault = overrun();
  return received;
}

/// The mark does not distinguish parity from framing; the driver's counters do, where they exist.
wire::LineFault TtyChannel::kind_of_fault() {
  const auto otherwise = has_parity_ ? wire::LineFault::Parity : wire::LineFault::Framing;
  if (!has_counters_) return otherwise;
  serial_icounter_struct now{};
  if (::ioctl(descriptor_.get(), TIOCGICOUNT, &now) != 0) return otherwise;
  const bool is_framing = now.frame != counters_.frame, is_parity = now.parity != counters_.parity;
  counters_.frame = now.frame;
  counters_.parity = now.parity;
  if (is_framing == is_parity) return otherwise;
  return is_framing ? wire::LineFault::Framing : wire::LineFault::Parity;
}

/// Lost characters have no mark, only a count.
std::optional<wire::LineFault> TtyChannel::overrun() {
  if (!has_counters_) return std::nullopt;
  serial_icounter_struct now{};
  if (::ioctl(descriptor_.get(), TIOCGICOUNT, &now) != 0) return std::nullopt;
  const bool has_lost =
      now.overrun != counters_.overrun || now.buf_overrun != counters_.buf_overrun;
  counters_.overrun = now.overrun;
  counters_.buf_overrun = now.buf_overrun;
  return has_lost ? std::optional(wire::LineFault::Overrun) : std::nullopt;
}

Result<std::size_t> TtyChannel::write(std::span<const std::byte> bytes) {
  const ssize_t taken = ::write(descriptor_.get(), bytes.data(), bytes.size());
  if (taken >= 0) return static_cast<std::size_t>(taken);
  if (errno == EAGAIN || errno == EINTR) return std::size_t{0};
  return lost(path_, errno);
}

std::optional<std::size_t> TtyChannel::unsent() const {
  int count = 0;
  if (is_pty_ || ::ioctl(descriptor_.get(), TIOCOUTQ, &count) != 0 || count < 0)
    return std::nullopt;
  return static_cast<std::size_t>(count);
}

Result<std::optional<wire::InputLines>> TtyChannel::input_lines() {
  int bits = 0;
  if (::ioctl(descriptor_.get(), TIOCMGET, &bits) == 0) {
    return std::optional(wire::InputLines{.cts = (bits & TIOCM_CTS) != 0,
                                          .dsr = (bits & TIOCM_DSR) != 0,
                                          .dcd = (bits & TIOCM_CAR) != 0});
  }
  if (errno == EIO || errno == ENODEV) return lost(path_, errno);
  return std::optional<wire::InputLines>();
}

Result<void> TtyChannel::set_output_lines(wire::OutputLines lines) {
  int on = (lines.rts ? TIOCM_RTS : 0) | (lines.dtr ? TIOCM_DTR : 0);
  int off = (TIOCM_RTS | TIOCM_DTR) & ~on;
  const bool is_done = (on == 0 || ::ioctl(descriptor_.get(), TIOCMBIS, &on) == 0) &&
                       (off == 0 || ::ioctl(descriptor_.get(), TIOCMBIC, &off) == 0);
  if (is_done || (errno != EIO && errno != ENODEV)) return {};  // a pty has none
  return lost(path_, errno);
}

Result<void> TtyChannel::apply(const wire::LineSettings& settings) {
  termios wanted = former_;
  if (const auto done = fill_modes(settings, wanted); !done)
    return fail(done.error().code, "{}: {}", path_, done.error().what);
  // EINVAL: not all settings were applied; the difference is checked below.
  if (::tcsetattr(descriptor_.get(), TCSANOW, &wanted) != 0 && errno != EINVAL)
    return lost(path_, errno);
  termios got{};
  if (::tcgetattr(descriptor_.get(), &got) != 0) return lost(path_, errno);
  if (const std::string what = difference(wanted, got); !what.empty() && !is_pty_)
    return fail(Errc::Unsupported, "{}: the device does not take {} of {}", path_, what,
                wire::short_form(settings));
  has_parity_ = settings.parity != wire::Parity::None;
  ask_for_low_latency();
  return {};
}

/// Otherwise USB adapters delay input, an XOFF included, by up to 16 ms.
void TtyChannel::ask_for_low_latency() {
  if (has_serial_flags_ || ::ioctl(descriptor_.get(), TIOCGSERIAL, &serial_) != 0) return;
  serial_struct wanted = serial_;
  wanted.flags |= ASYNC_LOW_LATENCY;
  has_serial_flags_ = ::ioctl(descriptor_.get(), TIOCSSERIAL, &wanted) == 0;
}

tl::unexpected<Error> refusal(const std::string& path, int error) {
  if (error == ENOENT || error == ENODEV || error == ENXIO)
    return fail(Errc::NotFound, "{}: there is no such device", path);
  if (error == EBUSY) return fail(Errc::Busy, "{} is in use by {}", path, owner_of(path));
  if (error == EACCES || error == EPERM)
    return fail(Errc::Denied, "{}: not permitted; is this user in the group dialout?", path);
  return fail(Errc::Io, "{}: {}", path, std::generic_category().message(error));
}

}  // namespace

Result<std::unique_ptr<Channel>> open_tty(const std::string& path,
                                          const wire::LineSettings& settings) {
  std::error_code ec;
  const std::filesystem::path device = std::filesystem::canonical(path, ec);
  if (ec) return refusal(path, ec.value());
  Descriptor descriptor(::open(device.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  if (!descriptor) return refusal(path, errno);
  if (!::isatty(descriptor.get()))
    return fail(Errc::Unsupported, "{} is not a serial device", path);
  auto lock = PortLock::take(descriptor.get(), device);
  if (!lock) return fail(lock.error());
  termios former{};
  if (::tcgetattr(descriptor.get(), &former) != 0) return lost(path, errno);
  auto channel =
      std::make_unique<TtyChannel>(path, std::move(descriptor), std::move(*lock), former);
  if (const auto done = channel->apply(settings); !done) return fail(done.error());
  return std::unique_ptr<Channel>(std::move(channel));
}

}  // namespace dripline::serial
