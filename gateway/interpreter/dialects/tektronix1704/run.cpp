#include "gateway/interpreter/dialects/tektronix1704/run.hpp"

#include <string>

namespace dripline::interpreter::tektronix1704 {

Run::Run(ControlOptions control_options, EventSink& event_sink)
    : options(std::move(control_options)), mm_per_count(options.mm_per_count()), sink(event_sink) {
  for (std::size_t axis = 0; axis < kAxes; ++axis) {
    const std::int64_t from_zero = options.start[axis] - options.zero[axis];
    state.origin[axis] = options.zero[axis];
    state.program[axis] = options.mirror[axis] ? -from_zero : from_zero;
    position.set_raw(static_cast<Axis>(axis),
                     static_cast<double>(options.start[axis]) * mm_per_count);
  }
  position.unmark_all();
}

void Run::deliver_header() {
  state.has_header = true;
  ProgramHeader header;
  header.control = "tektronix-1704";
  header.units = options.is_metric() ? Units::Millimeter : Units::Inch;
  sink.on_program(header);
}

void Run::warn(const DiagnosticRow& fault, const Origin& at, std::uint32_t column,
               std::string_view detail) {
  events().on_warning({at, diagnostic(fault, detail, at.line, column)});
}

bool Run::object(const DiagnosticRow& fault, std::uint32_t column, std::string_view detail) {
  if (options.is_strict) return fail(fault, column, detail);
  warn(fault, origin, column, detail);
  return true;
}

}  // namespace dripline::interpreter::tektronix1704
