#include <gtest/gtest.h>

#include "gateway/interpreter/core/setup.hpp"
#include "gateway/interpreter/dialects/centurion/memory/control_memory.hpp"
#include "gateway/interpreter/dialects/centurion/memory/parameter_text.hpp"
#include "gateway/interpreter/dialects/centurion/options.hpp"
#include "tests/unit/gateway/interpreter/dialects/centurion/program_run.hpp"

/// The AXIS and POWER pages: CEN-214, CEN-215; and their transfer: CEN-200.
namespace dripline::interpreter::centurion {
namespace {

using ControlSetup = interpreter::Setup;

ControlSetup setup_of(const std::string& toml) {
  auto setup = parse_setup(toml, Units::Inch);
  EXPECT_TRUE(setup) << setup.error().what;
  return *setup;
}

ControlSetup with_machine(const std::string& rows) {
  return setup_of("[control.machine]\n" + rows);
}

TEST(MachineParameters, AreReadAsParametersOfTheirOwn) {
  Parameters parameters;
  const auto setup = with_machine(
      "backlash = { X = 0.0009, Z = 0.0006 }\naxes = 2\n"
      "front_turret = true\nrapid_velocity = { Z = 200 }\n");
  ASSERT_TRUE(load_machine_parameters(setup.control, parameters));
  EXPECT_EQ(parameters[884], 0.0006);
  EXPECT_EQ(parameters[885], 0.0009);
  EXPECT_EQ(parameters[868], 200);
  EXPECT_EQ(parameters[869], 0);
  EXPECT_EQ(parameters[900], 2);
  EXPECT_EQ(parameters[906], 1);
}

TEST(MachineParameters, NumbersAreApartAndWithinTheControls) {
  int last = kLastAxisParameter;
  for (const MachineParameter& row : machine_parameters()) {
    EXPECT_GT(row.number, last) << row.name;
    last = row.number + row.count() - 1;
    EXPECT_LE(row.low, row.high) << row.name;
  }
  EXPECT_EQ(last, kLastMachineParameter);
  EXPECT_LT(last, kParameterCount);
}

TEST(MachineParameters, OutOfRangeAreRefusedByName) {
  const auto refusal = [](const std::string& rows) {
    const auto read = read_options(with_machine(rows));
    return read ? std::string("accepted") : read.error().what;
  };
  EXPECT_EQ(refusal("rapid_ramp = { X = 201 }"),
            "line 2: [control.machine] rapid_ramp: 201 is not a whole number from 1 to 200");
  EXPECT_EQ(refusal("backlash = { Z = -0.1 }"),
            "line 2: [control.machine] backlash: -0.1 is not 0 to 100");
  EXPECT_EQ(refusal("atc_pockets = 2.5"),
            "line 2: [control.machine] atc_pockets: 2.5 is not a whole number from 0 to 24");
  EXPECT_NE(refusal("backlsh = { Z = 0.1 }").find("backlsh: this control has no such parameter"),
            std::string::npos);
  EXPECT_NE(refusal("backlash = 0.1").find("expected both axes or one"), std::string::npos);
  EXPECT_NE(refusal("backlash = { Y = 0.1 }").find("expected both axes or one"), std::string::npos);
  EXPECT_NE(refusal("axes = \"two\"").find("expected a number"), std::string::npos);
  EXPECT_EQ(refusal("axes = 2"), "accepted");
}

/// G20 and G21 convert them with the other tables.
TEST(MachineParameters, LengthsFollowTheUnits) {
  ProgramRun run("P1=P884\nPRINT[#1[04]]\nG21\nP1=P884\nP2=P852\nPRINT[#1[04]]\nPRINT[#2[04]]\n",
                 with_machine("backlash = { Z = 0.5 }\npulses_per_unit = { Z = 4000 }\n"));
  EXPECT_EQ(run.step(), StepState::Ended) << run.alarm();
  EXPECT_EQ(run.printed(), std::vector<std::string>({"0.5000", "12.7000", "4000.0000"}));
}

TEST(Changer, FindsOnlyToolsThatHaveAPocket) {
  const auto verdict = [](const std::string& program, const std::string& tools) {
    ProgramRun run(program, setup_of(tools + "[control.machine]\natc_pockets = 8\n"));
    return run.step() == StepState::Ended ? std::string() : run.alarm();
  };
  EXPECT_EQ(verdict("T0808M6\n", ""), "");
  EXPECT_TRUE(verdict("T0909M6\n", "").starts_with("CEN0452 1:")) << verdict("T0909M6\n", "");
  EXPECT_EQ(verdict("T2121M6\nT0M6\n",
                    "[[tool]]\nnumber = 21\npocket = 3\n[[tool]]\nnumber = 3\n"
                    "pocket = 0\n"),
            "");
  EXPECT_TRUE(verdict("T0303M6\n", "[[tool]]\nnumber = 3\npocket = 0\n").starts_with("CEN0452"));
}

TEST(Changer, RefusesImpossiblePockets) {
  const auto refusal = [](const std::string& tools) {
    const auto read = read_options(setup_of(tools + "[control.machine]\natc_pockets = 8\n"));
    return read ? std::string("accepted") : read.error().what;
  };
  EXPECT_EQ(refusal("[[tool]]\nnumber = 21\npocket = 9\n"), "tool 21: pocket 9 is not 0 to 8");
  EXPECT_EQ(refusal("[[tool]]\nnumber = 21\npocket = 3\n"), "tools 3 and 21: both in pocket 3");
}

TEST(CannedCycles, AreUndefinedWhenNotLoaded) {
  const std::string text = "G98 F10 M3 S500\nG0 X0 Z1\nG81 R.1 Z-1\n";
  ProgramRun without(text, with_machine("no_canned_cycles = true\n"));
  EXPECT_EQ(without.step(), StepState::Alarmed);
  EXPECT_TRUE(without.alarm().starts_with("CEN0502 3:")) << without.alarm();
  ProgramRun with(text, with_machine("no_canned_cycles = false\n"));
  EXPECT_EQ(with.step(), StepState::Ended);
}

constexpr const char* kSetup = R"(
units = "mm"
[[tool]]
number = 3
X = 12.5
Z = -40
radius = 0.8
tip = 3
wear = { X = 0.01, Z = -0.02, radius = 0.005 }
[[offset]]
name = "G55"
X = 0
Z = -120.5
[[variable]]
name = "P7"
value = 2.25
[control]
home = { X = 100, Z = 50 }
reference = [{ X = 90, Z = 40 }, { X = 80, Z = 30 }]
maximum_feed = { X = 3000, Z = 5000 }
[control.machine]
backlash = { X = 0.02, Z = 0.015 }
atc_pockets = 12
)";

/// A setup, its parameters on the line, and a setup again: the control's memory is the same.
TEST(ParameterText, RestoresTheSameMemory) {
  const auto memory = [](const ControlSetup& setup) {
    ModalState state;
    Parameters parameters;
    EXPECT_TRUE(load_memory(setup, state, parameters));
    return parameters;
  };
  const ControlSetup before = setup_of(kSetup);
  const auto text = write_parameter_text(before);
  ASSERT_TRUE(text) << text.error().what;
  const auto toml = setup_of_parameter_text(*text);
  ASSERT_TRUE(toml) << toml.error().what;
  const auto after = parse_control_data(*toml, Units::Inch);
  ASSERT_TRUE(after) << after.error().what << "\n" << *toml;
  const Parameters first = memory(before), second = memory(*after);
  for (int number = 0; number < kParameterCount; ++number)
    EXPECT_NEAR(first[number], second[number], 1e-9) << "P" << number;
}

/// The text is a program: an empty control has all parameters after executing it.
TEST(ParameterText, IsAProgramThatSetsThem) {
  auto text = write_parameter_text(setup_of(kSetup));
  ASSERT_TRUE(text);
  text->insert(text->find("M30"),
               "P1=P502 P2=P503 P3=P621 P4=P885 P5=P905\n"
               "PRINT[#1[03] #2[03] #3[03] #4[03] #5[01] #7[02]]\n");
  ProgramRun run(*text);
  EXPECT_EQ(run.step(), StepState::Ended) << run.alarm();
  EXPECT_EQ(run.printed(), std::vector<std::string>({"-120.500 0.000 12.500 0.020 12.0 2.25"}));
}

TEST(ParameterText, NamesTheLineItCannotRead) {
  const auto refusal = [](const std::string& text) {
    const auto read = setup_of_parameter_text(std::string(kOwnNumbering) + "\n" + text);
    return read ? std::string("accepted") : read.error().what;
  };
  EXPECT_EQ(refusal("G21\nG10\nP500=1.5\nX3\n"),
            "line 5: \"X3\": expected P and a number = a value");
  EXPECT_EQ(refusal("P700=1\n"), "accepted");
  EXPECT_EQ(refusal("P607=1\n"), "line 2: P607 is none of the parameters that a setup keeps");
  EXPECT_EQ(refusal("P500=1e5\n"), "line 2: \"P500=1e5\": expected P and a number = a value");
  EXPECT_EQ(refusal("%\nO77 (NAME)\n( ALL )\n p 500 = -1.5 \r\nM30\n%\n"), "accepted");
}

/// The control's numbers of tables and pages are not known: a file of a control is not
/// interpreted by guess, and one of ours states in its first line that it is none.
TEST(ParameterText, RefusesAnUnknownNumbering) {
  const auto refused = setup_of_parameter_text("G20\nP7=1\nG10\nP500=1.5\nG11\n");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().what,
            "line 4: P500: the control's numbers from P200 on are not known: a map says which is "
            "which (--map FILE, deploy/examples/centurion-parameters.map)");
  EXPECT_TRUE(setup_of_parameter_text("G20\nP7=1\nP199=2\nG10\nG11\n"));
  const auto text = write_parameter_text(setup_of(kSetup));
  ASSERT_TRUE(text);
  EXPECT_TRUE(text->starts_with("(DRIPLINE'S OWN NUMBERS OF PARAMETERS: NOT FOR A CONTROL)\nG2"));
}

TEST(ParameterMap, GivesAControlItsOwnNumbers) {
  const auto map = read_parameter_map("# filled in\nP502 = P7012  # G55 Z\nP503 =\np500=p7010\n");
  ASSERT_TRUE(map) << map.error().what;
  const std::string offset =
      "units = \"mm\"\n[[variable]]\nname = \"P7\"\nvalue = 2.25\n"
      "[[offset]]\nname = \"G55\"\nZ = -120.5\n";
  const auto text = write_parameter_text(setup_of(offset), &*map);
  ASSERT_TRUE(text) << text.error().what;
  EXPECT_EQ(*text, "G21\nP7=2.25\nP188=1\nP189=1\nG10\nP7010=0\nP7012=-120.5\nG11\nM30\n");
  const auto back = setup_of_parameter_text(*text, &*map);
  ASSERT_TRUE(back) << back.error().what;
  EXPECT_NE(back->find("name = \"G55\"\nX = 0\nZ = -120.5"), std::string::npos) << *back;
  EXPECT_EQ(setup_of_parameter_text("G10\nP502=1\nG11\n", &*map).error().what,
            "line 2: P502 has no row in the map");
  EXPECT_EQ(write_parameter_text(setup_of(offset + "X = 1.5\n"), &*map).error().what,
            "P503, which is 1.5, has no row in the map");
}

TEST(ParameterMap, NamesTheRowThatIsWrong) {
  const auto refusal = [](const std::string& text) {
    const auto read = read_parameter_map(text);
    return read ? std::string("accepted") : read.error().what;
  };
  EXPECT_EQ(refusal("P500 = 7012\n"), "line 1: \"P500 = 7012\": expected a row as P500 = P7012");
  EXPECT_EQ(refusal("P500\n"), "line 1: \"P500\": expected a row as P500 = P7012");
  EXPECT_EQ(refusal("P500 = P300\nP501 = P300\n"), "line 2: P501 = P300 besides P500 = P300");
  EXPECT_EQ(refusal("P607 = P300\n"),
            "line 1: P607 is none of Dripline's numbers of tables and pages (P500 and on)");
  EXPECT_EQ(refusal("P500 = P12\n"), "line 1: P12 is a parameter of programs, P0 to P199");
  EXPECT_EQ(refusal("P500 =\n"), "the map has no row as P500 = P7012");
}

}  // namespace
}  // namespace dripline::interpreter::centurion
