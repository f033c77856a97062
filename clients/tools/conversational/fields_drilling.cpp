#include "clients/tools/conversational/impl/walk.hpp"

namespace dripline::conversational {

using enum Quantity;

namespace {

void walk_return(Form& form, ReturnPoint& point) {
  form.toggle({.name = "return",
               .help = "level of the tool after the cycle: the clearance or the initial level"},
              {"clearance", "initial"}, point);
}

void walk_clearance(Form& form, Quantity quantity, Entry& clearance) {
  form.number(Field{"clearance", "R", quantity, "rapid moves end here"}.required(), clearance);
}

void walk_feed(Form& form, Entry& feed) {
  form.number({"feed", "F", Feed, "blank: the feed in force"}, feed);
}

void walk_pecks(Form& form, Entry& increment, Entry& clearance) {
  form.number(
      Field{"increment", "Q", Length, "depth of each peck, unsigned"}.required().at_least(0),
      increment);
  form.number(
      Field{"peck_clearance", "E", Length, "distance before the last depth at which rapid ends"}

          .at_least(0),
      clearance);
}

}  // namespace

void walk(Form& form, DrillCycle& event) {
  walk_feed(form, event.feed);
  walk_return(form, event.return_point);
  walk_clearance(form, Length, event.clearance);
  form.number(Field{"z", "Z", Length, "final depth"}.required(), event.z);
  if (event.kind == Drilling::DrillDwell || event.kind == Drilling::BoreDwell) {
    form.number({"dwell", "P", Seconds, "seconds at the bottom"}, event.dwell);
  }
  if (event.kind != Drilling::DrillPeck) return;
  form.number({"first_depth", "V", Length, "Z of the first peck"}, event.first_depth);
  walk_pecks(form, event.increment, event.peck_clearance);
}

void walk(Form& form, TapCycle& event) {
  form.number({"speed", "S", Speed, "blank: the speed in force"}, event.speed);
  form.number(Field{"threads_per_unit", "P", Factor, "threads per inch or mm of the tap"}
                  .required()
                  .at_least(0.0001),
              event.threads_per_unit);
  walk_return(form, event.return_point);
  walk_clearance(form, Length, event.clearance);
  form.number(Field{"z", "Z", Length, "depth at which the spindle is reversed"}.required(),
              event.z);
}

void walk(Form& form, GrooveCycle& event) {
  const bool is_face = event.work == Work::Facing;
  const Quantity depth = is_face ? Length : Diameter;
  walk_feed(form, event.feed);
  walk_return(form, event.return_point);
  walk_clearance(form, depth, event.clearance);
  form.number(Field{"x", "X", Diameter,
                    is_face ? "final diameter; blank: one column of pecks" : "final depth"}
                  .required(!is_face),
              event.x);
  form.number(Field{"z", "Z", Length,
                    is_face ? "final depth" : "end of the groove; blank: one column of pecks"}
                  .required(is_face),
              event.z);
  form.number({"first_depth", "V", depth, "depth of the first peck"}, event.first_depth);
  walk_pecks(form, event.increment, event.peck_clearance);
  form.number(Field{"peck_up", "U", Radius, "rapid retraction after each peck"}.at_least(0),
              event.peck_up);
  form.number(
      Field{"step", is_face ? "I" : "K", Radius, "step between columns, unsigned"}.at_least(0),
      event.step);
  form.number({"relief", "D", Radius, "relief at the bottom"}, event.relief);
  form.number(Field{"x_finish_stock", "A", Radius, "stock for the finish pass"}.at_least(0),
              event.x_finish_stock);
  form.number(Field{"z_finish_stock", "C", Length, "stock for the finish pass"}.at_least(0),
              event.z_finish_stock);
}

}  // namespace dripline::conversational
