#include "gateway/interpreter/dialects/tnc155/memory/memory_files.hpp"

#include <gtest/gtest.h>

#include "gateway/interpreter/core/dialects.hpp"
#include "gateway/interpreter/core/program_source.hpp"
#include "gateway/interpreter/dialects/tnc155/options.hpp"

// Rows: HD-067 (tool store), HD-068 (special tools), HD-234 (both files on the line).
namespace dripline::interpreter::tnc155 {
namespace {

ToolRecord tool(int number, double length, double radius) {
  ToolRecord record;
  record.number = number;
  record.length.set(Axis::Z, Length::mm(length));
  record.radius = Length::mm(radius);
  return record;
}

TEST(ToolStore, IsWrittenALineATool) {
  std::vector<ToolRecord> tools{tool(3, 81.25, 5), tool(4, -2.5, 10), tool(99, 0, 0)};
  tools[0].pocket = 12;
  tools[1].pocket = 20;
  tools[1].is_special = true;
  EXPECT_EQ(*write_tool_store(tools, Units::Millimeter),
            "0 BEGIN PGM 0 MM\r\n"
            "T3 P12 L+81,250 R+5,000\r\n"
            "T4 SP20 L-2,500 R+10,000\r\n"
            "T99 P L+0,000 R+0,000\r\n"
            "4 END PGM 0 MM\r\n");
}

TEST(ToolStore, ComesBackAsItWas) {
  std::vector<ToolRecord> tools{tool(1, 25.4, 12.7), tool(17, 100.0014, 3.175)};
  tools[0].pocket = 7;
  for (const Units units : {Units::Millimeter, Units::Inch}) {
    const std::string text = *write_tool_store(tools, units);
    const auto read = read_tool_store(text);
    ASSERT_TRUE(read) << read.error().what;
    ASSERT_EQ(read->size(), 2u);
    EXPECT_EQ(read->at(0).pocket, 7);
    EXPECT_FALSE(read->at(1).pocket);
    EXPECT_NEAR(read->at(0).length.linear(Axis::Z).mm(), 25.4, 1e-9);
    EXPECT_NEAR(read->at(1).radius.mm(), 3.175, 1e-9);
    EXPECT_EQ(*write_tool_store(*read, units), text);
  }
}

TEST(ToolStore, TakesPointsAndBlanks) {
  const auto read = read_tool_store("BEGIN PGM 0 INCH\nT 9 P 12 L +1.5000 R +0.2500\n\n");
  ASSERT_TRUE(read) << read.error().what;
  EXPECT_NEAR(read->at(0).radius.mm(), 6.35, 1e-9);
}

TEST(ToolStore, HasTheDecimalSignThatTheControlIsSetTo) {
  EXPECT_EQ(*write_tool_store({tool(7, 1.5, 0.25)}, Units::Millimeter, '.'),
            "0 BEGIN PGM 0 MM\r\nT7 P L+1.500 R+0.250\r\n2 END PGM 0 MM\r\n");
}

TEST(ToolStore, NamesWhatIsWrong) {
  EXPECT_EQ(read_tool_store("T0 P L+1 R+1").error().code, Errc::LimitExceeded);
  EXPECT_EQ(read_tool_store("T100 P L+1 R+1").error().code, Errc::LimitExceeded);
  const auto twice = read_tool_store("T5 P L+1 R+1\nT5 P L+2 R+1\n");
  ASSERT_FALSE(twice);
  EXPECT_EQ(twice.error().what, "line 2: tool 5 is there twice");
  EXPECT_FALSE(read_tool_store("T5 P L+1\n"));
  EXPECT_FALSE(read_tool_store("T5 P L+1 R+1 X\n"));
  EXPECT_EQ(write_tool_store({tool(100, 0, 0)}, Units::Millimeter).error().code,
            Errc::LimitExceeded);
}

TEST(MachineParameters, AreALineEach) {
  const MachineParameters parameters{{0, 0}, {7, 1.5}, {226, 1819}, {236, -3}};
  const std::string text = write_machine_parameters(parameters);
  EXPECT_EQ(text, "MP0: 0\r\nMP7: 1.5\r\nMP226: 1819\r\nMP236: -3\r\n");
  EXPECT_EQ(*read_machine_parameters(text), parameters);
  EXPECT_EQ(read_machine_parameters("MP237: 0").error().code, Errc::LimitExceeded);
  EXPECT_EQ(read_machine_parameters("MP1: 0\nMP1: 0").error().what, "line 2: MP1 is there twice");
  EXPECT_FALSE(read_machine_parameters("MP1 0"));
  EXPECT_FALSE(read_machine_parameters("MP1: x"));
}

// HD-234: kept in a setup, and sent to the control as they are.
TEST(MachineParameters, AreAnOptionOfASetup) {
  const auto of = [](const std::string& text) {
    return machine_parameters_of(parse_setup("[control.machine_parameters]\n" + text)->control);
  };
  EXPECT_EQ(*of("MP71 = 515\nMP7 = 1.5\n"), (MachineParameters{{7, 1.5}, {71, 515}}));
  EXPECT_EQ(of("MP237 = 1\n").error().what,
            "option machine_parameters, line 2: MP237: there are MP0 to MP236");
  EXPECT_EQ(of("MP7 = true\n").error().what,
            "option machine_parameters, line 2: MP7 is not a number");
  EXPECT_EQ(of("P7 = 1\n").error().what,
            "option machine_parameters, line 2: \"P7\": expected MP and a number");
  EXPECT_TRUE(machine_parameters_of(Options{})->empty());
}

// HD-238: 225 to 234 came with software 03, 235 and 236 with 06; a TNC 151 has them all.
TEST(MachineParameters, AreThoseThatTheControlHas) {
  const auto kept = [](const std::string& control) {
    const auto read = machine_parameters_of(parse_setup("[control]\n" + control)->control);
    return read ? "" : read.error().what;
  };
  const auto read = [](const std::string& text, const std::string& control) {
    const auto version = version_of(parse_setup("[control]\n" + control)->control);
    const auto taken = read_machine_parameters(text, *version);
    return taken ? "" : taken.error().what;
  };
  const std::string lacks_225 =
      "a TNC 155 A with software 02 has no machine parameters 225 to 234 (from software 03)";
  const std::string lacks_235 =
      "a TNC 155 A with software 05 has no machine parameters 235 and 236 (from software 06)";
  EXPECT_EQ(kept("software = 2\nmachine_parameters = { MP224 = 1, MP225 = 1 }"),
            "option machine_parameters, line 3: MP225: " + lacks_225);
  EXPECT_EQ(kept("software = 3\nmachine_parameters = { MP225 = 1, MP234 = 1 }"), "");
  EXPECT_EQ(kept("software = 5\nmachine_parameters = { MP235 = 1 }"),
            "option machine_parameters, line 3: MP235: " + lacks_235);
  EXPECT_EQ(kept("software = 6\nmachine_parameters = { MP236 = 1 }"), "");
  EXPECT_EQ(kept("software = 1\nmodel = \"TNC 151 A\"\nmachine_parameters = { MP236 = 1 }"), "");
  EXPECT_EQ(read("MP224: 1\nMP234: 2\n", "software = 2"), "line 2: MP234: " + lacks_225);
  EXPECT_EQ(read("MP236: 2\n", "software = 5"), "line 1: MP236: " + lacks_235);
  EXPECT_EQ(read("MP225: 1\nMP236: 2\n", "software = 6"), "");
}

// HD-238
TEST(ToolStore, CameWithSoftware03) {
  const std::string text = "T5 P L+1 R+1";
  EXPECT_EQ(read_tool_store(text, *version_of(parse_setup("[control]\nsoftware = 2")->control))
                .error()
                .what,
            "a TNC 155 A with software 02 has no central tool store (from software 03)");
  EXPECT_TRUE(read_tool_store(text, *version_of(parse_setup("[control]\nsoftware = 3")->control)));
}

// HD-067
TEST(ToolStore, OfASetupHas99Tools) {
  const auto made = [](const std::string& text) {
    MemorySource source("");
    EventSink sink;
    return kTnc155Dialect.make(*parse_setup(text), source, sink).error().what;
  };
  EXPECT_EQ(made("[[tool]]\nnumber = 100\n[control]\ncentral_tool_file = true\n"),
            "central_tool_file: tool 100: the store has tools 1 to 99");
  EXPECT_EQ(made("[[tool]]\nnumber = 255\n"), "tool 255: this control has tools 1 to 254");
}

// HD-228: a start over the network says it so.
TEST(ControlOptionsOfATnc, TakeTheBlockAStartBeginsAt) {
  const auto of = [](const std::string& text) {
    interpreter::Setup setup;
    setup.control.set("start_at", {text, 0});
    return read_options(setup);
  };
  EXPECT_EQ(of("N400")->start_block, 400);
  EXPECT_EQ(of("65534")->start_block, 65'534);
  EXPECT_EQ(of("L7").error().what,
            "option start_at: \"L7\" is no block of this control: it goes to N0 to N65534");
  EXPECT_FALSE(of("N65535"));
}

// What is wrong is reported with its value and its limit.
TEST(ControlOptionsOfATnc, NameTheValueAndTheLimit) {
  const auto wrong = [](const std::string& option) {
    return read_options(*parse_setup("[control]\n" + option)).error().what;
  };
  EXPECT_EQ(wrong("probe_feed = 0"), "option probe_feed: 0 is not more than 0");
  EXPECT_EQ(wrong("probe_travel = -1"), "option probe_travel: -1 is less than 0");
  EXPECT_EQ(wrong("start_block = 65535"),
            "option start_block: 65535 is not a number from -1 to 65534");
  EXPECT_EQ(wrong("spindle_maximum = 40000"), "option spindle_maximum: 40000 is not 0 to 30000");
  EXPECT_EQ(wrong("spindle_minimum = 500\nspindle_maximum = 100"),
            "option spindle_minimum: 500 is more than spindle_maximum, 100");
  EXPECT_EQ(wrong("limit_low = { X = 5 }\nlimit_high = { X = 2 }"),
            "option limit_low: X 5 is above limit_high, 2");
}

}  // namespace
}  // namespace dripline::interpreter::tnc155
