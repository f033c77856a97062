#include "clients/tools/conversational/fields.hpp"

#include <array>

#include "clients/tools/conversational/impl/posting.hpp"
#include "clients/tools/conversational/impl/walk.hpp"

namespace dripline::conversational {

namespace {

template <class Record, class Member, class Value>
Event with(Member Record::*member, Value value) {
  Record record;
  record.*member = value;
  return record;
}

const std::array<EventKind, 36>& kinds() {
  static const std::array<EventKind, 36> kAll{{
      {"program_setup", "Program Set-Up", ProgramSetup{}},
      {"position", "Position", Position{}},
      {"line", "Geometry - Line", Line{}},
      {"arc", "Geometry - Arc", Arc{}},
      {"tangents", "Geometry - Tangs", Tangents{}},
      {"cgen", "Geometry - Cgen", ThreePointArc{}},
      {"thread_line", "Geometry - Thread Line", ThreadLine{}},
      {"rough_turning", "Rough Turning", with(&RoughCycle::work, Work::Turning)},
      {"rough_facing", "Rough Facing", with(&RoughCycle::work, Work::Facing)},
      {"pattern_repeat_turning", "Pattern Repeat Turning",
       with(&PatternRepeat::work, Work::Turning)},
      {"pattern_repeat_facing", "Pattern Repeat Facing", with(&PatternRepeat::work, Work::Facing)},
      {"end_cycle", "End Cycle", EndCycle{}},
      {"finish_turning", "Finish Turning", with(&FinishCycle::work, Work::Turning)},
      {"finish_facing", "Finish Facing", with(&FinishCycle::work, Work::Facing)},
      {"cycle_a", "Turning Cycle A", with(&SingleCut::work, Work::Turning)},
      {"cycle_b", "Facing Cycle B", with(&SingleCut::work, Work::Facing)},
      {"multiple_thread", "Multiple Threading", MultipleThread{}},
      {"cycle_1", "Threading Cycle 1", SingleThread{}},
      {"drill", "Drill", with(&DrillCycle::kind, Drilling::Drill)},
      {"drill_dwell", "Drill w/Dwell", with(&DrillCycle::kind, Drilling::DrillDwell)},
      {"drill_peck", "Drill Peck", with(&DrillCycle::kind, Drilling::DrillPeck)},
      {"bore", "Bore", with(&DrillCycle::kind, Drilling::Bore)},
      {"bore_dwell", "Bore w/Dwell", with(&DrillCycle::kind, Drilling::BoreDwell)},
      {"right_tap", "Right Tap", with(&TapCycle::hand, Hand::Right)},
      {"left_tap", "Left Tap", with(&TapCycle::hand, Hand::Left)},
      {"face_grooving", "Face Grooving", with(&GrooveCycle::work, Work::Facing)},
      {"diameter_grooving", "Diameter Grooving", with(&GrooveCycle::work, Work::Turning)},
      {"tool_change", "Tool Change", with(&ToolSelection::is_change, true)},
      {"tool_call", "Tool Call", with(&ToolSelection::is_change, false)},
      {"miscellaneous", "Miscellaneous", Miscellaneous{}},
      {"program_call", "Program Call", ProgramCall{}},
      {"scaling", "Special - Scale", Scaling{}},
      {"rotation", "Special - Rotate", Rotation{}},
      {"mirror", "Special - Mirror", Mirror{}},
      {"floating_zero", "Special - Floating Zero", FloatingZero{}},
      {"end_of_program", "End of Program", EndOfProgram{}},
  }};
  return kAll;
}

/// Which of the kinds that share a record.
std::size_t variety(const Event& event) {
  const auto of = [](auto value) { return static_cast<std::size_t>(value); };
  if (const auto* rough = std::get_if<RoughCycle>(&event)) return of(rough->work);
  if (const auto* repeat = std::get_if<PatternRepeat>(&event)) return of(repeat->work);
  if (const auto* finish = std::get_if<FinishCycle>(&event)) return of(finish->work);
  if (const auto* cut = std::get_if<SingleCut>(&event)) return of(cut->work);
  if (const auto* drill = std::get_if<DrillCycle>(&event)) return of(drill->kind);
  if (const auto* tap = std::get_if<TapCycle>(&event)) return of(tap->hand);
  if (const auto* groove = std::get_if<GrooveCycle>(&event)) return of(groove->work);
  if (const auto* tool = std::get_if<ToolSelection>(&event)) return of(tool->is_change);
  return 0;
}

}  // namespace

std::span<const EventKind> event_kinds() {
  return kinds();
}

const EventKind* find_event_kind(std::string_view type) {
  for (const auto& kind : kinds()) {
    if (kind.type == type) return &kind;
  }
  return nullptr;
}

const EventKind& kind_of(const Event& event) {
  for (const auto& kind : kinds()) {
    if (kind.blank.index() == event.index() && variety(kind.blank) == variety(event)) return kind;
  }
  return kinds().front();  // not reached: each record has a kind
}

void walk_fields(Form& form, Event& event) {
  std::visit([&](auto& record) { walk(form, record); }, event);
}

using enum Quantity;

void walk(Form& form, ProgramSetup& event) {
  form.whole(Field{"program", "O", Count, "number of the program"}.required().at_least(1),
             event.program);
  form.text(Field{"name", "", Comment, "up to 60 characters without parentheses"}.at_most(60),
            event.name);
  form.toggle({.name = "dimensions", .help = "dimensions of the program"},
              {"absolute", "incremental"}, event.dimensions);
  form.toggle({.name = "units", .help = "units of the program and of every field"},
              {"english", "metric"}, event.units);
  form.set_units(event.units);
  form.number({"material_length", "P", Length, "from the chuck face to Z0, for the graphics"},
              event.material_length);
  form.number({"material_diameter", "P", Diameter, "for the graphics"}, event.material_diameter);
}

void walk(Form& form, ToolSelection& event) {
  form.whole(Field{"tool", "T", Count, "tool and offset number"}.required().at_most(24),
             event.tool);
  form.text(Field{"description", "", Comment, "shown at the change"}
                .only(event.is_change, "not posted by a tool call")
                .at_most(60),
            event.description);
  form.toggle({.name = "feed_per", .help = "unit of feeds"}, {"revolution", "minute"},
              event.feed_mode);
  form.number({"feed", "F", Feed, "in force from this event on"}, event.feed);
  form.toggle({.name = "spindle", .help = "constant surface speed or revolutions per minute"},
              {"surface speed", "rpm"}, event.spindle_mode);
  form.number({"maximum_speed", "RPM", Speed, "limit at constant surface speed"},
              event.maximum_speed);
  form.number({"speed", "S", Speed, "in the spindle's unit"}, event.speed);
  form.toggle({.name = "restart", .help = "start the spindle after the change"},
              {"none", "cw", "ccw"}, event.restart);
  form.toggle({.name = "coolant", .help = "after the change"}, {"off", "on"}, event.has_coolant);
}

void walk(Form& form, Miscellaneous& event) {
  const auto choose = [&](std::string_view name, std::string_view help, const auto& choices,
                          std::size_t& index) {
    const auto names = names_of(choices);
    form.choice({.name = name, .help = help}, names, index);
  };
  choose("feed_per", "unit of feeds", kFeedModes, event.feed_mode);
  form.number({"feed", "F", Feed, "in force from this event on"}, event.feed);
  choose("spindle_mode", "unit of speeds", kSpindleModes, event.spindle_mode);
  form.number(
      Field{"maximum_speed", "RPM", Speed, "limit at constant surface speed"}.only(
          kSpindleModes[event.spindle_mode].posted == "G96", "spindle_mode = surface speed"),
      event.maximum_speed);
  form.number({"speed", "S", Speed, "in force from this event on"}, event.speed);
  choose("gear", "range of the spindle", kGears, event.gear);
  choose("spindle", "direction", kSpindles, event.spindle);
  choose("coolant", "flood", kCoolants, event.coolant);
  choose("compensation", "tool nose compensation", kCompensations, event.compensation);
  choose("stop", "wait for CYCLE START", kStops, event.stop);
  choose("retract", "to the clearances or the tool change position", kRetracts, event.retract);
  choose("cutting_mode", "at the ends of moves", kCuttingModes, event.cutting_mode);
  choose("program_mode", "dimensions", kProgramModes, event.program_mode);
  choose("work_coordinate", "offset 1 to 6", kWorkCoordinates, event.work_coordinate);
  choose("option", "optional functions of the machine", kOptionalFunctions, event.option);
  form.text(Field{"text", "", Text, "a block as typed, up to 70 characters"}.at_most(70),
            event.text);
}

void walk(Form& form, ProgramCall& event) {
  form.whole(Field{"program", "O", Count, "number of the program"}.required().at_least(1),
             event.program);
  form.whole(Field{"repeats", "L", Count, "number of calls; blank: one"}.at_least(1),
             event.repeats);
}

void walk(Form& form, Scaling& event) {
  form.toggle({.name = "state", .help = "switch scaling"}, {"off", "on"}, event.is_on);
  const std::string_view condition = "state = on";
  form.number(
      Field{"i", "I", Diameter, "center in X; blank: the last one"}.only(event.is_on, condition),
      event.center_x);
  form.number(
      Field{"k", "K", Length, "center in Z; blank: the last one"}.only(event.is_on, condition),
      event.center_z);
  form.number(Field{"x", "X", Factor, "factor of X"}.only(event.is_on, condition), event.x_factor);
  form.number(Field{"z", "Z", Factor, "factor of Z"}.only(event.is_on, condition), event.z_factor);
}

void walk(Form& form, Rotation& event) {
  form.toggle({.name = "state", .help = "switch rotation"}, {"off", "on"}, event.is_on);
  const std::string_view condition = "state = on";
  form.number(Field{"x", "X", Diameter, "center"}.only(event.is_on, condition), event.x);
  form.number(Field{"z", "Z", Length, "center"}.only(event.is_on, condition), event.z);
  form.number(Field{"aa", "AA", Angle, "ccw positive"}.required().only(event.is_on, condition),
              event.angle);
}

void walk(Form& form, Mirror& event) {
  form.toggle({.name = "state", .help = "switch mirror image"}, {"off", "on"}, event.is_on);
  const std::string_view condition = "state = on";
  form.number(Field{"x", "X", Diameter, "X of the mirror line"}.only(event.is_on, condition),
              event.x);
  form.number(Field{"z", "Z", Length, "Z of the mirror line"}.only(event.is_on, condition),
              event.z);
  form.demand(!event.is_on || event.x || event.z, "x or z must be given");
}

void walk(Form& form, FloatingZero& event) {
  form.number({"x", "X", Diameter, "new coordinate of the current position"}, event.x);
  form.number({"z", "Z", Length, "new coordinate of the current position"}, event.z);
  form.demand(event.x || event.z, "x or z must be given");
}

void walk(Form& form, EndOfProgram& event) {
  form.toggle({.name = "spindle_off", .help = "stop the spindle"}, {"no", "yes"},
              event.stops_spindle);
  form.toggle({.name = "coolant_off", .help = "stop the coolant"}, {"no", "yes"},
              event.stops_coolant);
  form.number({"x", "X", Diameter, "from machine zero; blank: no move"}, event.x);
  form.number({"z", "Z", Length, "from machine zero; blank: no move"}, event.z);
}

}  // namespace dripline::conversational
