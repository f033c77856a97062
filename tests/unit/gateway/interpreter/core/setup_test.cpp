#include "gateway/interpreter/core/setup.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gateway/interpreter/core/machine_data.hpp"

namespace dripline::interpreter {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

Setup read(std::string_view toml, Units units = Units::Millimeter) {
  auto setup = parse_setup(toml, units);
  EXPECT_TRUE(setup) << setup.error().what;
  return setup ? *std::move(setup) : Setup{};
}

std::string problem(std::string_view toml) {
  const auto setup = parse_setup(toml);
  if (setup) return "no error";
  EXPECT_EQ(setup.error().code, Errc::Syntax);
  return setup.error().what;
}

TEST(Setup, AnEmptyFileIsADefaultSetup) {
  const auto setup = read("");
  EXPECT_FALSE(setup.units);
  EXPECT_TRUE(setup.start.same_point(Position{}));
  EXPECT_FALSE(setup.date_time);
  EXPECT_TRUE(setup.workpiece.empty());
  EXPECT_TRUE(setup.control.empty());
}

TEST(Setup, TheMachineIsReadInTheUnitsOfTheFile) {
  const auto parsed = parse_machine_data(R"(
units = "in"
[machine]
X = { min = -10.0, max = 0, rate = 100 }
C = { min = -180.0, max = 180.0 }
max_rpm = 12000
homing = true
)");
  ASSERT_TRUE(parsed) << parsed.error().what;
  const MachineData& machine = *parsed;
  ASSERT_TRUE(machine.axes[0]);
  EXPECT_DOUBLE_EQ(*machine.axes[0]->min, -254);
  EXPECT_DOUBLE_EQ(*machine.axes[0]->max_rate, 2540);
  EXPECT_FALSE(machine.axes[1]);
  EXPECT_DOUBLE_EQ(*machine.axes[5]->max, 180) << "degrees";
  EXPECT_EQ(machine.max_rpm, 12000);
  EXPECT_EQ(machine.homing, true);
  EXPECT_FALSE(parse_machine_data("")->homing);
  EXPECT_FALSE(parse_machine_data("[machine]\nX = 3"));
}

TEST(Setup, AMachineThatCannotBeIsAnError) {
  EXPECT_THAT(problem("[machine]\nX = { min = 0.0 }"),
              HasSubstr("machine.X.min: the travel has both"));
  EXPECT_THAT(problem("[machine]\nX = { min = 5, max = 5 }"), HasSubstr("is not below max"));
  EXPECT_THAT(problem("[machine]\nX = { rate = 0 }"), HasSubstr("expected a number above 0"));
  EXPECT_THAT(problem("[machine]\nmax_rpm = -1"), HasSubstr("machine.max_rpm"));
  EXPECT_THAT(problem("[machine]\nQ = { rate = 1 }"), HasSubstr("machine.Q: is not a key"));
}

TEST(Setup, EveryKeyOfASetupFileIsRead) {
  const auto setup = read(R"(
start = { X = 1.0, Z = 2, C = 90 }
units = "in"
switches = { block_skip = true, optional_stop = true, mirror = ["X", "Y"], single_block = true, dry_run = true }
date_time = "1993-12-17T12:51:52"
answers = ["16.4856", "6.0"]
[[tool]]
number = 1
length = 5.0
radius = 0.25
tip = 3
[[tool]]
number = 2
X = 1.0
Z = 2.0
wear = { X = 0.001, Z = 0.002, radius = 0.003 }
[[offset]]
name = "G54"
Z = 1.5
[[variable]]
name = "P10"
value = 1.25
[probe]
surface = [ { axis = "Z", at = -0.5 } ]
[library]
path = "subprograms/"
)");
  EXPECT_EQ(setup.units, Units::Inch);
  EXPECT_DOUBLE_EQ(setup.start.linear(Axis::X).inch(), 1);
  EXPECT_DOUBLE_EQ(setup.start.rotary(Axis::C).degrees(), 90);
  EXPECT_FALSE(setup.start.has(Axis::Y));
  EXPECT_TRUE(setup.switches.block_skip && setup.switches.optional_stop);
  EXPECT_TRUE(setup.switches.single_block && setup.switches.dry_run);
  EXPECT_THAT(setup.switches.mirror, ElementsAre(Axis::X, Axis::Y));
  ASSERT_TRUE(setup.date_time);
  EXPECT_EQ(setup.date_time->year, 1993);
  EXPECT_EQ(setup.date_time->second, 52);
  EXPECT_THAT(setup.answers, ElementsAre("16.4856", "6.0"));
  ASSERT_EQ(setup.tools.size(), 2U);
  EXPECT_DOUBLE_EQ(setup.tools[0].length.linear(Axis::Z).inch(), 5);
  EXPECT_DOUBLE_EQ(setup.tools[0].radius.inch(), 0.25);
  EXPECT_EQ(setup.tools[0].tip, 3);
  EXPECT_DOUBLE_EQ(setup.tools[1].length.linear(Axis::X).inch(), 1);
  EXPECT_DOUBLE_EQ(setup.tools[1].wear.linear(Axis::Z).inch(), 0.002);
  EXPECT_DOUBLE_EQ(setup.tools[1].radius_wear.inch(), 0.003);
  EXPECT_EQ(setup.offsets.at(0).name, "G54");
  EXPECT_DOUBLE_EQ(setup.offsets.at(0).value.linear(Axis::Z).inch(), 1.5);
  EXPECT_EQ(setup.variables.at(0).name, "P10");
  EXPECT_EQ(setup.variables.at(0).value, 1.25) << "a variable is not a length";
  EXPECT_EQ(setup.library_path, "subprograms/");
}

TEST(Setup, LengthsAreInTheFilesUnitsOrTheControls) {
  EXPECT_DOUBLE_EQ(read("start = { X = 2 }").start.linear(Axis::X).mm(), 2);
  EXPECT_DOUBLE_EQ(read("start = { X = 2 }", Units::Inch).start.linear(Axis::X).mm(), 50.8);
  EXPECT_DOUBLE_EQ(
      read("start = { X = 2 }\nunits = \"mm\"", Units::Inch).start.linear(Axis::X).mm(), 2);
}

TEST(Setup, ADateMayBeWithoutQuotes) {
  EXPECT_EQ(read("date_time = 2001-02-03T04:05:06").date_time->minute, 5);
}

Position at(double x, double y, double z) {
  Position position;
  position.set(Axis::X, Length::mm(x));
  position.set(Axis::Y, Length::mm(y));
  position.set(Axis::Z, Length::mm(z));
  return position;
}

TEST(Setup, SurfacesAreProbed) {
  const Workpiece turned = read("[probe]\nsurface = [{ profile = [[0, 5], [10, -5]] }]").workpiece;
  const auto on_cone = turned.probe(at(4, 0, 20), at(4, 0, -20), ProbeUntil::Contact);
  EXPECT_NEAR(on_cone.at.linear(Axis::Z).mm(), 1, 1e-9);
  const Workpiece same = read("[probe]\nprofile = [[0, 5], [10, -5]]").workpiece;
  EXPECT_TRUE(same.probe(at(4, 0, 20), at(4, 0, -20), ProbeUntil::Contact).tripped);
  const Workpiece bore =
      read("[probe]\nsurface = [{ cylinder = { center = { X = 1, Y = 2 }, radius = 3 } }]")
          .workpiece;
  const auto wall = bore.probe(at(1, 2, 0), at(9, 2, 0), ProbeUntil::Contact);
  EXPECT_NEAR(wall.at.linear(Axis::X).mm(), 4, 1e-9);
}

TEST(Setup, AnUnknownKeyIsNamedWithItsLine) {
  EXPECT_THAT(problem("units = \"in\"\nspeed = 3"), AllOf(HasSubstr("line 2"), HasSubstr("speed")));
  EXPECT_THAT(problem("[[tool]]\nnumber = 1\nlenght = 5"),
              AllOf(HasSubstr("line 3"), HasSubstr("lenght"), HasSubstr("length")));
  EXPECT_THAT(problem("[probe]\nsurface = [{ axis = \"Z\", at = 1, color = 2 }]"),
              HasSubstr("color"));
  EXPECT_THAT(problem("[switches]\nblock = true"), HasSubstr("switches.block"));
  EXPECT_THAT(problem("start = { Q = 1 }"), HasSubstr("start.Q"));
  EXPECT_THAT(problem("[[tool]]\nnumber = 1\nwear = { tip = 1 }"), HasSubstr("wear.tip"));
}

TEST(Setup, AWrongValueIsNamedWithItsLine) {
  EXPECT_THAT(problem("\nunits = \"feet\""), AllOf(HasSubstr("line 2"), HasSubstr("units")));
  EXPECT_THAT(problem("start = { X = \"1\" }"), HasSubstr("start.X"));
  EXPECT_THAT(problem("start = { X = nan }"), HasSubstr("start.X"));
  EXPECT_THAT(problem("start = { X = inf }"), HasSubstr("start.X"));
  EXPECT_THAT(problem("start = 1"), HasSubstr("expected a table"));
  EXPECT_THAT(problem("answers = [1.5]"), HasSubstr("answers"));
  EXPECT_THAT(problem("switches = { mirror = [\"Q\"] }"), HasSubstr("mirror"));
  EXPECT_THAT(problem("switches = { dry_run = 1 }"), HasSubstr("dry_run"));
  EXPECT_THAT(problem("date_time = \"1993-02-30T00:00:00\""), HasSubstr("date_time"));
  EXPECT_THAT(problem("date_time = \"yesterday\""), HasSubstr("date_time"));
  EXPECT_THAT(problem("[[tool]]\nnumber = -1"), HasSubstr("number"));
  EXPECT_THAT(problem("[[tool]]\nnumber = 1.5"), HasSubstr("number"));
  EXPECT_THAT(problem("[[tool]]\nnumber = 1\ntip = 10"), HasSubstr("0 to 9"));
  EXPECT_THAT(problem("tool = 5"), HasSubstr("tool"));
  EXPECT_THAT(problem("[probe]\nsurface = [{ axis = \"C\", at = 1 }]"), HasSubstr("axis"));
  EXPECT_THAT(problem("[probe]\nsurface = [{ profile = [[1, 2]] }]"), HasSubstr("two points"));
  EXPECT_THAT(problem("[probe]\nsurface = [{ profile = [[1, 2], [1]] }]"), HasSubstr("profile"));
  EXPECT_THAT(problem("[probe]\ncylinder = { radius = 0 }"), HasSubstr("radius"));
  EXPECT_THAT(problem("[control]\nwhen = 2001-01-01"), HasSubstr("control.when"));
  EXPECT_THAT(problem("[library]\npath = \"\""), HasSubstr("library.path"));
}

TEST(Setup, WhatIsMissingOrDoubleIsAnError) {
  EXPECT_THAT(problem("[[tool]]\nradius = 1"), AllOf(HasSubstr("number"), HasSubstr("missing")));
  EXPECT_THAT(problem("[[offset]]\nX = 1"), HasSubstr("name"));
  EXPECT_THAT(problem("[[variable]]\nname = \"P1\""), HasSubstr("value"));
  EXPECT_THAT(problem("[probe]\nsurface = [{ axis = \"Z\" }]"), HasSubstr("at"));
  EXPECT_THAT(problem("[[tool]]\nnumber = 1\n[[tool]]\nnumber = 1"), HasSubstr("twice"));
  EXPECT_THAT(problem("[[offset]]\nname = \"G54\"\n[[offset]]\nname = \"G54\""),
              HasSubstr("twice"));
  EXPECT_THAT(problem("[[tool]]\nnumber = 1\nlength = 1\nZ = 1"), HasSubstr("either"));
}

TEST(Setup, BrokenTomlIsAnErrorWithTheLine) {
  EXPECT_THAT(problem("units = \"in\"\nstart = {"), HasSubstr("line 2"));
  EXPECT_THAT(problem("\xFF\xFE"), HasSubstr("line 1"));
  EXPECT_EQ(parse_setup(std::string(2 << 20, '#')).error().code, Errc::LimitExceeded);
}

TEST(Options, AreReadInTheirKinds) {
  const Options options = read(R"(
units = "in"
[control]
circular = true
depth = 4
leading = 2.5
clearance = 0.5
stored_x = "diameter"
pins = [1000, 1001]
custom_g = 501
reference = [{ X = 1, Z = 2 }, { Z = 3, C = 4 }]
tool_change = { X = 1 }
)")
                              .control;
  EXPECT_TRUE(*options.flag("circular", false));
  EXPECT_EQ(*options.integer("depth", 0), 4);
  EXPECT_EQ(*options.number("depth", 0), 4);
  EXPECT_EQ(*options.number("leading", 0), 2.5);
  EXPECT_DOUBLE_EQ(options.length("clearance", {})->inch(), 0.5);
  EXPECT_EQ(*options.choice("stored_x", {"radius", "diameter"}, 0), 1U);
  EXPECT_THAT(*options.integers("pins"), ElementsAre(1000, 1001));
  EXPECT_THAT(*options.integers("custom_g"), ElementsAre(501));
  const auto points = options.positions("reference");
  ASSERT_EQ(points->size(), 2U);
  EXPECT_DOUBLE_EQ((*points)[1].linear(Axis::Z).inch(), 3);
  EXPECT_DOUBLE_EQ((*points)[1].rotary(Axis::C).degrees(), 4);
  EXPECT_TRUE(options.position("tool_change")->has(Axis::X));
  EXPECT_EQ(options.positions("tool_change")->size(), 1U);
}

TEST(Options, AbsentOnesGiveTheFallback) {
  const Options options;
  EXPECT_TRUE(*options.flag("a", true));
  EXPECT_EQ(*options.integer("a", 7), 7);
  EXPECT_EQ(*options.text("a", "x"), "x");
  EXPECT_EQ(*options.choice("a", {"one", "two"}, 1), 1U);
  EXPECT_TRUE(options.integers("a")->empty());
  EXPECT_TRUE(options.positions("a")->empty());
}

TEST(Options, WrongKindsAndUnknownOnesAreErrorsWithTheLine) {
  const Options options =
      read("[control]\nstored_x = \"both\"\npins = [\"a\"]\ndepth = 1.5").control;
  const auto choice = options.choice("stored_x", {"radius", "diameter"}, 0);
  ASSERT_FALSE(choice);
  EXPECT_THAT(choice.error().what, AllOf(HasSubstr("line 2"), HasSubstr("radius, diameter")));
  EXPECT_FALSE(options.integers("pins"));
  EXPECT_FALSE(options.integer("depth", 0));
  EXPECT_FALSE(options.flag("depth", false));
  EXPECT_FALSE(options.position("depth"));
  const auto known = options.check_known({"stored_x", "pins"});
  ASSERT_FALSE(known);
  EXPECT_EQ(known.error().code, Errc::Unsupported);
  EXPECT_THAT(known.error().what, AllOf(HasSubstr("depth"), HasSubstr("line 4")));
  EXPECT_TRUE(options.check_known({"stored_x", "pins", "depth"}));
}

}  // namespace
}  // namespace dripline::interpreter
