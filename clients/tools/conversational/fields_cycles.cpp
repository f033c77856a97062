#include "clients/tools/conversational/impl/walk.hpp"

namespace dripline::conversational {

using enum Quantity;

namespace {

void walk_start_point(Form& form, Entry& x, Entry& z) {
  form.number(Field{"start_x", "X", Diameter, "where the cycle starts"}.required(), x);
  form.number(Field{"start_z", "Z", Length, "where the cycle starts"}.required(), z);
}

void walk_pattern_number(Form& form, std::optional<int>& pattern) {
  form.whole(Field{"pattern", "N", Count, "number of the pattern; its labels are N98nn and N99nn"}
                 .required()
                 .at_most(99),
             pattern);
}

void walk_compensation(Form& form, Compensation& compensation) {
  form.toggle({.name = "compensation", .help = "tool nose compensation"}, {"off", "left", "right"},
              compensation);
}

/// Straight or tapered, and the taper under `name`.
void walk_taper(Form& form, const Field& taper, bool& is_tapered, Entry& value) {
  form.toggle({.name = "taper", .help = "shape of the cut"}, {"straight", "tapered"}, is_tapered);
  form.number(taper.required().only(is_tapered, "taper = tapered"), value);
}

/// Where a cut ends: x and z, or u and w.
struct CutEnd {
  Dimensions& dimensions;
  Entry &x, &u, &z, &w;
};

void walk_cut_end(Form& form, const CutEnd& end) {
  form.toggle({.name = "dimensions", .help = "dimensions of the end point"},
              {"absolute", "incremental"}, end.dimensions);
  const bool is_absolute = end.dimensions == Dimensions::Absolute;
  form.number(
      Field{"x", "X", Diameter, "end"}.required().only(is_absolute, "dimensions = absolute"),
      end.x);
  form.number(Field{"u", "U", Diameter, "from the start point"}.required().only(
                  !is_absolute, "dimensions = incremental"),
              end.u);
  form.number(Field{"z", "Z", Length, "end"}.required().only(is_absolute, "dimensions = absolute"),
              end.z);
  form.number(Field{"w", "W", Length, "from the start point"}.required().only(
                  !is_absolute, "dimensions = incremental"),
              end.w);
}

struct Stocks {
  Entry &x_finish, &z_finish, &x_rough, &z_rough;
};

void walk_stocks(Form& form, const Stocks& stocks) {
  form.number({"x_finish_stock", "U", Diameter, "signed"}, stocks.x_finish);
  form.number({"z_finish_stock", "W", Length, "signed"}, stocks.z_finish);
  form.number({"x_rough_stock", "I", Radius, "signed"}, stocks.x_rough);
  form.number({"z_rough_stock", "K", Length, "signed"}, stocks.z_rough);
}

void walk_start_angle(Form& form, Entry& angle) {
  form.number(Field{"start_angle", "Q", Angle, "shift of the start, for threads of several starts"}
                  .at_least(0),
              angle);
}

void walk_lead(Form& form, Entry& lead) {
  form.number(Field{"lead", "F", Lead, "advance in one revolution"}.required(), lead);
}

void walk_chamfer(Form& form, Entry& length, Entry& angle) {
  form.number(
      Field{"chamfer_length", "P103", Length, "length of the pull-out at the end"}.at_least(0),
      length);
  form.number(Field{"chamfer_angle", "P104", Angle, "0: straight out in X"}.at_least(0).at_most(90),
              angle);
}

void walk_size(Form& form, MultipleThread& event) {
  form.toggle({.name = "entry", .help = "how the thread is given"}, {"root and height", "crest"},
              event.entry);
  const bool is_crest = event.entry == ThreadEntry::Crest;
  form.number(
      Field{"crest_x", "X", Diameter, "diameter at the crest; height and root follow from the nose"}
          .required()
          .only(is_crest, "entry = crest"),
      event.crest_x);
  form.number(Field{"root_x", "X", Diameter, "diameter at the root"}.required().only(
                  !is_crest, "entry = root and height"),
              event.root_x);
  form.number(Field{"height", "K", Radius, "root to crest"}
                  .required()
                  .only(!is_crest, "entry = root and height")
                  .at_least(0),
              event.height);
}

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

void walk(Form& form, RoughCycle& event) {
  const bool is_turning = event.work == Work::Turning;
  walk_stocks(
      form, {event.x_finish_stock, event.z_finish_stock, event.x_rough_stock, event.z_rough_stock});
  form.number({"first_depth", "V", is_turning ? Diameter : Length,
               is_turning ? "diameter of the first cut" : "Z of the first cut"},
              event.first_depth);
  form.number(Field{"cut_increment", "D", is_turning ? Radius : Length, "from cut to cut, unsigned"}
                  .required()
                  .at_least(0),
              event.cut_increment);
  form.toggle({.name = "relief", .help = "how the tool leaves a cut"}, {"pattern", "45 degrees"},
              event.relief);
  form.number(Field{"clearance", "R", Radius, "how far the tool pulls away"}.at_least(0),
              event.clearance);
  walk_compensation(form, event.compensation);
  walk_start_point(form, event.start_x, event.start_z);
  walk_pattern_number(form, event.pattern);
}

void walk(Form& form, PatternRepeat& event) {
  walk_stocks(
      form, {event.x_finish_stock, event.z_finish_stock, event.x_rough_stock, event.z_rough_stock});
  form.whole(
      Field{"passes", "D", Count, "how often the pattern is followed"}.required().at_least(1),
      event.passes);
  walk_compensation(form, event.compensation);
  walk_start_point(form, event.start_x, event.start_z);
  walk_pattern_number(form, event.pattern);
}

void walk(Form&, EndCycle&) {}

void walk(Form& form, FinishCycle& event) {
  walk_pattern_number(form, event.pattern);
  form.number({"feed", "F", Feed, "for the pattern"}, event.feed);
  form.number({"speed", "S", Speed, "for the pattern"}, event.speed);
  walk_start_point(form, event.start_x, event.start_z);
}

void walk(Form& form, SingleCut& event) {
  const bool is_turning = event.work == Work::Turning;
  walk_compensation(form, event.compensation);
  form.number({"feed", "F", Feed, "feed of the cut"}, event.feed);
  form.number({"speed", "S", Speed, "speed of the cut"}, event.speed);
  walk_start_point(form, event.start_x, event.start_z);
  walk_cut_end(form, {event.dimensions, event.x, event.u, event.z, event.w});
  walk_taper(form,
             {is_turning ? "i" : "k", is_turning ? "I" : "K", is_turning ? Radius : Length,
              "taper over the cut, signed"},
             event.is_tapered, event.taper);
}

void walk(Form& form, ThreadLine& event) {
  form.number({"x", "X", Diameter, "end"}, event.x);
  form.number({"z", "Z", Length, "end"}, event.z);
  walk_extend_back(form, event.back);
  form.number({"lead", "F", Lead, "advance in one revolution"}, event.lead);
  form.number(Field{"threads_per_unit", "E", Factor, "instead of the lead"}.at_least(0.0001),
              event.threads_per_unit);
  walk_start_angle(form, event.start_angle);
  form.demand(event.x || event.z, "x or z must be given");
  form.demand(event.lead.has_value() != event.threads_per_unit.has_value(),
              "either lead or threads_per_unit must be given");
}

void walk(Form& form, MultipleThread& event) {
  walk_start_point(form, event.start_x, event.start_z);
  walk_size(form, event);
  form.number(Field{"z", "Z", Length, "end of the thread"}.required(), event.z);
  walk_taper(form, {"i", "I", Radius, "taper over the thread, signed"}, event.is_tapered,
             event.taper);
  walk_lead(form, event.lead);
  walk_start_angle(form, event.start_angle);
  walk_chamfer(form, event.chamfer_length, event.chamfer_angle);
  form.number(Field{"first_cut", "D", Radius, "depth of the first cut"}.required().at_least(0),
              event.first_cut);
  form.number(Field{"nose_angle", "A", Angle, "included angle of the tool nose"}
                  .required()
                  .at_least(0.001)
                  .at_most(179),
              event.nose_angle);
  form.number(Field{"minimum_cut", "P130", Radius, "minimum depth of a cut"}.at_least(0),
              event.minimum_cut);
  form.whole({"finish_passes", "P131", Count, "number of passes at full depth"},
             event.finish_passes);
  form.whole(Field{"method", "P", Count,
                   "1, 2: constant amount, 3, 4: constant depth; odd: one edge, even: both"}
                 .required()
                 .at_least(1)
                 .at_most(4),
             event.method);
}

void walk(Form& form, SingleThread& event) {
  walk_start_point(form, event.start_x, event.start_z);
  walk_cut_end(form, {event.dimensions, event.x, event.u, event.z, event.w});
  walk_taper(form, {"i", "I", Radius, "taper over the thread, signed"}, event.is_tapered,
             event.taper);
  walk_lead(form, event.lead);
  walk_start_angle(form, event.start_angle);
  walk_chamfer(form, event.chamfer_length, event.chamfer_angle);
}

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
