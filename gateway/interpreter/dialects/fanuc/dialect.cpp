#include "gateway/interpreter/core/dialects.hpp"
#include "gateway/interpreter/dialects/fanuc/options.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "gateway/interpreter/dialects/fanuc/interpreter.hpp"

namespace dripline::interpreter {
namespace {

using namespace fanuc;

Result<std::unique_ptr<Interpreter>> make_control(const Setup& setup, bool is_lathe,
                                                  ProgramSource& source, EventSink& sink) {
  auto options = read_options(setup, is_lathe);
  if (!options) return fail(options.error());
  ModalState state;
  Memory memory;
  if (auto loaded = load_memory(setup, *options, state, memory); !loaded) {
    return fail(loaded.error());
  }
  return std::unique_ptr<Interpreter>(std::make_unique<FanucInterpreter>(
      *std::move(options), std::move(state), memory, source, sink));
}

Result<std::unique_ptr<Interpreter>> make(const Setup& setup, ProgramSource& source,
                                          EventSink& sink) {
  return make_control(setup, false, source, sink);
}
Result<std::unique_ptr<Interpreter>> make_lathe(const Setup& setup, ProgramSource& source,
                                                EventSink& sink) {
  return make_control(setup, true, source, sink);
}

/// The text without blanks and comments, in capitals, line ends kept: marks are looked for in this.
std::string squeeze(std::string_view head) {
  std::string text = "\n";
  bool in_comment = false;
  for (const char c : head) {
    if (c == '(') in_comment = true;
    if (!in_comment && kind_of(c) != CharKind::Blank) text += is_letter(c) ? upper(c) : c;
    if (c == ')' || c == '\n') in_comment = false;
  }
  return text;
}

/// `letter` with a digit after it at the beginning of a line.
bool begins_line(const std::string& text, char letter) {
  const std::string mark{'\n', letter};
  for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at + 1)) {
    if (at + 2 < text.size() && is_digit(text[at + 2])) return true;
  }
  return false;
}

/// `#1=`, `#[...]`: macro variables, and how they are joined.
bool contains_any(const std::string& text, std::initializer_list<std::string_view> marks) {
  return std::any_of(marks.begin(), marks.end(),
                     [&](std::string_view mark) { return text.find(mark) != std::string::npos; });
}

int likelihood(std::string_view head, std::string_view) {
  const std::string text = squeeze(head);
  // Words of other controls: plain language, RS274/NGC's O words and names, Centurion's P
  // variables.
  if (contains_any(text, {"BEGINPGM", "TOOLCALL", "\nPROGRAM", "GOSUB", "IFP", "POPENP", "#<",
                          "PB81", "ENDSUB", "ENDIF", "ENDWHILE", "CALL["})) {
    return 0;
  }
  int points = 0;
  if (text.find_first_of("GXYZ") != std::string::npos) points += 10;
  if (begins_line(text, 'O') || begins_line(text, ':')) points += 30;
  if (contains_any(text, {"G54", "G28", "G43", "M98P", "G65P", "G66P"})) points += 15;
  if (contains_any(text, {"IF[", "WHILE[", "GOTO", "POPEN\n", "DPRNT[", "#3000=", "#3006="})) {
    points += 30;
  }
  if (contains_any(text, {"\n#1", "\n#2", "\n#3", "\n#5"})) points += 25;
  return std::min(points, 90);
}

/// What no machining center has: two blocks of a turning cycle, T with an offset.
int lathe_likelihood(std::string_view head, std::string_view file_name) {
  const std::string text = squeeze(head);
  if (!begins_line(text, 'O') && !begins_line(text, ':')) return 0;
  const bool is_lathe = contains_any(text, {"G70P", "G71U", "G71P", "G72W", "G72P", "G76P"});
  return is_lathe ? likelihood(head, file_name) : 0;
}

constexpr std::array kStatusFields{status_field::kCompensation, status_field::kToolLengthZ,
                                   status_field::kToolRadius,   status_field::kWorkSystem,
                                   status_field::kIncremental,  status_field::kCycle};
constexpr std::array kLatheStatusFields{status_field::kCompensation, status_field::kToolLengthX,
                                        status_field::kToolLengthZ,  status_field::kToolRadius,
                                        status_field::kWorkSystem,   status_field::kIncremental,
                                        status_field::kCycle};

/// The dry run of the panel, and which switches for block skip are on.
Result<PanelTables> panel_of(const Setup& setup, bool is_lathe) {
  const auto options = read_options(setup, is_lathe);
  if (!options) return fail(options.error());
  PanelTables tables;
  tables.skip_levels = options->skip_levels;
  if (options->dry_run_feed > 0)
    tables.dry_run = PanelTables::DryRun{Length::mm(options->dry_run_feed), true};
  return tables;
}
Result<PanelTables> read_panel_tables(const Setup& setup) {
  return panel_of(setup, false);
}
Result<PanelTables> read_lathe_panel_tables(const Setup& setup) {
  return panel_of(setup, true);
}

}  // namespace

/// MACHINE LOCK, DRY RUN and the switches of /1 to /9 are on every panel of the family.
constexpr std::size_t kMdiBlocks = 10;
constexpr SwitchRules kSwitches{.skip_levels = 9, .machine_lock = true};

const Dialect kFanucDialect{.name = "fanuc",
                            .title = "Fanuc 0-M, 6M, 11M, 16/18/21-M, 0i to 30i (machining center)",
                            .likelihood = &likelihood,
                            .make = &make,
                            .switches = kSwitches,
                            .mdi_blocks = kMdiBlocks,
                            // T selects and M06 exchanges, as the machine's builder has it: only a
                            // machine without `tool_changer` stops for a tool change.
                            .waits_at_tool_change = true,
                            .panel_tables = &read_panel_tables,
                            .options = &list_options,
                            .status_fields = kStatusFields,
                            .moves_with_length = true};

const Dialect kFanucLatheDialect{.name = "fanuc-t",
                                 .title = "Fanuc 0-T, 16/18/21-T, 0i-T, 30i-T (lathe)",
                                 .likelihood = &lathe_likelihood,
                                 .make = &make_lathe,
                                 .machine = MachineKind::Lathe,
                                 .switches = kSwitches,
                                 .mdi_blocks = kMdiBlocks,
                                 .panel_tables = &read_lathe_panel_tables,
                                 .options = &list_lathe_options,
                                 .status_fields = kLatheStatusFields,
                                 .moves_with_length = true};

}  // namespace dripline::interpreter
