#include "clients/tools/conversational/impl/walk.hpp"

namespace dripline::conversational {
namespace {

struct Stocks {
  Entry &x_finish, &z_finish, &x_rough, &z_rough;
};

void walk_stocks(Form& form, const Stocks& stocks) {
  form.number(
      {.name = "x_finish_stock", .word = "U", .quantity = Quantity::Diameter, .help = "signed"},
      stocks.x_finish);
  form.number({.name = "z_finish_stock", .word = "W", .help = "signed"}, stocks.z_finish);
  form.number(
      {.name = "x_rough_stock", .word = "I", .quantity = Quantity::Radius, .help = "signed"},
      stocks.x_rough);
  form.number({.name = "z_rough_stock", .word = "K", .help = "signed"}, stocks.z_rough);
}

}  // namespace

void walk_start_point(Form& form, Entry& x, Entry& z) {
  form.number({.name = "start_x",
               .word = "X",
               .quantity = Quantity::Diameter,
               .help = "where the cycle starts",
               .is_required = true},
              x);
  form.number(
      {.name = "start_z", .word = "Z", .help = "where the cycle starts", .is_required = true}, z);
}

void walk_pattern_number(Form& form, std::optional<int>& pattern) {
  form.whole({.name = "pattern",
              .word = "N",
              .quantity = Quantity::Count,
              .help = "number of the pattern; its labels are N98nn and N99nn",
              .is_required = true,
              .max = 99},
             pattern);
}

void walk_compensation(Form& form, Compensation& compensation) {
  form.toggle({.name = "compensation", .help = "tool nose compensation"}, {"off", "left", "right"},
              compensation);
}

void walk_taper(Form& form, const Field& taper, bool& is_tapered, Entry& value) {
  form.toggle({.name = "taper", .help = "shape of the cut"}, {"straight", "tapered"}, is_tapered);
  Field field = taper;
  field.applies = is_tapered;
  field.is_required = true;
  field.condition = "taper = tapered";
  form.number(field, value);
}

void walk_cut_end(Form& form, const CutEnd& end) {
  form.toggle({.name = "dimensions", .help = "dimensions of the end point"},
              {"absolute", "incremental"}, end.dimensions);
  const bool is_absolute = end.dimensions == Dimensions::Absolute;
  form.number({.name = "x",
               .word = "X",
               .quantity = Quantity::Diameter,
               .help = "end",
               .is_required = true,
               .applies = is_absolute,
               .condition = "dimensions = absolute"},
              end.x);
  form.number({.name = "u",
               .word = "U",
               .quantity = Quantity::Diameter,
               .help = "from the start point",
               .is_required = true,
               .applies = !is_absolute,
               .condition = "dimensions = incremental"},
              end.u);
  form.number({.name = "z",
               .word = "Z",
               .help = "end",
               .is_required = true,
               .applies = is_absolute,
               .condition = "dimensions = absolute"},
              end.z);
  form.number({.name = "w",
               .word = "W",
               .help = "from the start point",
               .is_required = true,
               .applies = !is_absolute,
               .condition = "dimensions = incremental"},
              end.w);
}

void walk(Form& form, RoughCycle& event) {
  const bool is_turning = event.work == Work::Turning;
  walk_stocks(
      form, {event.x_finish_stock, event.z_finish_stock, event.x_rough_stock, event.z_rough_stock});
  form.number({.name = "first_depth",
               .word = "V",
               .quantity = is_turning ? Quantity::Diameter : Quantity::Length,
               .help = is_turning ? "diameter of the first cut" : "Z of the first cut"},
              event.first_depth);
  form.number({.name = "cut_increment",
               .word = "D",
               .quantity = is_turning ? Quantity::Radius : Quantity::Length,
               .help = "from cut to cut, unsigned",
               .is_required = true,
               .min = 0},
              event.cut_increment);
  form.toggle({.name = "relief", .help = "how the tool leaves a cut"}, {"pattern", "45 degrees"},
              event.relief);
  form.number({.name = "clearance",
               .word = "R",
               .quantity = Quantity::Radius,
               .help = "how far the tool pulls away",
               .min = 0},
              event.clearance);
  walk_compensation(form, event.compensation);
  walk_start_point(form, event.start_x, event.start_z);
  walk_pattern_number(form, event.pattern);
}

void walk(Form& form, PatternRepeat& event) {
  walk_stocks(
      form, {event.x_finish_stock, event.z_finish_stock, event.x_rough_stock, event.z_rough_stock});
  form.whole({.name = "passes",
              .word = "D",
              .quantity = Quantity::Count,
              .help = "how often the pattern is followed",
              .is_required = true,
              .min = 1},
             event.passes);
  walk_compensation(form, event.compensation);
  walk_start_point(form, event.start_x, event.start_z);
  walk_pattern_number(form, event.pattern);
}

void walk(Form&, EndCycle&) {}

void walk(Form& form, FinishCycle& event) {
  walk_pattern_number(form, event.pattern);
  form.number({.name = "feed", .word = "F", .quantity = Quantity::Feed, .help = "for the pattern"},
              event.feed);
  form.number(
      {.name = "speed", .word = "S", .quantity = Quantity::Speed, .help = "for the pattern"},
      event.speed);
  walk_start_point(form, event.start_x, event.start_z);
}

void walk(Form& form, SingleCut& event) {
  const bool is_turning = event.work == Work::Turning;
  walk_compensation(form, event.compensation);
  form.number({.name = "feed", .word = "F", .quantity = Quantity::Feed, .help = "feed of the cut"},
              event.feed);
  form.number(
      {.name = "speed", .word = "S", .quantity = Quantity::Speed, .help = "speed of the cut"},
      event.speed);
  walk_start_point(form, event.start_x, event.start_z);
  walk_cut_end(form, {event.dimensions, event.x, event.u, event.z, event.w});
  walk_taper(form,
             {.name = is_turning ? "i" : "k",
              .word = is_turning ? "I" : "K",
              .quantity = is_turning ? Quantity::Radius : Quantity::Length,
              .help = "taper over the cut, signed"},
             event.is_tapered, event.taper);
}

}  // namespace dripline::conversational
