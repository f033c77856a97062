#include "protocol/serial/impl/tty_settings.hpp"

#include <array>

namespace dripline::serial {

namespace {

struct Rate {
  unsigned baud;
  speed_t code;
};
constexpr std::array kRates{
    Rate{50, B50},         Rate{75, B75},         Rate{110, B110},        Rate{134, B134},
    Rate{150, B150},       Rate{200, B200},       Rate{300, B300},        Rate{600, B600},
    Rate{1200, B1200},     Rate{1800, B1800},     Rate{2400, B2400},      Rate{4800, B4800},
    Rate{9600, B9600},     Rate{19200, B19200},   Rate{38400, B38400},    Rate{57600, B57600},
    Rate{115200, B115200}, Rate{230400, B230400}, Rate{460800, B460800},  Rate{500000, B500000},
    Rate{576000, B576000}, Rate{921600, B921600}, Rate{1000000, B1000000}};

Result<speed_t> code_of(unsigned baud) {
  for (const Rate& rate : kRates) {
    if (rate.baud == baud) return rate.code;
  }
  return fail(Errc::Unsupported,
              "baud {} is not a standard rate: 50 75 110 134 150 200 300 600 1200 1800 2400 4800 "
              "9600 19200 38400 57600 115200 230400 460800 500000 576000 921600 1000000",
              baud);
}

tcflag_t parity_flags(wire::Parity parity) {
  constexpr tcflag_t kFlags[] = {0, PARENB, PARENB | PARODD, PARENB | PARODD | CMSPAR,
                                 PARENB | CMSPAR};
  return kFlags[static_cast<std::size_t>(parity)];
}

}  // namespace

Result<void> fill_modes(const wire::LineSettings& settings, termios& modes) {
  const auto rate = code_of(settings.baud);
  if (!rate) return fail(rate.error());
  if (settings.data_bits != 7 && settings.data_bits != 8)
    return fail(Errc::Unsupported, "data_bits {}: a tty line here has 7 or 8", settings.data_bits);
  if (settings.stop_bits == wire::StopBits::OneAndHalf)
    return fail(Errc::Unsupported, "stop_bits 1.5: a tty has 1 or 2 with {} data bits",
                settings.data_bits);
  ::cfmakeraw(&modes);
  modes.c_iflag = INPCK | PARMRK;
  modes.c_cflag &= ~static_cast<tcflag_t>(CSIZE | CSTOPB | PARENB | PARODD | CMSPAR | CRTSCTS);
  modes.c_cflag |= CLOCAL | CREAD | parity_flags(settings.parity);
  modes.c_cflag |= settings.data_bits == 7 ? CS7 : CS8;
  if (settings.stop_bits == wire::StopBits::Two) modes.c_cflag |= CSTOPB;
  modes.c_cc[VMIN] = 1;  // so that reading 0 bytes means a hang-up and nothing else
  modes.c_cc[VTIME] = 0;
  ::cfsetispeed(&modes, *rate);
  ::cfsetospeed(&modes, *rate);
  return {};
}

std::string difference(const termios& wanted, const termios& got) {
  if (::cfgetospeed(&wanted) != ::cfgetospeed(&got)) return "baud";
  const tcflag_t differing = wanted.c_cflag ^ got.c_cflag;
  if ((differing & CSIZE) != 0) return "data_bits";
  if ((differing & (PARENB | PARODD | CMSPAR)) != 0) return "parity";
  if ((differing & CSTOPB) != 0) return "stop_bits";
  return {};
}

std::optional<ParityMarks::Item> ParityMarks::feed(std::uint8_t byte) {
  constexpr std::uint8_t kMark = 0xFF;
  switch (state_) {
    case State::Plain:
      if (byte != kMark) return Item(byte);
      state_ = State::Marked;
      return std::nullopt;
    case State::Marked:
      state_ = byte == 0 ? State::Faulty : State::Plain;
      // Any byte but 0x00 is itself; the kernel sends only 0xFF here.
      return byte == 0 ? std::nullopt : std::optional<Item>(byte);
    case State::Faulty:
      state_ = State::Plain;
      return Item(Faulty{byte, byte == 0});
  }
  return std::nullopt;
}

}  // namespace dripline::serial
