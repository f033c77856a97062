#include "tests/support/line/faulty_channel.hpp"

#include <algorithm>
#include <array>

namespace dripline::test_support {

Result<serial::Received> FaultyChannel::read(std::span<std::byte> room) {
  if (control_->is_unplugged) return fail(Errc::Io, "{}: hung up", name());
  serial::Received received;
  if (waiting_.empty()) {
    std::array<std::byte, 256> piece;
    auto got = inner_->read(piece);
    if (!got) return got;
    waiting_.assign(piece.begin(), piece.begin() + static_cast<std::ptrdiff_t>(got->bytes));
    received.fault = got->fault;
  }
  std::size_t used = 0;
  for (; used < waiting_.size() && received.bytes + 2 <= room.size(); ++used) {
    if (happens(rates_.drop)) continue;
    if (happens(rates_.parity) || happens(rates_.line_break)) {
      received.fault = happens(0.5) ? wire::LineFault::Parity : wire::LineFault::Break;
      if (rates_.line_break == 0) received.fault = wire::LineFault::Parity;
      if (rates_.parity == 0) received.fault = wire::LineFault::Break;
      ++used;
      break;
    }
    std::byte character = waiting_[used];
    if (happens(rates_.flip)) character ^= std::byte{1} << static_cast<int>(random_() % 7);
    room[received.bytes++] = character;
    if (happens(rates_.twice)) room[received.bytes++] = character;
  }
  waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(used));
  // Dropping all of a piece must not look like "nothing more".
  if (received.bytes == 0 && !received.fault && used > 0) return read(room);
  return received;
}

Result<std::size_t> FaultyChannel::write(std::span<const std::byte> bytes) {
  if (control_->is_unplugged) return fail(Errc::Io, "{}: hung up", name());
  if (control_->is_stuck) return std::size_t{0};
  return inner_->write(bytes);
}

Result<std::optional<wire::InputLines>> FaultyChannel::input_lines() {
  return std::optional(wire::InputLines{.cts = control_->cts, .dsr = true, .dcd = true});
}

Result<void> FaultyChannel::set_output_lines(wire::OutputLines lines) {
  control_->rts = lines.rts;
  return inner_->set_output_lines(lines);
}

}  // namespace dripline::test_support
