#pragma once

#include "clients/tools/conversational/form.hpp"

/// The fields of each record, in the order of its screen.
namespace dripline::conversational {

void walk(Form& form, ProgramSetup& event);
void walk(Form& form, Position& event);
void walk(Form& form, Line& event);
void walk(Form& form, Arc& event);
void walk(Form& form, Tangents& event);
void walk(Form& form, ThreePointArc& event);
void walk(Form& form, ThreadLine& event);
void walk(Form& form, RoughCycle& event);
void walk(Form& form, PatternRepeat& event);
void walk(Form& form, EndCycle& event);
void walk(Form& form, FinishCycle& event);
void walk(Form& form, SingleCut& event);
void walk(Form& form, SingleThread& event);
void walk(Form& form, MultipleThread& event);
void walk(Form& form, DrillCycle& event);
void walk(Form& form, TapCycle& event);
void walk(Form& form, GrooveCycle& event);
void walk(Form& form, ToolSelection& event);
void walk(Form& form, Miscellaneous& event);
void walk(Form& form, ProgramCall& event);
void walk(Form& form, Scaling& event);
void walk(Form& form, Rotation& event);
void walk(Form& form, Mirror& event);
void walk(Form& form, FloatingZero& event);
void walk(Form& form, EndOfProgram& event);

/// What several screens share.
void walk_extend_back(Form& form, ExtendBack& back);
void walk_start_point(Form& form, Entry& x, Entry& z);
void walk_pattern_number(Form& form, std::optional<int>& pattern);
void walk_compensation(Form& form, Compensation& compensation);
/// Straight or tapered, and the taper under `name`.
void walk_taper(Form& form, const Field& taper, bool& is_tapered, Entry& value);
/// Where a cut ends: x and z, or u and w.
struct CutEnd {
  Dimensions& dimensions;
  Entry &x, &u, &z, &w;
};
void walk_cut_end(Form& form, const CutEnd& end);

}  // namespace dripline::conversational
