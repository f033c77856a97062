#include "clients/tools/conversational/impl/walk.hpp"

namespace dripline::conversational {
namespace {

void walk_return(Form& form, ReturnPoint& point) {
  form.toggle({.name = "return",
               .help = "level of the tool after the cycle: the clearance or the initial level"},
              {"clearance", "initial"}, point);
}

void walk_clearance(Form& form, Quantity quantity, Entry& clearance) {
  form.number({.name = "clearance",
               .word = "R",
               .quantity = quantity,
               .help = "rapid moves end here",
               .is_required = true},
              clearance);
}

void walk_feed(Form& form, Entry& feed) {
  form.number(
      {.name = "feed", .word = "F", .quantity = Quantity::Feed, .help = "blank: the feed in force"},
      feed);
}

void walk_pecks(Form& form, Entry& increment, Entry& clearance, bool applies_clearance) {
  form.number({.name = "increment",
               .word = "Q",
               .help = "depth of each peck, unsigned",
               .is_required = true,
               .min = 0},
              increment);
  form.number({.name = "peck_clearance",
               .word = "E",
               .help = "distance before the last depth at which rapid ends",
               .applies = applies_clearance,
               .min = 0},
              clearance);
}

}  // namespace

void walk(Form& form, DrillCycle& event) {
  walk_feed(form, event.feed);
  walk_return(form, event.return_point);
  walk_clearance(form, Quantity::Length, event.clearance);
  form.number({.name = "z", .word = "Z", .help = "final depth", .is_required = true}, event.z);
  if (event.kind == Drilling::DrillDwell || event.kind == Drilling::BoreDwell) {
    form.number({.name = "dwell",
                 .word = "P",
                 .quantity = Quantity::Seconds,
                 .help = "seconds at the bottom"},
                event.dwell);
  }
  if (event.kind != Drilling::DrillPeck) return;
  form.number({.name = "first_depth", .word = "V", .help = "Z of the first peck"},
              event.first_depth);
  walk_pecks(form, event.increment, event.peck_clearance, true);
}

void walk(Form& form, TapCycle& event) {
  form.number({.name = "speed",
               .word = "S",
               .quantity = Quantity::Speed,
               .help = "blank: the speed in force"},
              event.speed);
  form.number({.name = "threads_per_unit",
               .word = "P",
               .quantity = Quantity::Factor,
               .help = "threads per inch or mm of the tap",
               .is_required = true,
               .min = 0.0001},
              event.threads_per_unit);
  walk_return(form, event.return_point);
  walk_clearance(form, Quantity::Length, event.clearance);
  form.number({.name = "z",
               .word = "Z",
               .help = "depth at which the spindle is reversed",
               .is_required = true},
              event.z);
}

void walk(Form& form, GrooveCycle& event) {
  const bool is_face = event.work == Work::Facing;
  const Quantity depth = is_face ? Quantity::Length : Quantity::Diameter;
  walk_feed(form, event.feed);
  walk_return(form, event.return_point);
  walk_clearance(form, depth, event.clearance);
  form.number({.name = "x",
               .word = "X",
               .quantity = Quantity::Diameter,
               .help = is_face ? "final diameter; blank: one column of pecks" : "final depth",
               .is_required = !is_face},
              event.x);
  form.number({.name = "z",
               .word = "Z",
               .help = is_face ? "final depth" : "end of the groove; blank: one column of pecks",
               .is_required = is_face},
              event.z);
  form.number(
      {.name = "first_depth", .word = "V", .quantity = depth, .help = "depth of the first peck"},
      event.first_depth);
  walk_pecks(form, event.increment, event.peck_clearance, true);
  form.number({.name = "peck_up",
               .word = "U",
               .quantity = Quantity::Radius,
               .help = "rapid retraction after each peck",
               .min = 0},
              event.peck_up);
  form.number({.name = "step",
               .word = is_face ? "I" : "K",
               .quantity = Quantity::Radius,
               .help = "step between columns, unsigned",
               .min = 0},
              event.step);
  form.number(
      {.name = "relief", .word = "D", .quantity = Quantity::Radius, .help = "relief at the bottom"},
      event.relief);
  form.number({.name = "x_finish_stock",
               .word = "A",
               .quantity = Quantity::Radius,
               .help = "stock for the finish pass",
               .min = 0},
              event.x_finish_stock);
  form.number(
      {.name = "z_finish_stock", .word = "C", .help = "stock for the finish pass", .min = 0},
      event.z_finish_stock);
}

}  // namespace dripline::conversational
