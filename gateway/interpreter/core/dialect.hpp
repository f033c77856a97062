#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gateway/interpreter/core/event.hpp"
#include "gateway/interpreter/core/interpreter.hpp"
#include "gateway/interpreter/core/screen.hpp"
#include "gateway/interpreter/core/setup.hpp"

namespace dripline::interpreter {

/// The override of each position of a panel's switches, where a control's setup has tables of them.
/// Factors: 1 is 100 %.
struct PanelTables {
  std::vector<double> feed;     ///< overrides
  std::vector<double> spindle;  ///< overrides
  /// The program time that a click of the handwheel passes, for each position of the feed switch;
  /// positions beyond the last one have its time. Empty: a handwheel drives no program.
  std::vector<double> click_seconds;
  struct DryRun {
    Length feed;  ///< per minute, at 100 %, of all axes together, degrees as millimeters
    bool turns_spindle = true;
  };
  std::optional<DryRun> dry_run = {};  ///< nothing: no dry run, or no feed is known for it
  std::uint16_t skip_levels = 0;       ///< bit n: blocks with /n are skipped
};

/// The switches of a control's panel that decide how a program runs. Every control has single
/// block.
struct SwitchRules {
  bool optional_stop = true;
  bool block_skip = true;        ///< of blocks with / alone, or with /1
  int skip_levels = 1;           ///< up to 9: the highest number after a slash
  bool dry_run_at_rest = false;  ///< dry run is changed only while the program is halted
  bool machine_lock = false;
};

/// How the text of a control reads where it is searched and not interpreted.
struct TextForm {
  enum class Kind : std::uint8_t {
    Words,          ///< blocks of letters with numbers
    Events,         ///< the events of a ProtoTRAK
    PlainLanguage,  ///< the dialog of a TNC
  };
  Kind kind = Kind::Words;
  std::span<const int> motion_codes = {};  ///< G codes that move besides G0 to G3, in tenths
  bool has_diameter_codes = false;         ///< G7 and G8 choose diameters and radii
  /// Whether a G code (in tenths) is of its block alone; null: as most controls have them.
  bool (*is_one_shot)(int code) = nullptr;
  bool is_all_programs = false;  ///< the control sends programs and prints nothing
};

/// What program storage refuses and what controls have a message for too.
enum class Refusal : std::uint8_t {
  None,
  NameTaken,        ///< a program of that name exists
  BadNumber,        ///< no number that the control takes
  NothingToSelect,  ///< no program at all
  NotSaved,         ///< a program could not be stored
  NotLoaded,        ///< a stored program could not be read
  OntoItself,       ///< copied or renamed to its own name
  BadParameters,    ///< tools, offsets and parameters that the control would not take
  MemoryFull,       ///< the control's memory for programs
  DiskFull,         ///< of the computer that stores programs
  NoSuchProgram,
};

/// Whether a control could keep a program, with all those it calls, in its part-program memory.
struct MemoryVerdict {
  /// The setup says that the control keeps its programs, so a program it refuses cannot run.
  /// Otherwise programs are drip-fed, and a refusal is only worth a warning.
  bool is_binding = false;
  /// In the order in which the programs would be loaded. Lines are those of the program that was
  /// started; for a called program it is the line of its call.
  std::vector<Diagnostic> refused;
};

struct ListedOption;  ///< option_rows.hpp

/// What the control moves: decides the axes of a simulated machine.
enum class MachineKind : std::uint8_t { Mill, Lathe };

/// The knob for feeds on a control's panel.
struct FeedOverrideSwitch {
  double step = 0;  ///< between its positions, as a factor; 0: continuous
  double most = 2;
  std::optional<Length> fastest;  ///< per minute; no position goes beyond it
};

/// One control family. A new dialect is a new folder and one line in registry.cpp.
struct Dialect {
  std::string_view name;   ///< as in configurations and `--control`
  std::string_view title;  ///< for people
  /// 0 = certainly not this control's text, 100 = certainly. `head` is the first bytes of the
  /// program.
  int (*likelihood)(std::string_view head, std::string_view file_name);
  /// Errors: Syntax, Unsupported (an option or record of the setup that this control does not
  /// have).
  Result<std::unique_ptr<Interpreter>> (*make)(const Setup& setup, ProgramSource& source,
                                               EventSink& sink);
  /// Units of the control's own memory at power on: of a setup file that names none.
  Units units = Units::Millimeter;
  MachineKind machine = MachineKind::Mill;
  FeedOverrideSwitch feed_override_switch = {};
  SwitchRules switches = {};
  std::size_t mdi_blocks = 0;  ///< so many lines are keyed in at once; 0: the control has no MDI
  bool waits_at_tool_change = false;  ///< tools are changed by hand: CYCLE START resumes
  /// What the control makes of a program, in its own words; nullptr: it keeps the text. Errors:
  /// Syntax.
  Result<std::string> (*list)(std::string_view text) = nullptr;
  /// Switches of the panel that a setup can be given tables for; nullptr: the panel is as
  /// `feed_override_switch` says. Errors: Syntax, LimitExceeded.
  Result<PanelTables> (*panel_tables)(const Setup& setup) = nullptr;
  /// Whether the control's part-program memory has room for the program and those it calls. Reads a
  /// bounded part of each program; `source` must hold all of its text. nullptr: the memory is not
  /// modeled. Errors: those of the control's options.
  Result<MemoryVerdict> (*check_memory)(const Setup& setup, ProgramSource& source) = nullptr;
  /// Whether the program is marked as protected against erasing and changing. `head`: its first
  /// bytes. nullptr: programs have no such mark.
  bool (*is_protected)(std::string_view head) = nullptr;
  /// The keys of `[control]` (option_rows.hpp), grouped by meaning; nullptr: none.
  std::vector<ListedOption> (*options)() = nullptr;
  /// The control's own words for what its program storage refuses: "error 300: program already
  /// exists"; empty: it has none for this refusal. nullptr: it numbers no refusals.
  std::string (*refusal_words)(Refusal refusal) = nullptr;
  TextForm text = {};
  /// Which of status_field its status window has.
  std::span<const std::string_view> status_fields = {};
  /// Settings of a setup that are not valid are those of a new control. nullptr: there are none.
  ScreenSettings (*screen)(const Setup& setup) = nullptr;
  /// A tool's length that comes into force shifts the position at once, while the axes stay; else
  /// the position stays, and the axes follow.
  bool length_shifts_position = false;
  /// It is certain for each move which length an axis of a real machine takes in: machines with
  /// axes of their own move with lengths in force (machine::AxisLengths).
  bool moves_with_length = false;
  /// The control moves no tool axis: its operator does, by hand, before each start.
  bool is_tool_axis_manual = false;
  /// Per minute: a feed at least as large is rapid traverse, for a control that has no word for it.
  std::optional<Length> rapid_feed = {};
};

}  // namespace dripline::interpreter
