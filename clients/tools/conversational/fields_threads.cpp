#include "clients/tools/conversational/impl/walk.hpp"

namespace dripline::conversational {

using enum Quantity;

namespace {

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

}  // namespace

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

}  // namespace dripline::conversational
