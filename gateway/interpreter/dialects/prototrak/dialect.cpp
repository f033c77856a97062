#include "gateway/interpreter/core/dialects.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "gateway/interpreter/core/option_rows.hpp"
#include "gateway/interpreter/dialects/prototrak/event_list.hpp"
#include "gateway/interpreter/dialects/prototrak/interpreter.hpp"

namespace dripline::interpreter {
namespace prototrak {

namespace {

constexpr std::array kRows{row<&ControlOptions::waits>(
    "waits", kFlag,
    "the operator moves Z: waits at positions and at both ends of a chain of cuts")};

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
  return std::unique_ptr<Interpreter>(
      std::make_unique<ProtoTrakInterpreter>(*options, setup.start, source, sink));
}

/// Blocks end with ';' here; events have G codes of three digits.
int likelihood(std::string_view head, std::string_view) {
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
                                .screen = screen};

}  // namespace dripline::interpreter
