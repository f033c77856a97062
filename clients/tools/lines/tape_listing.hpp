#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "protocol/wire/tape_code.hpp"

namespace dripline::wire {

/// A tape as text for people: one line for each row with its holes, its value and its meaning;
/// runs of blank rows in one line. A piece at a time; costs no memory. Not thread-safe.
///
///      101  ....o:.oo  0B  %  rewind stop
class TapeListing {
 public:
  explicit TapeListing(CharacterCode code) : code_(code) {}
  void list(std::span<const std::byte> rows, std::string& text);
  void finish(std::string& text) { end_blanks(text); }

 private:
  void end_blanks(std::string& text);
  CharacterCode code_;
  std::uint64_t row_ = 0, blanks_ = 0, first_blank_ = 0;
};

}  // namespace dripline::wire
