#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "gateway/interpreter/core/interpreter.hpp"
#include "gateway/interpreter/core/language/line_reader.hpp"
#include "gateway/interpreter/core/language/word_ledger.hpp"
#include "gateway/interpreter/dialects/rs274ngc/compensation/held_events.hpp"
#include "gateway/interpreter/dialects/rs274ngc/errors.hpp"
#include "gateway/interpreter/dialects/rs274ngc/memory/names.hpp"
#include "gateway/interpreter/dialects/rs274ngc/options.hpp"
#include "gateway/interpreter/dialects/rs274ngc/reading/block.hpp"
#include "gateway/interpreter/dialects/rs274ngc/reading/known_expressions.hpp"
#include "gateway/interpreter/dialects/rs274ngc/state.hpp"

namespace dripline::interpreter::rs274ngc {

inline constexpr std::size_t kMaxLine = 253;

/// One run: what the files of this folder work on. Functions that cannot go on give false and
/// leave the reason in `pause`.
struct Run : BlockRun {
  Run(ControlOptions control_options, std::vector<Tool> tool_table, ProgramSource& program_source,
      EventSink& event_sink);

  /// Where events go: the sink, after the header, or after the moves that compensation holds back.
  EventSink& events() {
    if (!state.has_header) [[unlikely]]
      deliver_header();
    if (!held.empty()) [[unlikely]]
      return held;
    return sink;
  }

  std::uint32_t column(const char* at) const {
    return static_cast<std::uint32_t>(at - line_begin) + 1;
  }
  /// As `fail`, at the column of a word.
  [[gnu::cold]] bool fail_word(const DiagnosticRow& row, char capital,
                               std::string_view detail = {});
  [[gnu::cold]] bool ask(Question asked);
  [[gnu::cold]] void warn(std::string_view id, std::string_view text);

  bool is_linuxcnc() const { return options.profile == Profile::LinuxCnc; }
  double mm(double units) const { return units * state.mm_per_unit(); }
  /// F in force, per minute or per revolution.
  Feed modal_feed() const {
    // LinuxCNC takes the number as millimeters per second, in G20 too.
    if (state.has_lost_lead) [[unlikely]]
      return Feed::per_minute(Length::mm(60 * state.feed));
    const auto rate = Length::mm(state.feed * interpreter::mm_per_unit(state.feed_units));
    const bool is_per_minute = state.modes.feed == FeedMode::PerMinute;
    return is_per_minute ? Feed::per_minute(rate) : Feed::per_revolution(rate);
  }
  /// G61.1: every move comes to rest at its end. G61, exact path, needs no more than the corners
  /// passed through, which all moves here are; G64 allows to cut them.
  bool rests_at_end() const { return state.modes.path == 611; }

  const ControlOptions options;
  bool block_skip = options.block_skip;  ///< the panel's switch
  const std::vector<Tool> setup_tools;
  std::vector<Tool> tools;  ///< the same rows, as G10 has written them
  ProgramSource& source;
  EventSink& sink;
  LineReader reader;
  State state;
  Parameters parameters{};
  NamedParameters names;
  HeldEvents held;

  TextPlace here;                 ///< of the line
  TextPlace next;                 ///< where the run continues after it
  const char* line_begin = "\n";  ///< the line; its end can be read and is an end of line
  const char* line_end = line_begin;
  std::array<char, kMaxLine + 2> last_line{};  ///< a last line without end, with one
  Block block;
  language::WordLedger ledger;  ///< axis and polar words of the line
  std::optional<Answer> answer;
  struct Signal {
    std::string name;
    SignalValue value;
  };
  std::vector<Signal>
      signals;  ///< HAL pins that the line has asked for: it is read again with them
  std::string scratch;
  KnownExpressions expressions;

 private:
  [[gnu::cold]] void deliver_header();
};

/// The state between two blocks; snapshot.cpp.
Snapshot take_snapshot(const Run& run);
/// Errors: Unsupported (another dialect or version), Corrupt. `run` is then unchanged.
Result<void> restore_snapshot(Run& run, const Snapshot& snapshot);

}  // namespace dripline::interpreter::rs274ngc
