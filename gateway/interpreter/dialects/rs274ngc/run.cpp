#include "gateway/interpreter/dialects/rs274ngc/run.hpp"

namespace dripline::interpreter::rs274ngc {
namespace {

/// After the longest line its end must be seen: 253 bytes, and one less in the later program.
LineRules rules_of(const ControlOptions& options) {
  return {options.is_linuxcnc() ? kMaxLine - 1 : kMaxLine, false};
}

}  // namespace

Run::Run(ControlOptions control_options, std::vector<Tool> tool_table,
         ProgramSource& program_source, EventSink& event_sink)
    : options(std::move(control_options)),
      setup_tools(std::move(tool_table)),
      tools(setup_tools),
      source(program_source),
      sink(event_sink),
      reader(program_source, rules_of(options)) {}

void Run::deliver_header() {
  state.has_header = true;
  ProgramHeader header;
  header.control = "rs274ngc";
  header.units = state.units;
  sink.on_program(header);
}

bool Run::fail_word(const DiagnosticRow& row, char capital, std::string_view detail) {
  return fail(row, block.words.has(capital) ? block.words.column(capital) : 0, detail);
}

bool Run::ask(Question asked) {
  state.passes = 0;
  events();  // the header comes before anything the question brings about
  pause = Pause::ForQuestion;
  question = std::move(asked);
  return false;
}

void Run::warn(std::string_view id, std::string_view text) {
  if (!state.has_header) deliver_header();
  sink.on_warning({origin, {id, std::string(text), origin.line, 0}});
}

}  // namespace dripline::interpreter::rs274ngc
