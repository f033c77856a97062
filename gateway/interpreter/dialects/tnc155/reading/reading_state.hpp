#pragma once

#include <cstdint>
#include <optional>

#include "gateway/interpreter/dialects/tnc155/reading/block.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/iso_modes.hpp"

namespace dripline::interpreter::tnc155 {

enum class Form : std::uint8_t { Unknown, Plain, Iso };

/// The reader's state of one program; a call keeps the caller's.
struct ProgramForm {
  Form form = Form::Unknown;           ///< detected from the first block that is read
  Units units = Units::Millimeter;     ///< set by BEGIN PGM and %
  std::int32_t number = Block::kNone;  ///< likewise
  friend bool operator==(const ProgramForm&, const ProgramForm&) = default;
};

/// Everything that reading depends on; part of the run's state.
struct ReadingState {
  ProgramForm program;
  IsoModes iso;
  /// The path block a `*` block of plain language repeats: its kind and direction.
  std::optional<BlockKind> last_path;
  Turn last_turn = Turn::Clockwise;
  friend bool operator==(const ReadingState&, const ReadingState&) = default;
};

}  // namespace dripline::interpreter::tnc155
