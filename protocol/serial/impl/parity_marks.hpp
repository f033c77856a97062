#pragma once

#include <cstdint>
#include <optional>
#include <variant>

namespace dripline::serial {

/// Decodes the input of a tty with PARMRK: 0xFF 0x00 X is a character X with a fault, 0xFF 0x00
/// 0x00 for a break, 0xFF 0xFF for a plain 0xFF. A byte state machine.
class ParityMarks {
 public:
  struct Faulty {
    std::uint8_t character = 0;
    bool is_break = false;
  };
  using Item = std::variant<std::uint8_t, Faulty>;
  /// nullopt: more bytes are needed.
  std::optional<Item> feed(std::uint8_t byte);

 private:
  enum class State { Plain, Marked, Faulty };
  State state_ = State::Plain;
};

}  // namespace dripline::serial
