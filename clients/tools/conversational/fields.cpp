#include "clients/tools/conversational/fields.hpp"

#include <array>

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

}  // namespace dripline::conversational
