#include "gateway/interpreter/core/dialects.hpp"
#include "gateway/interpreter/dialects/tnc155/options.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "gateway/interpreter/dialects/tnc155/execution/tools.hpp"
#include "gateway/interpreter/dialects/tnc155/interpreter.hpp"
#include "gateway/interpreter/dialects/tnc155/memory/changer.hpp"
#include "gateway/interpreter/dialects/tnc155/memory/memory_files.hpp"
#include "gateway/interpreter/dialects/tnc155/memory/mod_functions.hpp"
#include "gateway/interpreter/dialects/tnc155/memory/program_memory.hpp"
#include "protocol/base/decimal.hpp"

namespace dripline::interpreter {
namespace {

using namespace tnc155;

/// "datum": where the workpiece's datum lies in machine coordinates.
Result<void> load_datum(const Setup& setup, bool is_itnc, State& state) {
  for (const OffsetRecord& offset : setup.offsets) {
    if (is_itnc && offset.name.starts_with("preset")) continue;  // of the options
    if (offset.name != "datum") {
      return fail(Errc::Unsupported, "offset {}: this control has datum", offset.name);
    }
    for (const Axis axis : kAllAxes) {
      state.transformation.datum[static_cast<std::size_t>(axis)] = offset.value.raw(axis);
    }
  }
  return {};
}

/// datum.C: as the control kept it (program_memory.cpp).
bool load_datum_cell(const VariableRecord& variable, State& state) {
  for (const Axis axis : kAllAxes) {
    const auto i = static_cast<std::size_t>(axis);
    if (variable.name != std::string("datum").append(kAxisSuffixes[i])) continue;
    state.transformation.datum[i] = variable.value;
    return true;
  }
  return false;
}

/// QR5 of a later control; -1: none.
std::int64_t retained_parameter(std::string_view name, std::size_t count) {
  if (count != kAllParameters || !name.starts_with("QR")) return -1;
  const auto number = parse_decimal(name.substr(2));
  const bool is_one = number && number->scale == 0 && number->digits >= 0;
  return is_one && number->digits < kRetainedParameters ? number->digits + kFirstRetained : -1;
}

/// Q0 to Q99; a later control has more.
Result<void> load_parameters(const Setup& setup, State& state) {
  const auto all = state.q.size();
  const auto count = static_cast<std::int64_t>(all == kAllParameters ? kItncParameters : all);
  for (const VariableRecord& variable : setup.variables) {
    const std::string_view name = variable.name;
    if (load_datum_cell(variable, state)) continue;
    if (const std::int64_t retained = retained_parameter(name, all); retained >= 0) {
      state.q[static_cast<std::size_t>(retained)] = variable.value;
      state.known_retained.set(static_cast<std::size_t>(retained - kFirstRetained));
      continue;
    }
    const auto number = parse_decimal(name.substr(name.starts_with('Q') ? 1 : 0));
    if (!name.starts_with('Q') || !number || number->scale != 0 || number->digits < 0 ||
        number->digits >= count) {
      return fail(Errc::Unsupported, "variable {}: this control has Q0 to Q{}", name, count - 1);
    }
    state.q[static_cast<std::size_t>(number->digits)] = variable.value;
  }
  return {};
}

/// The central tool file has fewer tools than programs may define.
Result<void> check_tool_store(const Setup& setup) {
  const auto store = write_tool_store(setup.tools, Units::Millimeter);
  if (!store) return fail(store.error().code, "central_tool_file: {}", store.error().what);
  return {};
}

void place_at_start(const Setup& setup, State& state) {
  state.machine = setup.start;
  state.machine.unmark_all();
  state.transformation.update();
  Transformation::Values at{};
  for (const Axis axis : kAllAxes) at[static_cast<std::size_t>(axis)] = state.machine.raw(axis);
  state.stand_at(state.transformation.to_program(at));
}

Result<std::unique_ptr<Interpreter>> make_with(Result<ControlOptions> options, const Setup& setup,
                                               ProgramSource& source, EventSink& sink) {
  if (!options) return fail(options.error());
  State state;
  if (options->is_itnc) state.q.resize(kAllParameters);
  std::vector<ToolDefinition> tools;
  if (auto done = load_datum(setup, options->is_itnc, state); !done) return fail(done.error());
  if (auto done = load_parameters(setup, state); !done) return fail(done.error());
  if (options->central_tool_file) {
    if (auto fits = check_tool_store(setup); !fits) return fail(fits.error());
  }
  if (auto done = load_tools(setup, tools, options->is_itnc ? kLastItncTool : kLastTool); !done)
    return fail(done.error());
  auto pockets = load_pockets(setup, *options);
  if (!pockets) return fail(pockets.error());
  state.pockets = *std::move(pockets);
  state.transformation.basic_rotation = options->basic_rotation;
  place_at_start(setup, state);
  state.has_positioned = setup.is_mdi;  // an incremental block is as good as any there
  if (options->start_block >= 0) {
    state.start.is_searching = true;
    state.start.block = options->start_block;
    state.start.pass = options->start_pass;
    state.start.actual = setup.position.value_or(setup.start);
  }
  std::vector<ToolName> names;
  for (const ToolRecord& tool : setup.tools) {
    if (!tool.name.empty()) names.push_back({tool.name, tool.number});
  }
  return std::unique_ptr<Interpreter>(std::make_unique<TncInterpreter>(
      *std::move(options), std::move(state), std::move(tools), source, sink, std::move(names)));
}

Result<std::unique_ptr<Interpreter>> make(const Setup& setup, ProgramSource& source,
                                          EventSink& sink) {
  auto options = read_options(setup);
  if (options) options->is_mdi = setup.is_mdi;
  return make_with(std::move(options), setup, source, sink);
}

Result<std::unique_ptr<Interpreter>> make_later(const Setup& setup, ProgramSource& source,
                                                EventSink& sink) {
  auto options = read_itnc_options(setup);
  if (options) options->is_mdi = setup.is_mdi;
  return make_with(std::move(options), setup, source, sink);
}

/// Capitals and marks without blanks, line ends kept.
std::string squeeze(std::string_view head) {
  std::string text = "\n";
  for (const char c : head) {
    if (c != ' ' && c != '\t' && c != '\r' && c != '\0') text += c;
  }
  return text;
}

bool contains(const std::string& text, std::string_view mark) {
  return text.find(mark) != std::string::npos;
}

/// `%`, a number, and G71 or G70 on one line.
bool has_iso_start(const std::string& text) {
  const std::size_t percent = text.find('%');
  if (percent == std::string::npos) return false;
  std::size_t at = percent + 1;
  while (at < text.size() && text[at] >= '0' && text[at] <= '9') ++at;
  return at > percent + 1 && (text.compare(at, 3, "G71") == 0 || text.compare(at, 3, "G70") == 0);
}

/// Programs of later controls: a name that is no number, and words that a TNC 155 has not.
bool is_itnc(const std::string& text) {
  constexpr std::string_view kBegin = "BEGINPGM";
  const std::size_t begin = text.find(kBegin);
  if (begin == std::string::npos) return false;
  const std::string_view name =
      std::string_view(text).substr(begin + kBegin.size(), text.find('\n', begin) - begin);
  if (!name.empty() && (name.front() < '0' || name.front() > '9')) return true;
  const auto letter = std::ranges::find_if(name, [](char c) { return c < '0' || c > '9'; });
  const std::string_view rest = name.substr(static_cast<std::size_t>(letter - name.begin()));
  const bool is_number = rest.starts_with("MM") || rest.starts_with("INCH");
  return !is_number || contains(text, "CYCLDEF2") || contains(text, "TOOLCALL\"") ||
         contains(text, "FN18") || contains(text, "~\n");
}

constexpr int kOther = 60;  ///< the other family of this language

int likelihood(std::string_view head, std::string_view) {
  const std::string text = squeeze(head);
  if (contains(text, "BEGINPGM") && (contains(text, "MM") || contains(text, "INCH"))) {
    return is_itnc(text) ? kOther : 100;
  }
  if (has_iso_start(text)) return 90;
  if (contains(text, "TOOLCALL") || contains(text, "CYCLDEF") || contains(text, "CALLLBL")) {
    return 80;
  }
  return 0;
}

/// MOD: mm/inch, position display, large and small characters. Blocks of ISO programs, which begin
/// with N, G or %, are never large.
ScreenSettings screen(const Setup& setup) {
  ScreenSettings shown;
  shown.position = ShownPosition::Actual;
  const auto settings = read_mod_settings(setup.control);
  if (!settings) return shown;
  shown.units = settings->display_units;
  constexpr std::array kPositions{ShownPosition::Actual, ShownPosition::Reference,
                                  ShownPosition::FollowingError, ShownPosition::Nominal,
                                  ShownPosition::DistanceToGo};
  shown.position = kPositions[static_cast<std::size_t>(settings->position_display)];
  if (settings->is_display_large) shown.large_blocks = "0123456789";
  shown.axes.emplace(0b111).set(static_cast<std::size_t>(settings->fourth_axis));
  return shown;
}

constexpr std::array kStatusFields{status_field::kCompensation, status_field::kToolLengthZ,
                                   status_field::kToolRadius};

int itnc_likelihood(std::string_view head, std::string_view) {
  const std::string text = squeeze(head);
  const bool has_frame =
      contains(text, "BEGINPGM") && (contains(text, "MM") || contains(text, "INCH"));
  return has_frame && is_itnc(text) ? 100 : 0;
}

constexpr std::size_t kItncMdiBlocks = 10;  ///< $MDI is a program of any length; as others here

}  // namespace

/// Programs in plain language write F9999 or F15999 for rapid traverse.
constexpr Length kRapidFeed = Length::mm(9'999);

const Dialect kTnc155Dialect{.name = "tnc155",
                             .title = "HEIDENHAIN TNC 151/155 (plain language and ISO)",
                             .likelihood = &likelihood,
                             .make = &make,
                             .switches = {.optional_stop = false, .block_skip = false},
                             .mdi_blocks = 1,
                             // M06 is a program stop where the machine parameter makes it one
                             // (`m06_stop`); TOOL CALL itself never stops, a STOP before
                             // it is programmed.
                             .waits_at_tool_change = true,
                             .check_memory = &check_memory,
                             .is_protected = &is_protected,
                             .options = &list_options,
                             .text = {.kind = TextForm::Kind::PlainLanguage},
                             .status_fields = kStatusFields,
                             .screen = &screen,
                             .moves_with_length = true,
                             .rapid_feed = kRapidFeed};

const Dialect kItncDialect{.name = "itnc",
                           .title = "HEIDENHAIN TNC 426/430, iTNC 530 (plain language)",
                           .likelihood = &itnc_likelihood,
                           .make = &make_later,
                           .mdi_blocks = kItncMdiBlocks,
                           .waits_at_tool_change = true,
                           .options = &list_itnc_options,
                           .text = {.kind = TextForm::Kind::PlainLanguage},
                           .status_fields = kStatusFields,
                           .moves_with_length = true};

}  // namespace dripline::interpreter
