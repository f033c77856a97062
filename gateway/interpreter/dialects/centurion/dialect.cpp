#include "gateway/interpreter/core/dialects.hpp"
#include "gateway/interpreter/dialects/centurion/options.hpp"
#include "gateway/interpreter/dialects/centurion/part_path.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <string>

#include "gateway/interpreter/dialects/centurion/codes/g_codes.hpp"
#include "gateway/interpreter/dialects/centurion/errors.hpp"
#include "gateway/interpreter/dialects/centurion/interpreter.hpp"
#include "gateway/interpreter/dialects/centurion/memory/control_memory.hpp"
#include "gateway/interpreter/dialects/centurion/memory/panel_tables.hpp"

namespace dripline::interpreter {
namespace {

using namespace centurion;

Result<std::unique_ptr<Interpreter>> make_with(Result<ControlOptions> options, const Setup& setup,
                                               ProgramSource& source, EventSink& sink) {
  if (!options) return fail(options.error());
  ModalState state;
  Parameters parameters;
  if (auto loaded = load_memory(setup, state, parameters); !loaded) return fail(loaded.error());
  return std::unique_ptr<Interpreter>(std::make_unique<CenturionInterpreter>(
      std::move(*options), std::move(state), parameters, source, sink));
}

Result<std::unique_ptr<Interpreter>> make(const Setup& setup, ProgramSource& source,
                                          EventSink& sink) {
  return make_with(read_options(setup), setup, source, sink);
}

Result<std::unique_ptr<Interpreter>> make_part_path(const Setup& setup, ProgramSource& source,
                                                    EventSink& sink) {
  auto options = read_options(setup);
  if (options) options->draws_part_path = true;
  return make_with(std::move(options), setup, source, sink);
}

/// The text without blanks and comments, in capitals.
std::string squeeze(std::string_view head) {
  std::string text;
  bool in_comment = false;
  for (const char c : head) {
    if (c == '(') in_comment = true;
    if (!in_comment && !is_blank(c)) text += kind_of(c) == CharKind::Letter ? upper(c) : c;
    if (c == ')' || is_end_of_block(c)) in_comment = false;
  }
  return text;
}

/// This control assigns with `P12=`: its parameters are written with P, not with # or Q.
bool assigns_parameter(std::string_view text) {
  for (std::size_t at = text.find('P'); at != std::string_view::npos; at = text.find('P', at + 1)) {
    std::size_t after = at + 1;
    while (after < text.size() && is_digit(text[after])) ++after;
    if (after > at + 1 && after < text.size() && text[after] == '=') return true;
  }
  return false;
}

int likelihood(std::string_view head, std::string_view) {
  const std::string text = squeeze(head);
  for (const std::string_view foreign : {"BEGINPGM", "#1=", "#100=", "TOOLCALL", "\nPROGRAM"}) {
    if (text.find(foreign) != std::string::npos) return 0;
  }
  int points = 0;
  if (text.find_first_of("GXZ") != std::string::npos) points += 10;
  if (assigns_parameter(text)) points += 50;
  for (const std::string_view mark : {"G93", "PB81", "PROBE1", "DPRNT[", "GOSUB", "XC", "ZC", "AB",
                                      "IFP", "POPEN", "G501", "G550", "G569"}) {
    if (text.find(mark) != std::string::npos) points += 25;
  }
  return std::min(points, 95);
}

/// "error 300: program already exists"; empty: the control has no number for it.
std::string refusal_words(Refusal refusal) {
  using enum Refusal;
  constexpr std::array<std::pair<Refusal, int>, 10> kNumbers{{{NameTaken, 300},
                                                              {BadNumber, 301},
                                                              {NothingToSelect, 302},
                                                              {NotSaved, 303},
                                                              {NotLoaded, 304},
                                                              {OntoItself, 309},
                                                              {BadParameters, 311},
                                                              {MemoryFull, 312},
                                                              {DiskFull, 101},
                                                              {NoSuchProgram, 603}}};
  for (const auto& [known, number] : kNumbers) {
    if (known == refusal)
      return fmt::format("error {}: {}", number, error_row_of_number(number).text);
  }
  return {};
}

/// Floating zero, local coordinates and files of parameters stay, though their codes are of one
/// block.
bool is_one_shot(int tenths) {
  if (tenths < 0 || tenths % 10 != 0) return false;
  const unsigned code = static_cast<unsigned>(tenths) / 10;
  const std::uint8_t index = centurion::g_row_index(code);
  if (index == centurion::kNoRow) return false;
  const centurion::GRow& row = centurion::g_row(index);
  const bool stays = code == 12 || code == 49 || code == 50 || code == 52 || code == 65;
  return row.group == centurion::ModalGroup::OneShot && !stays && code < 990;
}

constexpr std::array kStatusFields{status_field::kCompensation, status_field::kToolLengthX,
                                   status_field::kToolLengthZ,  status_field::kToolRadius,
                                   status_field::kWorkSystem,   status_field::kIncremental,
                                   status_field::kCycle};

}  // namespace

const Dialect kCenturionDialect{
    .name = "centurion",
    .title = "Milltronics Centurion 5T/6T (lathe)",
    .likelihood = &likelihood,
    .make = &make,
    .units = Units::Inch,
    .machine = MachineKind::Lathe,
    .feed_override_switch = {.step = 0.1, .most = 1.5, .fastest = std::nullopt},
    .switches = {.dry_run_at_rest = true},  // error 605: while running
    .mdi_blocks = 1,
    .waits_at_tool_change = true,  // M6 prompts and waits (manual: M6)
    .panel_tables = &read_panel_tables,
    .options = &list_options,
    .refusal_words = &refusal_words,
    .text = {.is_one_shot = &is_one_shot},
    .status_fields = kStatusFields};

Dialect centurion::part_path_dialect() {
  Dialect dialect = kCenturionDialect;
  dialect.make = &make_part_path;
  return dialect;
}

}  // namespace dripline::interpreter
