#include "clients/tools/conversational/catalog.hpp"

#include <fmt/format.h>

namespace dripline::conversational {

namespace {

/// Lists the fields that the walk shows it; the event stays unchanged.
class FormLister : public Form {
 public:
  explicit FormLister(EventDescription& description) : description_(description) {}

  void number(const Field& field, Entry&) override { add(FieldKind::Number, field); }
  void whole(const Field& field, std::optional<int>&) override { add(FieldKind::Whole, field); }
  void text(const Field& field, std::string&) override { add(FieldKind::Text, field); }
  void feedrate(const Field& field, Feedrate& entry) override {
    add(FieldKind::Feedrate, field).blank = entry.is_rapid ? "rapid" : "";
  }
  void choice(const Field& field, std::span<const std::string_view> names,
              std::size_t& index) override {
    auto& added = add(FieldKind::Choice, field);
    added.choices.assign(names.begin(), names.end());
    added.blank = names[index];
  }
  void demand(bool, std::string_view text) override { description_.rules.emplace_back(text); }
  void set_units(UnitSystem) override {}

 private:
  FieldDescription& add(FieldKind kind, const Field& field) {
    FieldDescription added;
    added.kind = kind;
    added.name = field.name;
    added.word = field.word;
    added.help = field.help;
    added.condition = field.condition;
    added.is_required = field.is_required;
    const bool is_text = kind == FieldKind::Text;
    added.english = is_text ? Limits{0, field.max, 0} : limits_of(field, UnitSystem::English);
    added.metric = is_text ? Limits{0, field.max, 0} : limits_of(field, UnitSystem::Metric);
    return description_.fields.emplace_back(std::move(added));
  }
  EventDescription& description_;
};

}  // namespace

std::string_view to_string(FieldKind kind) {
  constexpr std::string_view kWords[] = {"number", "whole", "text", "feed or rapid", "choice"};
  return kWords[static_cast<std::size_t>(kind)];
}

std::vector<EventDescription> describe_events() {
  std::vector<EventDescription> all;
  for (const auto& kind : event_kinds()) {
    EventDescription description{std::string(kind.type), std::string(kind.title), {}, {}};
    FormLister lister(description);
    Event event = kind.blank;
    walk_fields(lister, event);
    all.push_back(std::move(description));
  }
  return all;
}

std::string starter_file(int program) {
  return fmt::format(R"(# Events of a conversational program for the Centurion lathe.
#
#   dnc conversational events              every event with its fields, limits and defaults
#   dnc conversational post FILE -o OUT    the program text the control makes of this file
#   dnc check --control centurion OUT      the program, interpreted
#
# One [[event]] each, in the order of the program; the first is the program_setup, the last the
# end_of_program. An omitted field is a blank field: it posts nothing. X positions are diameters.
# Numbers may be fractions in quotes: x = "5/16".

[[event]]
type = "program_setup"
program = {}                # O number, 1 to 9999
name = "STEPPED PIN"
dimensions = "absolute"     # or "incremental"
units = "english"           # or "metric"; the unit of every field below
material_length = 2
material_diameter = 1.25

[[event]]
type = "tool_change"
tool = 1
description = "ROUGHING"
feed_per = "revolution"     # or "minute"
feed = 0.012
spindle = "surface speed"   # or "rpm"
maximum_speed = 2500
speed = 450
restart = "cw"
coolant = "on"

# The pattern between rough_turning and end_cycle is the finished shape. It starts with a move in X
# to where the shape begins.
[[event]]
type = "rough_turning"
x_finish_stock = 0.01
z_finish_stock = 0.004
x_rough_stock = 0
z_rough_stock = 0
cut_increment = "1/16"
relief = "pattern"          # or "45 degrees"
clearance = 0.02
compensation = "off"        # or "left", "right"
start_x = 1.3
start_z = 0.1
pattern = 1

[[event]]
type = "line"
feed = "rapid"
x = "5/8"

[[event]]
type = "line"
feed = 0.006
z = -0.75
corner = "round"            # or "chamfer", with chamfer_length
corner_radius = 0.05

[[event]]
type = "line"
x = 1
z = -1

[[event]]
type = "line"
x = 1.3

[[event]]
type = "end_cycle"

[[event]]
type = "finish_turning"
pattern = 1
feed = 0.005
speed = 600
start_x = 1.3
start_z = 0.1

[[event]]
type = "end_of_program"     # spindle and coolant off; x and z from machine zero, blank: no move
)",
                     program);
}

}  // namespace dripline::conversational
