#include "protocol/serial/impl/channels.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <algorithm>
#include <array>
#include <cerrno>
#include <deque>
#include <functional>
#include <system_error>

#include "protocol/serial/impl/tcp_socket.hpp"
#include "protocol/serial/rfc2217.hpp"

namespace dripline::serial {
namespace {

using Deadline = std::chrono::steady_clock::time_point;

class Rfc2217Channel final : public Channel {
 public:
  Rfc2217Channel(std::string name, Descriptor socket)
      : name_(std::move(name)), socket_(std::move(socket)) {}

  /// Before anything else.
  Result<void> negotiate(const wire::LineSettings& settings, Deadline end);

  Result<Received> read(std::span<std::byte> room) override;
  Result<std::size_t> write(std::span<const std::byte> bytes) override;
  std::optional<std::size_t> unsent() const override { return std::nullopt; }
  Result<std::optional<wire::InputLines>> input_lines() override { return lines_; }
  Result<void> set_output_lines(wire::OutputLines lines) override {
    return send_commands(output_line_commands(lines));
  }
  Result<void> apply(const wire::LineSettings& settings) override {
    return send_commands(setup_commands(settings));
  }
  int descriptor() const override { return socket_.get(); }
  std::string name() const override { return name_; }

 private:
  Result<void> fill_raw();
  /// Processes one raw byte; returns the character that it completed.
  std::optional<std::byte> digest(std::byte raw);
  void take(const AnswerSeen& seen);
  Result<void> send_commands(const std::vector<ComPortCommand>& commands);
  Result<void> flush();
  Result<void> wait_while(const std::function<bool()>& waits, const char* what, Deadline end);
  tl::unexpected<Error> lost(const std::string& why) const {
    return fail(Errc::Io, "{}: {}", name_, why);
  }

  /// Limit of commands in progress; a server that answers none of so many is gone.
  static constexpr std::size_t kMaxOutput = 16 * 1024;
  static constexpr std::size_t kMaxEarly = 4096;

  std::string name_;
  Descriptor socket_;
  Rfc2217Client client_;
  std::array<std::byte, 512> raw_{};
  std::size_t raw_begin_ = 0, raw_end_ = 0;
  std::vector<std::byte> output_;  ///< encoded, not yet accepted by the socket
  std::deque<std::byte> early_;    ///< characters that came while opening
  std::vector<ComPortCommand> unanswered_;
  std::vector<ComPortCommand> agreed_;  ///< rate and format
  std::string refused_;  ///< the settings that the server has changed, with those of ours
  std::optional<wire::LineFault> fault_;
  std::optional<wire::InputLines> lines_;
  std::optional<bool> is_supported_;
  bool is_suspended_ = false;
};

Result<void> Rfc2217Channel::fill_raw() {
  const ssize_t got = ::recv(socket_.get(), raw_.data(), raw_.size(), 0);
  if (got > 0) {
    raw_begin_ = 0;
    raw_end_ = static_cast<std::size_t>(got);
    return {};
  }
  if (got == 0) return lost("the other end closed the connection");
  if (errno == EAGAIN || errno == EINTR) return {};
  return lost(std::generic_category().message(errno));
}

std::optional<std::byte> Rfc2217Channel::digest(std::byte raw) {
  const auto event = client_.feed(raw);
  const auto replies = client_.take_replies();
  output_.insert(output_.end(), replies.begin(), replies.end());
  if (!event) return std::nullopt;
  if (const auto* character = std::get_if<std::byte>(&*event)) return *character;
  if (const auto* state = std::get_if<LineStateSeen>(&*event)) fault_ = state->fault;
  if (const auto* lines = std::get_if<wire::InputLines>(&*event)) lines_ = *lines;
  if (const auto* flow = std::get_if<FlowSeen>(&*event)) is_suspended_ = flow->is_suspended;
  if (const auto* answer = std::get_if<AnswerSeen>(&*event)) take(*answer);
  if (const auto* agreed = std::get_if<ComPortAgreed>(&*event)) {
    if (is_supported_.value_or(false) && !agreed->is_supported && refused_.empty())
      refused_ = "the device server offers RFC 2217 no longer: its rate and format are not known";
    is_supported_ = agreed->is_supported;
  }
  return std::nullopt;
}

/// Servers answer each command once, in order. Only rate and format must be as requested, also when
/// a server reports them later: characters of another rate would be others. It may change flow
/// control and masks.
void Rfc2217Channel::take(const AnswerSeen& seen) {
  const auto asked = std::find_if(
      unanswered_.begin(), unanswered_.end(),
      [&](const ComPortCommand& command) { return command.command == seen.answer.command; });
  const bool must_fit = seen.answer.command <= ComPort::SetStopSize;
  const auto agreed = std::find_if(
      agreed_.begin(), agreed_.end(),
      [&](const ComPortCommand& command) { return command.command == seen.answer.command; });
  if (asked == unanswered_.end()) {
    if (agreed != agreed_.end() && *agreed != seen.answer && refused_.empty())
      refused_ = fmt::format("the device server has {} now, {} was agreed", to_string(seen.answer),
                             to_string(*agreed));
    return;
  }
  if (must_fit && *asked != seen.answer && refused_.empty())
    refused_ = fmt::format("{} was asked for, the device server has {}", to_string(*asked),
                           to_string(seen.answer));
  if (agreed != agreed_.end())
    *agreed = *asked;
  else if (must_fit)
    agreed_.push_back(*asked);
  unanswered_.erase(asked);
}

Result<Received> Rfc2217Channel::read(std::span<std::byte> room) {
  Received received;
  while (!early_.empty() && received.bytes < room.size()) {
    room[received.bytes++] = early_.front();
    early_.pop_front();
  }
  if (received.bytes > 0) return received;
  if (raw_begin_ == raw_end_) {
    if (const auto done = fill_raw(); !done) return fail(done.error());
  }
  while (raw_begin_ < raw_end_ && received.bytes < room.size() && !fault_) {
    if (const auto character = digest(raw_[raw_begin_++])) room[received.bytes++] = *character;
  }
  received.fault = std::exchange(fault_, std::nullopt);
  if (!refused_.empty()) return fail(Errc::Io, "{}: {}", name_, refused_);
  if (const auto done = flush(); !done) return fail(done.error());
  return received;
}

Result<std::size_t> Rfc2217Channel::write(std::span<const std::byte> bytes) {
  if (!refused_.empty()) return fail(Errc::Io, "{}: {}", name_, refused_);
  if (const auto done = flush(); !done) return fail(done.error());
  if (!output_.empty() || is_suspended_) return std::size_t{0};
  client_.encode(bytes, output_);
  if (const auto done = flush(); !done) return fail(done.error());
  return bytes.size();
}

Result<void> Rfc2217Channel::send_commands(const std::vector<ComPortCommand>& commands) {
  for (const ComPortCommand& command : commands) {
    Rfc2217Client::encode(command, output_);
    if (unanswered_.size() < kMaxEarly) unanswered_.push_back(command);
  }
  return flush();
}

Result<void> Rfc2217Channel::flush() {
  while (!output_.empty()) {
    const ssize_t taken = ::send(socket_.get(), output_.data(), output_.size(), MSG_NOSIGNAL);
    if (taken < 0 && errno == EINTR) continue;
    if (taken < 0 && errno == EAGAIN) break;
    if (taken < 0) return lost(std::generic_category().message(errno));
    output_.erase(output_.begin(), output_.begin() + taken);
  }
  if (output_.size() > kMaxOutput) return lost("the device server takes no more characters");
  return {};
}

Result<void> Rfc2217Channel::wait_while(const std::function<bool()>& waits, const char* what,
                                        Deadline end) {
  while (waits()) {
    if (raw_begin_ == raw_end_) {
      if (!wait_for(socket_.get(), POLLIN, end))
        return fail(Errc::Timeout, "{}: no answer to {}", name_, what);
      if (const auto done = fill_raw(); !done) return done;
    }
    while (raw_begin_ < raw_end_ && waits()) {
      const auto character = digest(raw_[raw_begin_++]);
      if (character && early_.size() < kMaxEarly) early_.push_back(*character);
    }
    if (const auto done = flush(); !done) return done;
  }
  return {};
}

Result<void> Rfc2217Channel::negotiate(const wire::LineSettings& settings, Deadline end) {
  output_ = client_.take_replies();
  if (const auto done = flush(); !done) return done;
  auto done = wait_while([this] { return !is_supported_; }, "the telnet com port option", end);
  if (!done) return done;
  if (!*is_supported_)
    return fail(Errc::Unsupported, "{}: this server does not offer RFC 2217", name_);
  if (const auto sent = send_commands(setup_commands(settings)); !sent) return sent;
  done = wait_while(
      [this] {
        return std::any_of(unanswered_.begin(), unanswered_.end(), [](const auto& command) {
          return command.command <= ComPort::SetStopSize;
        });
      },
      "the line's settings", end);
  if (!done) return done;
  if (!refused_.empty()) return fail(Errc::Unsupported, "{}: {}", name_, refused_);
  return {};
}

}  // namespace

Result<std::unique_ptr<Channel>> open_rfc2217(const std::string& name, const TcpAddress& address,
                                              const wire::LineSettings& settings,
                                              std::chrono::milliseconds limit) {
  const Deadline end = std::chrono::steady_clock::now() + limit;
  auto socket = connect_tcp(address, limit, look_up);
  if (!socket) return fail(socket.error());
  auto channel = std::make_unique<Rfc2217Channel>(name, std::move(*socket));
  if (const auto done = channel->negotiate(settings, end); !done) return fail(done.error());
  return std::unique_ptr<Channel>(std::move(channel));
}

}  // namespace dripline::serial
