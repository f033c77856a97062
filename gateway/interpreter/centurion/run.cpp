#include "gateway/interpreter/centurion/run.hpp"

namespace dripline::interpreter::centurion {

void Run::choose_stages() {
  if (!state.has_header) deliver_header();
  front = &sink;
  if (state.uses_compensator) front = &compensator;
}

void Run::command(const PathCommand& command) {
  carry_out(compensator, command);
}

/// A block says that it is over even where it does nothing, header or not.
void Run::end_block() {
  EventSink& stage = front != nullptr ? *front : sink;
  stage.on_block_end(origin);
}

Position Run::present_position() const {
  Position at;
  at.set(Axis::X, length(state.position.x));
  at.set(Axis::Z, length(state.position.z));
  if (!(state.moved_axes & 1)) at.unmark(Axis::X);
  if (!(state.moved_axes & 2)) at.unmark(Axis::Z);
  return at;
}

void Run::deliver_header() {
  state.has_header = true;
  ProgramHeader header;
  header.control = "centurion";
  if (!name.empty()) header.name = name;
  header.units = state.units;
  header.x_is_diameter = true;
  sink.on_program(header);
}

bool Run::fail(ErrorCode code, std::uint32_t at_column, std::string_view detail) {
  return fail_as(error_row(code), at_column, detail);
}

bool Run::fail_as(const ErrorRow& row, std::uint32_t at_column, std::string_view detail) {
  pause = Pause::Alarm;
  alarm.id = row.id;
  alarm.text = row.text;
  if (!detail.empty()) {
    alarm.text += ": ";
    alarm.text += detail;
  }
  alarm.line = origin.line;
  alarm.column = at_column;
  return false;
}

bool Run::ask(Question asked) {
  pause = Pause::Question;
  // an operator or a probe needs the tool in its place
  const bool meets_tool =
      std::holds_alternative<ProbeQuestion>(asked) || std::holds_alternative<PromptQuestion>(asked);
  if (meets_tool && state.uses_compensator) compensator.settle();
  question = std::move(asked);
  if (block.parts.stage == Stage::Items) state.random = random_at_item;
  return false;
}

const Answer* Run::next_answer() {
  if (answers_used >= answers.size()) return nullptr;
  return &answers[answers_used++];
}

void Run::update_origin() {
  const Point work = parameters.work_offset(state.modes.work_system);
  state.origin = {work.x + state.floating_zero.x + state.local_zero.x,
                  work.z + state.floating_zero.z + state.local_zero.z};
}

}  // namespace dripline::interpreter::centurion
