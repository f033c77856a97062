#include "server/library/content_check.hpp"

namespace dripline::library {

Result<void> ContentCheck::feed(std::span<const std::byte> bytes) {
  for (const std::byte b : bytes) {
    const auto byte = std::to_integer<std::uint8_t>(b);
    // The common case first: a printable ASCII character in the middle of a line.
    if (byte >= 0x20 && byte < 0x80 && missing_ == 0 && line_length_ < kMaxLine) {
      ++line_length_;
      ++offset_;
      continue;
    }
    if (auto taken = take(byte); !taken) return taken;
  }
  return {};
}

Result<void> ContentCheck::take(std::uint8_t byte) {
  if (byte == 0) {
    return fail(Errc::Syntax, "byte 0x00 (NUL) at offset {}, line {}: NC programs are text",
                offset_, line_);
  }
  if (auto character = missing_ > 0 ? continue_character(byte) : begin_character(byte);
      !character) {
    return character;
  }
  if (byte == '\n') {
    ++line_;
    line_length_ = 0;
  } else if (++line_length_ > kMaxLine) {
    return fail(Errc::LimitExceeded,
                "line {} is longer than {} bytes at offset {}: at most {} are allowed", line_,
                kMaxLine, offset_, kMaxLine);
  }
  ++offset_;
  return {};
}

Result<void> ContentCheck::begin_character(std::uint8_t byte) {
  lowest_ = 0x80;
  highest_ = 0xBF;
  if (byte < 0x80) return {};
  if (byte >= 0xC2 && byte <= 0xDF) {
    missing_ = 1;
  } else if (byte >= 0xE0 && byte <= 0xEF) {
    missing_ = 2;
    if (byte == 0xE0) lowest_ = 0xA0;
    if (byte == 0xED) highest_ = 0x9F;
  } else if (byte >= 0xF0 && byte <= 0xF4) {
    missing_ = 3;
    if (byte == 0xF0) lowest_ = 0x90;
    if (byte == 0xF4) highest_ = 0x8F;
  } else {
    return fail(Errc::Syntax, "byte 0x{:02X} at offset {}, line {} cannot begin a UTF-8 character",
                byte, offset_, line_);
  }
  return {};
}

Result<void> ContentCheck::continue_character(std::uint8_t byte) {
  if (byte < lowest_ || byte > highest_) {
    return fail(Errc::Syntax,
                "byte 0x{:02X} at offset {}, line {} cannot continue a UTF-8 character", byte,
                offset_, line_);
  }
  lowest_ = 0x80;
  highest_ = 0xBF;
  --missing_;
  return {};
}

Result<void> ContentCheck::finish() const {
  if (offset_ == 0) return fail(Errc::Syntax, "the program is empty: 0 bytes");
  if (missing_ > 0) {
    return fail(Errc::Syntax, "the program ends at offset {} inside a UTF-8 character", offset_);
  }
  return {};
}

}  // namespace dripline::library
