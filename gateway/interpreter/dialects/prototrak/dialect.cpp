#include "gateway/interpreter/dialects/prototrak/dialect.hpp"

#include <algorithm>
#include <string>

#include "gateway/interpreter/dialects/prototrak/event_list.hpp"
#include "gateway/interpreter/dialects/prototrak/interpreter.hpp"

namespace dripline::interpreter {
namespace prototrak {

Result<ControlOptions> read_options(const Setup& setup) {
  if (const auto known = setup.control.check_known({"waits"}); !known) return fail(known.error());
  const auto waits = setup.control.flag("waits", true);
  if (!waits) return fail(waits.error());
  return ControlOptions{*waits};
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
      head.find("G10") != std::string_view::npos && head.find("#") == std::string_view::npos;
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

}  // namespace

const Dialect kProtoTrakDialect{.name = "prototrak-plus",
                                .title = "ProtoTRAK Plus (two-axis mill, events)",
                                .likelihood = likelihood,
                                .make = make,
                                .units = Units::Inch,
                                .machine = MachineKind::Mill,
                                // Every tool is changed by hand at a prompt (spec 12).
                                .waits_at_tool_change = true,
                                .list = list};

}  // namespace dripline::interpreter
