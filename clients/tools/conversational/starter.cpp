#include <fmt/format.h>

#include "clients/tools/conversational/catalog.hpp"

namespace dripline::conversational {

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
