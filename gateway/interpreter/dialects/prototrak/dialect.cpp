#include "gateway/interpreter/core/dialects.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <string>

#include "gateway/interpreter/core/option_rows.hpp"
#include "gateway/interpreter/dialects/prototrak/event_list.hpp"
#include "gateway/interpreter/dialects/prototrak/interpreter.hpp"

namespace dripline::interpreter {
namespace prototrak {

namespace {

/// "N5" or "5".
Result<void> read_start_at(const Options& options, const OptionKey& key, ControlOptions& control) {
  const auto text = options.text(key.key, "");
  if (!text) return fail(text.error());
  if (text->empty()) return {};
  const std::string_view digits = std::string_view(*text).substr(text->front() == 'N' ? 1 : 0);
  std::uint16_t event = 0;
  const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), event);
  if (read.ec != std::errc{} || read.ptr != digits.data() + digits.size() || event < 1 ||
      event > kMaxEvents) {
    return fail(Errc::Syntax, "[control] start_at: \"{}\" is no event of this control: N1 to N{}",
                *text, kMaxEvents);
  }
  control.start_event = event;
  control.names_start = true;
  return {};
}

constexpr std::array kRows{
    row<&ControlOptions::waits>(
        "waits", kFlag,
        "the operator moves Z: waits at positions and at both ends of a chain of cuts"),
    OptionRow<ControlOptions>{{"start_at", kText,
                               "event that a run begins with, by its number: N5; the operator is "
                               "asked there",
                               "the first"},
                              read_start_at}};

}  // namespace

std::vector<ListedOption> list_options() {
  return list_rows(kRows);
}

Result<ControlOptions> read_options(const Setup& setup) {
  ControlOptions control;
  if (auto done = read_rows(kRows, setup.control, control); !done) return fail(done.error());
  return control;
}

}  // namespace prototrak

namespace {

using namespace prototrak;

Result<std::unique_ptr<Interpreter>> make(const Setup& setup, ProgramSource& source,
                                          EventSink& sink) {
  const auto options = read_options(setup);
  if (!options) return fail(options.error());
  return std::unique_ptr<Interpreter>(std::make_unique<ProtoTrakInterpreter>(
      *options, options->names_start ? setup.position.value_or(setup.start) : setup.start, source,
      sink));
}

/// Files of the MX controls: their text form is this one, their own is refused by name.
bool is_mx_name(std::string_view name) {
  constexpr std::size_t kLength = 4;
  std::string end(name.substr(name.size() - std::min(name.size(), kLength)));
  for (char& c : end) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return end == ".mx2" || end == ".mx3" || end == ".pt4";
}

/// Blocks end with ';' here; events have G codes of three digits.
int likelihood(std::string_view head, std::string_view file_name) {
  if (is_mx_name(file_name)) return 100;
  const auto ends = std::count(head.begin(), head.end(), ';');
  if (ends == 0) return 0;
  const auto lines = std::count(head.begin(), head.end(), '\n') + 1;
  const bool has_event_code =
      head.find("G10") != std::string_view::npos && head.find('#') == std::string_view::npos;
  if (ends * 2 < lines) return 0;
  return has_event_code ? 95 : 60;
}

/// The events a program becomes, as the control would send them back.
Result<std::string> list(std::string_view text) {
  Receiver receiver;
  SourceLine line;
  std::uint64_t number = 0;
  std::size_t at = 0;
  auto state = Receiver::State::Receiving;
  while (at < text.size() && state == Receiver::State::Receiving) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    line.text = text.substr(at, end - at);
    line.place = {kMainProgram, at, ++number};
    state = receiver.take(line);
    at = end + 1;
  }
  if (state == Receiver::State::Receiving) state = receiver.end_of_text(number);
  if (state == Receiver::State::Failed) {
    const Diagnostic& diagnostic = receiver.failure().diagnostic;
    return fail(Errc::Syntax, "line {}: {} {}", diagnostic.line, diagnostic.id, diagnostic.text);
  }
  return list_events(receiver.program());
}

/// Two axes: Z is the operator's.
ScreenSettings screen(const Setup&) {
  ScreenSettings shown;
  shown.axes.emplace()
      .set(static_cast<std::size_t>(Axis::X))
      .set(static_cast<std::size_t>(Axis::Y));
  return shown;
}

constexpr std::array kStatusFields{status_field::kCompensation, status_field::kToolRadius};

}  // namespace

const Dialect kProtoTrakDialect{.name = "prototrak-plus",
                                .title = "ProtoTRAK Plus (two-axis mill, events)",
                                .likelihood = likelihood,
                                .make = make,
                                .units = Units::Inch,
                                .machine = MachineKind::Mill,
                                .switches = {.optional_stop = false, .block_skip = false},
                                // Every tool is changed by hand at a prompt.
                                .waits_at_tool_change = true,
                                .list = list,
                                .options = list_options,
                                .text = {.kind = TextForm::Kind::Events, .is_all_programs = true},
                                .status_fields = kStatusFields,
                                .screen = screen,
                                .is_tool_axis_manual = true};

}  // namespace dripline::interpreter
