#include "gateway/interpreter/dialects/fanuc/run.hpp"

#include "gateway/interpreter/dialects/fanuc/execution/machine_functions.hpp"

namespace dripline::interpreter::fanuc {

void Run::deliver_header() {
  state.has_header = true;
  ProgramHeader header;
  header.control = options.is_lathe ? "fanuc-t" : "fanuc";
  header.x_is_diameter = options.x_is_diameter;
  if (!name.empty()) header.name = name;
  header.units = state.units;
  sink.on_program(header);
  const OverrideInhibit lock = override_inhibit(*this);
  const bool locks =
      lock.feed_override || lock.single_block || lock.hold != FeedHoldInhibit::AtOnce;
  if (locks) sink.on_override_inhibit(lock);
}

void Run::lead_stages() {
  last = &sink;
  if (rotary.is_on()) last = &rotary;
  if (tilted.is_on() || (state.uses_compensator && !rotary.is_on())) last = &tilted;
  compensator.lead_to(*last);
  if (is_recording()) {
    blender.lead_to(recorder);
    front = state.uses_blender ? static_cast<EventSink*>(&blender) : &recorder;
    return;
  }
  blender.lead_to(compensator);
  front = state.uses_compensator ? static_cast<EventSink*>(&path()) : last;
}

void Run::place_stages() {
  lead_stages();
  if (!tilted.is_on()) tilted.place(state.position, increments.mm_per_unit);
  if (!state.uses_compensator) return;
  compensator.place(state.position);
  blender.place(state.position);
}

bool Run::ask(Question asked) {
  state.limits = {};
  pause = Pause::ForQuestion;
  question = std::move(asked);
  return false;
}

void Run::warn(const DiagnosticRow& row, std::uint32_t at_column, std::string_view detail) {
  events().on_warning({origin, diagnostic(row, detail, origin.line, at_column)});
}

void Run::update_increments() {
  const bool is_inch = state.units == Units::Inch;
  increments.x_factor = options.x_is_diameter ? 0.5 : 1;
  increments.mm_per_unit = state.mm_per_unit();
  increments.angle_decimals = options.decimals_mm;
  increments.decimals = options.decimals_mm + (is_inch ? 1 : 0);
  increments.per_degree = std::pow(10.0, increments.angle_decimals);
  increments.per_unit = std::pow(10.0, increments.decimals);
}

std::size_t Run::work_system() const {
  const std::uint8_t code = state.g[kWorkGroup];
  return code == kMoreWorkSystems ? static_cast<std::size_t>(6 + memory.coordinates.more_work)
                                  : static_cast<std::size_t>(code - 53);
}

void Run::update_origin() {
  const Coordinates& all = memory.coordinates;
  const std::size_t system = work_system();
  ++frame_changes;
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    state.origin[i] = all.work[system][i] + all.work[0][i] + all.shift[i] + all.local[i];
  }
}

void Run::update_special() {
  state.g[kModalCallGroup] = state.modal_active >= 0 ? 66 : 67;
  state.is_special = state.is_cycle() || state.is_polar() || state.is_transformed ||
                     state.imaginary != 0 || state.modal_active >= 0 || state.zone.is_on ||
                     options.checks_stroke() || state.is_inverse_time() ||
                     state.enters_parameters || rotary.is_on() || tilted.is_on() ||
                     state.contour.code != 0 || state.g[kMotionGroup] > 3;
}

double Run::angle(const Word& word) const {
  switch (word.form) {
    case WordForm::Whole:
      return options.calculator_point ? word.value : word.value / increments.per_degree;
    case WordForm::Computed:
      return std::round(word.value * increments.per_degree) / increments.per_degree;
    case WordForm::Point:
      break;
  }
  return word.decimals > increments.angle_decimals ? cut(word.value, increments.per_degree)
                                                   : word.value;
}

}  // namespace dripline::interpreter::fanuc
