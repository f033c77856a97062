#include "protocol/serial/rfc2217.hpp"

namespace dripline::serial {
namespace {

// RFC 854
constexpr std::uint8_t kSubEnd = 240, kSub = 250, kWill = 251, kWont = 252, kDo = 253, kDont = 254,
                       kIac = 255;
// RFC 856, 858, 2217
constexpr std::uint8_t kBinary = 0, kSuppressGoAhead = 3, kComPort = 44;
constexpr std::uint8_t kServerOffset = 100;
constexpr std::uint8_t kCr = 13;

bool is_wanted(std::uint8_t option, bool is_ours) {
  return option == kBinary || option == kSuppressGoAhead || (is_ours && option == kComPort);
}

std::size_t width_of(ComPort command) {
  if (command == ComPort::SetBaudRate) return 4;
  const bool is_bare = command == ComPort::FlowSuspend || command == ComPort::FlowResume ||
                       command == ComPort::Signature;
  return is_bare ? 0 : 1;
}

void append(std::vector<std::byte>& to, std::uint8_t value) {
  to.push_back(std::byte{value});
  if (value == kIac) to.push_back(std::byte{value});
}

/// One fault for each notice; the most severe when there are several.
LineStateSeen line_state(std::uint32_t bits) {
  constexpr std::uint32_t kOverrun = 2, kParity = 4, kFraming = 8, kBreak = 16;
  if ((bits & kBreak) != 0) return {wire::LineFault::Break};
  if ((bits & kOverrun) != 0) return {wire::LineFault::Overrun};
  if ((bits & kFraming) != 0) return {wire::LineFault::Framing};
  if ((bits & kParity) != 0) return {wire::LineFault::Parity};
  return {};
}

wire::InputLines modem_state(std::uint32_t bits) {
  constexpr std::uint32_t kCts = 16, kDsr = 32, kDcd = 128;
  return {.cts = (bits & kCts) != 0, .dsr = (bits & kDsr) != 0, .dcd = (bits & kDcd) != 0};
}

}  // namespace

Rfc2217Client::Rfc2217Client() {
  sub_.reserve(kMaxSub);
  for (const std::uint8_t option : {kBinary, kSuppressGoAhead}) {
    ours_[option] = theirs_[option] = Switch::Asked;
    reply(kWill, option);
    reply(kDo, option);
  }
  ours_[kComPort] = Switch::Asked;
  reply(kWill, kComPort);
}

void Rfc2217Client::reply(std::uint8_t verb, std::uint8_t option) {
  for (const std::uint8_t byte : {kIac, verb, option}) replies_.push_back(std::byte{byte});
}

std::optional<TelnetEvent> Rfc2217Client::feed(std::byte byte) {
  const auto value = std::to_integer<std::uint8_t>(byte);
  switch (state_) {
    case State::Data:
    case State::AfterCr:
      return on_data(value);
    case State::Command:
      return on_command(value);
    case State::Option:
      state_ = State::Data;
      return on_option(value);
    case State::Sub:
      if (value == kIac) {
        state_ = State::SubCommand;
      } else if (sub_.size() < kMaxSub) {
        sub_.push_back(value);
      } else {
        is_sub_too_long_ = true;
      }
      return std::nullopt;
    case State::SubCommand:
      if (value == kIac) {  // a doubled one is data
        state_ = State::Sub;
        if (sub_.size() < kMaxSub) sub_.push_back(value);
        return std::nullopt;
      }
      if (value == kSubEnd) return on_sub_end();
      sub_.clear();  // interrupted by another command
      return on_command(value);
  }
  return std::nullopt;
}

/// Without the binary option a CR is sent as CR NUL (RFC 854).
std::optional<TelnetEvent> Rfc2217Client::on_data(std::uint8_t byte) {
  const bool is_padding = state_ == State::AfterCr && byte == 0;
  state_ = State::Data;
  if (is_padding) return std::nullopt;
  if (byte == kIac) {
    state_ = State::Command;
    return std::nullopt;
  }
  if (byte == kCr && theirs_[kBinary] != Switch::On) state_ = State::AfterCr;
  return TelnetEvent(std::byte{byte});
}

std::optional<TelnetEvent> Rfc2217Client::on_command(std::uint8_t byte) {
  state_ = State::Data;
  if (byte == kIac) return TelnetEvent(std::byte{byte});
  if (byte >= kWill && byte <= kDont) {
    verb_ = byte;
    state_ = State::Option;
  } else if (byte == kSub) {
    sub_.clear();
    is_sub_too_long_ = false;
    state_ = State::Sub;
  }
  return std::nullopt;  // NOP, AYT and the like mean nothing to a line
}

std::optional<TelnetEvent> Rfc2217Client::on_option(std::uint8_t option) {
  const bool is_ours = verb_ == kDo || verb_ == kDont;
  const bool is_on = verb_ == kDo || verb_ == kWill;
  Switch& state = is_ours ? ours_[option] : theirs_[option];
  const Switch before = state;
  const bool is_agreed = is_on && is_wanted(option, is_ours);
  state = is_agreed ? Switch::On : Switch::Off;
  const bool was_asked = before == Switch::Asked;
  const bool needs_reply = is_agreed ? before == Switch::Off
                                     : is_on || before == Switch::On;  // refuse, or confirm the end
  if (needs_reply && !(was_asked && !is_on)) {
    const std::uint8_t yes = is_ours ? kWill : kDo, no = is_ours ? kWont : kDont;
    reply(is_agreed ? yes : no, option);
  }
  if (option == kComPort && is_ours && before != state) return ComPortAgreed{is_agreed};
  return std::nullopt;
}

std::optional<TelnetEvent> Rfc2217Client::on_sub_end() {
  state_ = State::Data;
  const auto sub = std::exchange(sub_, {});
  sub_.reserve(kMaxSub);
  if (is_sub_too_long_ || sub.size() < 2 || sub[0] != kComPort) return std::nullopt;
  const std::uint8_t code = sub[1];
  if (code < kServerOffset || code > kServerOffset + static_cast<std::uint8_t>(ComPort::PurgeData))
    return std::nullopt;
  const auto command = static_cast<ComPort>(code - kServerOffset);
  if (command == ComPort::Signature) return std::nullopt;  // a name, which is not used
  if (command == ComPort::FlowSuspend) return FlowSeen{true};
  if (command == ComPort::FlowResume) return FlowSeen{false};
  if (sub.size() != 2 + width_of(command)) return std::nullopt;
  std::uint32_t value = 0;
  for (std::size_t i = 2; i < sub.size(); ++i) value = value << 8 | sub[i];
  if (command == ComPort::NotifyLineState) return line_state(value);
  if (command == ComPort::NotifyModemState) return modem_state(value);
  return AnswerSeen{{command, value}};
}

void Rfc2217Client::encode(std::span<const std::byte> characters,
                           std::vector<std::byte>& to) const {
  for (const std::byte character : characters) {
    const auto value = std::to_integer<std::uint8_t>(character);
    append(to, value);
    if (value == kCr && ours_[kBinary] != Switch::On) to.push_back(std::byte{0});
  }
}

void Rfc2217Client::encode(const ComPortCommand& command, std::vector<std::byte>& to) {
  for (const std::uint8_t byte : {kIac, kSub, kComPort}) to.push_back(std::byte{byte});
  append(to, static_cast<std::uint8_t>(command.command));
  for (std::size_t left = width_of(command.command); left > 0; --left)
    append(to, static_cast<std::uint8_t>(command.value >> (8 * (left - 1)) & 0xFF));
  for (const std::uint8_t byte : {kIac, kSubEnd}) to.push_back(std::byte{byte});
}

std::vector<ComPortCommand> setup_commands(const wire::LineSettings& settings) {
  using enum ComPort;
  constexpr std::uint32_t kNoFlow = 1, kHardwareFlow = 3, kNoInboundFlow = 14,
                          kHardwareInboundFlow = 16, kFaults = 2 | 4 | 8 | 16, kAllLines = 255;
  const auto parity = [&]() -> std::uint32_t {
    constexpr std::uint32_t kCodes[] = {1, 3, 2, 4, 5};  // none, even, odd, mark, space
    return kCodes[static_cast<std::size_t>(settings.parity)];
  }();
  const bool is_hardware = wire::is_held_by_cts(settings);
  const std::uint32_t stop = settings.stop_bits == wire::StopBits::One   ? 1
                             : settings.stop_bits == wire::StopBits::Two ? 2
                                                                         : 3;
  return {{SetBaudRate, settings.baud},
          {SetDataSize, settings.data_bits},
          {SetParity, parity},
          {SetStopSize, stop},
          {SetControl, is_hardware ? kHardwareFlow : kNoFlow},
          {SetControl, is_hardware ? kHardwareInboundFlow : kNoInboundFlow},
          {SetLineStateMask, kFaults},
          {SetModemStateMask, kAllLines}};
}

std::vector<ComPortCommand> output_line_commands(wire::OutputLines lines) {
  constexpr std::uint32_t kDtrOn = 8, kDtrOff = 9, kRtsOn = 11, kRtsOff = 12;
  return {{ComPort::SetControl, lines.dtr ? kDtrOn : kDtrOff},
          {ComPort::SetControl, lines.rts ? kRtsOn : kRtsOff}};
}

std::string to_string(const ComPortCommand& command) {
  switch (command.command) {
    case ComPort::SetBaudRate:
      return fmt::format("baud {}", command.value);
    case ComPort::SetDataSize:
      return fmt::format("data_bits {}", command.value);
    case ComPort::SetParity: {
      constexpr std::array kNames{"?", "none", "odd", "even", "mark", "space"};
      return fmt::format("parity {}", kNames[command.value < kNames.size() ? command.value : 0]);
    }
    case ComPort::SetStopSize: {
      constexpr std::array kNames{"?", "1", "2", "1.5"};
      return fmt::format("stop_bits {}", kNames[command.value < kNames.size() ? command.value : 0]);
    }
    default:
      return fmt::format("com port command {} value {}", static_cast<int>(command.command),
                         command.value);
  }
}

}  // namespace dripline::serial
