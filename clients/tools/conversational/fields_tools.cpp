#include "clients/tools/conversational/impl/miscellaneous_codes.hpp"
#include "clients/tools/conversational/impl/walk.hpp"

namespace dripline::conversational {

void walk(Form& form, ProgramSetup& event) {
  form.whole({.name = "program",
              .word = "O",
              .quantity = Quantity::Count,
              .help = "number of the program",
              .is_required = true,
              .min = 1},
             event.program);
  form.text({.name = "name",
             .quantity = Quantity::Comment,
             .help = "up to 60 characters without parentheses",
             .max = 60},
            event.name);
  form.toggle({.name = "dimensions", .help = "dimensions of the program"},
              {"absolute", "incremental"}, event.dimensions);
  form.toggle({.name = "units", .help = "units of the program and of every field"},
              {"english", "metric"}, event.units);
  form.set_units(event.units);
  form.number({.name = "material_length",
               .word = "P",
               .help = "from the chuck face to Z0, for the graphics"},
              event.material_length);
  form.number({.name = "material_diameter",
               .word = "P",
               .quantity = Quantity::Diameter,
               .help = "for the graphics"},
              event.material_diameter);
}

void walk(Form& form, ToolSelection& event) {
  form.whole({.name = "tool",
              .word = "T",
              .quantity = Quantity::Count,
              .help = "tool and offset number",
              .is_required = true,
              .max = 24},
             event.tool);
  form.text({.name = "description",
             .quantity = Quantity::Comment,
             .help = "shown at the change",
             .applies = event.is_change,
             .condition = "not posted by a tool call",
             .max = 60},
            event.description);
  form.toggle({.name = "feed_per", .help = "unit of feeds"}, {"revolution", "minute"},
              event.feed_mode);
  form.number({.name = "feed",
               .word = "F",
               .quantity = Quantity::Feed,
               .help = "in force from this event on"},
              event.feed);
  form.toggle({.name = "spindle", .help = "constant surface speed or revolutions per minute"},
              {"surface speed", "rpm"}, event.spindle_mode);
  form.number({.name = "maximum_speed",
               .word = "RPM",
               .quantity = Quantity::Speed,
               .help = "limit at constant surface speed"},
              event.maximum_speed);
  form.number(
      {.name = "speed", .word = "S", .quantity = Quantity::Speed, .help = "in the spindle's unit"},
      event.speed);
  form.toggle({.name = "restart", .help = "start the spindle after the change"},
              {"none", "cw", "ccw"}, event.restart);
  form.toggle({.name = "coolant", .help = "after the change"}, {"off", "on"}, event.has_coolant);
}

void walk(Form& form, Miscellaneous& event) {
  const auto choose = [&](std::string_view name, std::string_view help, const auto& choices,
                          std::size_t& index) {
    const auto names = names_of(choices);
    form.choice({.name = name, .help = help}, names, index);
  };
  choose("feed_per", "unit of feeds", kFeedModes, event.feed_mode);
  form.number({.name = "feed",
               .word = "F",
               .quantity = Quantity::Feed,
               .help = "in force from this event on"},
              event.feed);
  choose("spindle_mode", "unit of speeds", kSpindleModes, event.spindle_mode);
  form.number({.name = "speed",
               .word = "S",
               .quantity = Quantity::Speed,
               .help = "in force from this event on"},
              event.speed);
  choose("gear", "range of the spindle", kGears, event.gear);
  choose("spindle", "direction", kSpindles, event.spindle);
  choose("coolant", "flood", kCoolants, event.coolant);
  choose("compensation", "tool nose compensation", kCompensations, event.compensation);
  choose("stop", "wait for CYCLE START", kStops, event.stop);
  choose("retract", "to the clearances or the tool change position", kRetracts, event.retract);
  choose("cutting_mode", "at the ends of moves", kCuttingModes, event.cutting_mode);
  choose("program_mode", "dimensions", kProgramModes, event.program_mode);
  choose("work_coordinate", "offset 1 to 6", kWorkCoordinates, event.work_coordinate);
  choose("option", "optional functions of the machine", kOptionalFunctions, event.option);
  form.text({.name = "text",
             .quantity = Quantity::Text,
             .help = "a block as typed, up to 70 characters",
             .max = 70},
            event.text);
}

void walk(Form& form, ProgramCall& event) {
  form.whole({.name = "program",
              .word = "O",
              .quantity = Quantity::Count,
              .help = "number of the program",
              .is_required = true,
              .min = 1},
             event.program);
  form.whole({.name = "repeats",
              .word = "L",
              .quantity = Quantity::Count,
              .help = "number of calls; blank: one",
              .min = 1},
             event.repeats);
}

void walk(Form& form, Scaling& event) {
  form.toggle({.name = "state", .help = "switch scaling"}, {"off", "on"}, event.is_on);
  const std::string_view condition = "state = on";
  form.number({.name = "i",
               .word = "I",
               .quantity = Quantity::Diameter,
               .help = "center in X; blank: the last one",
               .applies = event.is_on,
               .condition = condition},
              event.center_x);
  form.number({.name = "k",
               .word = "K",
               .help = "center in Z; blank: the last one",
               .applies = event.is_on,
               .condition = condition},
              event.center_z);
  form.number({.name = "x",
               .word = "X",
               .quantity = Quantity::Factor,
               .help = "factor of X",
               .applies = event.is_on,
               .condition = condition},
              event.x_factor);
  form.number({.name = "z",
               .word = "Z",
               .quantity = Quantity::Factor,
               .help = "factor of Z",
               .applies = event.is_on,
               .condition = condition},
              event.z_factor);
}

void walk(Form& form, Rotation& event) {
  form.toggle({.name = "state", .help = "switch rotation"}, {"off", "on"}, event.is_on);
  const std::string_view condition = "state = on";
  form.number({.name = "x",
               .word = "X",
               .quantity = Quantity::Diameter,
               .help = "center",
               .applies = event.is_on,
               .condition = condition},
              event.x);
  form.number(
      {.name = "z", .word = "Z", .help = "center", .applies = event.is_on, .condition = condition},
      event.z);
  form.number({.name = "aa",
               .word = "AA",
               .quantity = Quantity::Angle,
               .help = "ccw positive",
               .is_required = true,
               .applies = event.is_on,
               .condition = condition},
              event.angle);
}

void walk(Form& form, Mirror& event) {
  form.toggle({.name = "state", .help = "switch mirror image"}, {"off", "on"}, event.is_on);
  const std::string_view condition = "state = on";
  form.number({.name = "x",
               .word = "X",
               .quantity = Quantity::Diameter,
               .help = "X of the mirror line",
               .applies = event.is_on,
               .condition = condition},
              event.x);
  form.number({.name = "z",
               .word = "Z",
               .help = "Z of the mirror line",
               .applies = event.is_on,
               .condition = condition},
              event.z);
  form.demand(!event.is_on || event.x || event.z, "x or z must be given");
}

void walk(Form& form, FloatingZero& event) {
  form.number({.name = "x",
               .word = "X",
               .quantity = Quantity::Diameter,
               .help = "new coordinate of the current position"},
              event.x);
  form.number({.name = "z", .word = "Z", .help = "new coordinate of the current position"},
              event.z);
  form.demand(event.x || event.z, "x or z must be given");
}

void walk(Form& form, EndOfProgram& event) {
  form.toggle({.name = "spindle_off", .help = "stop the spindle"}, {"no", "yes"},
              event.stops_spindle);
  form.toggle({.name = "coolant_off", .help = "stop the coolant"}, {"no", "yes"},
              event.stops_coolant);
  form.number({.name = "x",
               .word = "X",
               .quantity = Quantity::Diameter,
               .help = "from machine zero; blank: no move"},
              event.x);
  form.number({.name = "z", .word = "Z", .help = "from machine zero; blank: no move"}, event.z);
}

}  // namespace dripline::conversational
