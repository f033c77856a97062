#include "protocol/serial/impl/parity_marks.hpp"

namespace dripline::serial {

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
