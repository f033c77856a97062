#pragma once

#include <cstdint>
#include <optional>

#include "gateway/interpreter/core/event.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/block.hpp"

namespace dripline::interpreter::tnc155 {

enum class Form : std::uint8_t { Unknown, Plain, Iso };

/// The reader's state of one program; a call keeps the caller's.
struct ProgramForm {
  Form form = Form::Unknown;           ///< detected from the first block that is read
  Units units = Units::Millimeter;     ///< set by BEGIN PGM and %
  std::int32_t number = Block::kNone;  ///< likewise
  friend bool operator==(const ProgramForm&, const ProgramForm&) = default;
};

/// The modal functions between ISO blocks, in the order of execution. They are part of the run's
/// state; nothing is preset at the start of a program, so everything must be programmed before the
/// first move. Compensation and feed are modal in both forms and are not kept here.
struct IsoModes {
  static constexpr std::uint8_t kUnset = 0xFF;

  std::uint8_t motion = kUnset;   ///< number of the modal path function: 0-3, 5, 6, 10-13, 15
  bool has_plane = false;         ///< a G17-G20 was programmed
  bool has_compensation = false;  ///< a G40-G44 was programmed
  bool has_distance = false;      ///< a G90 or G91 was programmed
  bool is_incremental = false;
  std::optional<Turn> last_turn;  ///< for G05 and G15
  friend bool operator==(const IsoModes&, const IsoModes&) = default;
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
