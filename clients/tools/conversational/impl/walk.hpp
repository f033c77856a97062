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

/// What the screens of lines and threads share.
void walk_extend_back(Form& form, ExtendBack& back);

}  // namespace dripline::conversational
