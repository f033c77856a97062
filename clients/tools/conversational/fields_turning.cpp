#include "clients/tools/conversational/impl/walk.hpp"

namespace dripline::conversational {

using enum Quantity;

namespace {

struct Stocks {
  Entry &x_finish, &z_finish, &x_rough, &z_rough;
};

void walk_stocks(Form& form, const Stocks& stocks) {
  form.number({"x_finish_stock", "U", Diameter, "signed"}, stocks.x_finish);
  form.number({"z_finish_stock", "W", Length, "signed"}, stocks.z_finish);
  form.number({"x_rough_stock", "I", Radius, "signed"}, stocks.x_rough);
  form.number({"z_rough_stock", "K", Length, "signed"}, stocks.z_rough);
}

}  // namespace

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

void walk_taper(Form& form, const Field& taper, bool& is_tapered, Entry& value) {
  form.toggle({.name = "taper", .help = "shape of the cut"}, {"straight", "tapered"}, is_tapered);
  form.number(taper.required().only(is_tapered, "taper = tapered"), value);
}

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

}  // namespace dripline::conversational
