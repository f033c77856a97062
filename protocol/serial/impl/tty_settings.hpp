#pragma once

#include <termios.h>
#include <cstdint>
#include <optional>
#include <variant>

#include "protocol/base/result.hpp"
#include "protocol/wire/line_settings.hpp"

namespace dripline::serial {

/// Makes `modes` raw, with the settings' rate and character format and faults marked (PARMRK). Flow
/// control belongs to the discipline: the kernel's would act too late and unseen.
/// Errors: Unsupported (a baud rate or format that ttys do not have, named); `modes` is then
/// unchanged.
Result<void> fill_modes(const wire::LineSettings& settings, termios& modes);

/// What a device made of `wanted`; nullopt-like empty text: all of it. Otherwise what differs.
std::string difference(const termios& wanted, const termios& got);

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
