#include "clients/tools/conversational/impl/walk.hpp"

namespace dripline::conversational {
namespace {

void walk_start_angle(Form& form, Entry& angle) {
  form.number({.name = "start_angle",
               .word = "Q",
               .quantity = Quantity::Angle,
               .help = "shift of the start, for threads of several starts",
               .min = 0},
              angle);
}

void walk_lead(Form& form, Entry& lead) {
  form.number({.name = "lead",
               .word = "F",
               .quantity = Quantity::Lead,
               .help = "advance in one revolution",
               .is_required = true},
              lead);
}

void walk_chamfer(Form& form, Entry& length, Entry& angle) {
  form.number({.name = "chamfer_length",
               .word = "P103",
               .help = "length of the pull-out at the end",
               .min = 0},
              length);
  form.number({.name = "chamfer_angle",
               .word = "P104",
               .quantity = Quantity::Angle,
               .help = "0: straight out in X",
               .min = 0,
               .max = 90},
              angle);
}

void walk_size(Form& form, MultipleThread& event) {
  form.toggle({.name = "entry", .help = "how the thread is given"}, {"root and height", "crest"},
              event.entry);
  const bool is_crest = event.entry == ThreadEntry::Crest;
  form.number({.name = "crest_x",
               .word = "X",
               .quantity = Quantity::Diameter,
               .help = "diameter at the crest; height and root follow from the nose",
               .is_required = true,
               .applies = is_crest,
               .condition = "entry = crest"},
              event.crest_x);
  form.number({.name = "root_x",
               .word = "X",
               .quantity = Quantity::Diameter,
               .help = "diameter at the root",
               .is_required = true,
               .applies = !is_crest,
               .condition = "entry = root and height"},
              event.root_x);
  form.number({.name = "height",
               .word = "K",
               .quantity = Quantity::Radius,
               .help = "root to crest",
               .is_required = true,
               .applies = !is_crest,
               .condition = "entry = root and height",
               .min = 0},
              event.height);
}

}  // namespace

void walk(Form& form, ThreadLine& event) {
  form.number({.name = "x", .word = "X", .quantity = Quantity::Diameter, .help = "end"}, event.x);
  form.number({.name = "z", .word = "Z", .help = "end"}, event.z);
  walk_extend_back(form, event.back);
  form.number({.name = "lead",
               .word = "F",
               .quantity = Quantity::Lead,
               .help = "advance in one revolution"},
              event.lead);
  form.number({.name = "threads_per_unit",
               .word = "E",
               .quantity = Quantity::Factor,
               .help = "instead of the lead",
               .min = 0.0001},
              event.threads_per_unit);
  walk_start_angle(form, event.start_angle);
  form.demand(event.x || event.z, "x or z must be given");
  form.demand(event.lead.has_value() != event.threads_per_unit.has_value(),
              "either lead or threads_per_unit must be given");
}

void walk(Form& form, MultipleThread& event) {
  walk_start_point(form, event.start_x, event.start_z);
  walk_size(form, event);
  form.number({.name = "z", .word = "Z", .help = "end of the thread", .is_required = true},
              event.z);
  walk_taper(form,
             {.name = "i",
              .word = "I",
              .quantity = Quantity::Radius,
              .help = "taper over the thread, signed"},
             event.is_tapered, event.taper);
  walk_lead(form, event.lead);
  walk_start_angle(form, event.start_angle);
  walk_chamfer(form, event.chamfer_length, event.chamfer_angle);
  form.number({.name = "first_cut",
               .word = "D",
               .quantity = Quantity::Radius,
               .help = "depth of the first cut",
               .is_required = true,
               .min = 0},
              event.first_cut);
  form.number({.name = "nose_angle",
               .word = "A",
               .quantity = Quantity::Angle,
               .help = "included angle of the tool nose",
               .is_required = true,
               .min = 0.001,
               .max = 179},
              event.nose_angle);
  form.number({.name = "minimum_cut",
               .word = "P130",
               .quantity = Quantity::Radius,
               .help = "minimum depth of a cut",
               .min = 0},
              event.minimum_cut);
  form.whole({.name = "finish_passes",
              .word = "P131",
              .quantity = Quantity::Count,
              .help = "number of passes at full depth"},
             event.finish_passes);
  form.whole({.name = "method",
              .word = "P",
              .quantity = Quantity::Count,
              .help = "1, 2: constant amount, 3, 4: constant depth; odd: one edge, even: both",
              .is_required = true,
              .min = 1,
              .max = 4},
             event.method);
}

void walk(Form& form, SingleThread& event) {
  walk_start_point(form, event.start_x, event.start_z);
  walk_cut_end(form, {event.dimensions, event.x, event.u, event.z, event.w});
  walk_taper(form,
             {.name = "i",
              .word = "I",
              .quantity = Quantity::Radius,
              .help = "taper over the thread, signed"},
             event.is_tapered, event.taper);
  walk_lead(form, event.lead);
  walk_start_angle(form, event.start_angle);
  walk_chamfer(form, event.chamfer_length, event.chamfer_angle);
}

}  // namespace dripline::conversational
