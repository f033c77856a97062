#include "clients/tools/offline/trace_writer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace dripline::interpreter {
namespace {

class TraceWriterTest : public testing::Test {
 protected:
  /// The lines written since the last call.
  std::string written() {
    writer.flush();
    return std::exchange(text, {});
  }
  void begin(Units units = Units::Inch, bool x_is_diameter = false) {
    writer.on_program({"centurion", "O0100", units, x_is_diameter});
    written();
  }
  static Position to(double x, double z) {
    Position position;
    position.set(Axis::X, Length::inch(x));
    position.set(Axis::Z, Length::inch(z));
    return position;
  }
  static Origin at(std::uint64_t line, std::int64_t sequence = Origin::kNone) {
    Origin origin;
    origin.line = line;
    origin.sequence = sequence;
    return origin;
  }

  std::string text;
  TraceWriter writer{[this](std::string_view lines) { text += lines; }};
};

TEST_F(TraceWriterTest, TheHeaderSaysControlNameAndUnits) {
  writer.on_program({"centurion", "O0100", Units::Inch, true});
  EXPECT_EQ(written(),
            "{\"event\":\"program\",\"control\":\"centurion\",\"name\":\"O0100\",\"units\":\"in\","
            "\"x\":\"diameter\"}\n");
  writer.on_program({"tnc155", std::nullopt, Units::Millimeter, false});
  EXPECT_EQ(written(),
            "{\"event\":\"program\",\"control\":\"tnc155\",\"name\":null,\"units\":\"mm\"}\n");
}

TEST_F(TraceWriterTest, MovesCarryLineBlockTargetAndFeed) {
  begin();
  writer.on_rapid({at(3), to(1, 2)});
  EXPECT_EQ(written(),
            "{\"event\":\"rapid\",\"line\":3,\"block\":null,\"to\":{\"X\":1,\"Z\":2}}\n");
  writer.on_line({at(4, 10), to(1.25, -2), Feed::per_minute(Length::inch(8))});
  EXPECT_EQ(written(),
            "{\"event\":\"feed\",\"line\":4,\"block\":\"10\",\"to\":{\"X\":1.25,\"Z\":-2},"
            "\"feed\":{\"value\":8,\"per\":\"min\"}}\n");
  writer.on_line({at(5), to(0, 0), Feed::per_revolution(Length::inch(0.01))});
  EXPECT_THAT(written(), testing::HasSubstr("\"feed\":{\"value\":0.01,\"per\":\"rev\"}"));
  writer.on_line({at(5), to(0, 1), Feed::inverse_time(2.5)});
  EXPECT_THAT(written(), testing::HasSubstr("\"feed\":{\"value\":2.5,\"per\":\"move\"}"));
}

TEST_F(TraceWriterTest, XIsDoubledWhereItIsADiameter) {
  begin(Units::Inch, true);
  writer.on_rapid({at(1), to(1, 2)});
  EXPECT_THAT(written(), testing::HasSubstr("{\"X\":2,\"Z\":2}"));
  Arc arc{at(2),
          to(2, 1),
          Length::inch(1),
          Length::inch(1.5),
          Plane::ZX,
          Turn::Counterclockwise,
          Angle::degrees(90),
          Feed::per_minute(Length::inch(5))};
  writer.on_arc(arc);
  EXPECT_EQ(written(),
            "{\"event\":\"arc\",\"line\":2,\"block\":null,\"to\":{\"X\":4,\"Z\":1},"
            "\"center\":{\"X\":3,\"Z\":1},\"plane\":\"ZX\",\"direction\":\"ccw\",\"sweep\":90,"
            "\"feed\":{\"value\":5,\"per\":\"min\"}}\n");
}

TEST_F(TraceWriterTest, EveryAxisThatHasMovedIsListedFromThenOn) {
  begin();
  Position first;
  first.set(Axis::Z, Length::inch(1));
  writer.on_rapid({at(1), first});
  EXPECT_THAT(written(), testing::HasSubstr("\"to\":{\"Z\":1}"));
  Position second;
  second.set(Axis::X, Length::inch(2));
  second.set(Axis::C, Angle::degrees(90));
  second.set_raw(Axis::Z, 25.4);
  writer.on_rapid({at(2), second});
  EXPECT_THAT(written(), testing::HasSubstr("\"to\":{\"X\":2,\"Z\":1,\"C\":90}"));
}

TEST_F(TraceWriterTest, NoMoveIsNotPrintedButAFullCircleIs) {
  begin();
  writer.on_rapid({at(1), to(0, 0)});
  EXPECT_EQ(written(), "");
  writer.on_rapid({at(1), to(1, 0)});
  written();
  writer.on_line({at(2), to(1, 0), Feed{}});
  writer.on_thread({at(2), to(1, 0), Length::inch(0.1), std::nullopt});
  writer.on_line({at(2), to(1 + 1e-12, 0), Feed{}});
  EXPECT_EQ(written(), "");
  writer.on_arc({at(3), to(1, 0), {}, {}, Plane::ZX, Turn::Clockwise, Angle::degrees(360), Feed{}});
  EXPECT_THAT(written(), testing::HasSubstr("\"sweep\":360"));
}

TEST_F(TraceWriterTest, TheStartDecidesWhetherTheFirstMoveMoves) {
  std::string lines;
  TraceWriter started([&](std::string_view part) { lines += part; }, to(1, 2));
  started.on_program({"centurion", std::nullopt, Units::Inch, false});
  started.on_rapid({at(1), to(1, 2)});
  started.on_rapid({at(2), to(0, 0)});
  started.flush();
  EXPECT_EQ(std::count(lines.begin(), lines.end(), '\n'), 2);
}

TEST_F(TraceWriterTest, AChangeOfUnitsConvertsWhatFollows) {
  begin();
  writer.on_units({at(2), Units::Millimeter});
  writer.on_line({at(3), to(1, 2), Feed::per_minute(Length::mm(100))});
  EXPECT_EQ(written(),
            "{\"event\":\"units\",\"line\":2,\"block\":null,\"units\":\"mm\"}\n"
            "{\"event\":\"feed\",\"line\":3,\"block\":null,\"to\":{\"X\":25.4,\"Z\":50.8},"
            "\"feed\":{\"value\":100,\"per\":\"min\"}}\n");
}

TEST_F(TraceWriterTest, AProbeIsPrintedOnceItHasItsResult) {
  begin();
  Probe probe{at(7, 1), to(0, 0), to(0, -6), ProbeUntil::Contact, Feed{}, std::nullopt};
  writer.on_probe(probe);
  EXPECT_EQ(written(), "");
  probe.result = ProbeResult{true, to(0, -0.5)};
  writer.on_probe(probe);
  EXPECT_EQ(written(),
            "{\"event\":\"probe\",\"line\":7,\"block\":\"1\",\"to\":{\"X\":0,\"Z\":-6},\"until\":"
            "\"contact\",\"result\":{\"tripped\":true,\"at\":{\"X\":0,\"Z\":-0.5}}}\n");
  writer.on_rapid({at(8), to(0, -0.5)});
  EXPECT_EQ(written(), "") << "the machine is where the probe stopped";
}

TEST_F(TraceWriterTest, OtherEventsHaveTheirMembers) {
  begin();
  const auto expect = [&](std::string_view members) {
    EXPECT_EQ(written(), "{\"event\":" + std::string(members) + "}\n");
  };
  writer.on_thread({at(1), to(1, -2), Length::inch(0.125), Angle::degrees(30)});
  expect(R"("thread","line":1,"block":null,"to":{"X":1,"Z":-2},"lead":0.125,"start_angle":30)");
  writer.on_dwell({at(1), 2.5, std::nullopt});
  expect(R"("dwell","line":1,"block":null,"seconds":2.5)");
  writer.on_dwell({at(1), 0, 3.0});
  expect(R"("dwell","line":1,"block":null,"revolutions":3)");
  writer.on_spindle({at(1), SpindleState::Clockwise, 1200, std::nullopt, std::nullopt});
  expect(R"("spindle","line":1,"block":null,"state":"cw","speed":1200)");
  writer.on_spindle({at(1), SpindleState::Counterclockwise, 0, Length::inch(12 * 400), 3000.0});
  expect(R"("spindle","line":1,"block":null,"state":"ccw","surface_speed":400,"max_speed":3000)");
  writer.on_coolant({at(1), true, false});
  expect(R"("coolant","line":1,"block":null,"flood":true,"mist":false)");
  writer.on_tool({at(1), 5, false, 7});
  expect(R"("tool","line":1,"block":null,"number":5,"offset":7)");
  writer.on_tool({at(1), 6, true, std::nullopt});
  expect(R"("tool","line":1,"block":null,"next":6)");
  writer.on_tool({at(1), 6, false, std::nullopt, ToolShape{Length::mm(1), Length::mm(2)}});
  expect(R"("tool","line":1,"block":null,"number":6)");
  writer.on_blank({at(1), Axis::Y, to(0, -2), to(3, 0)});
  expect(R"("blank","line":1,"block":null,"axis":"Y","min":{"X":0,"Y":0,"Z":-2},)"
         R"("max":{"X":3,"Y":0,"Z":0})");
  writer.on_miscellaneous({at(1), 62});
  expect(R"("misc","line":1,"block":null,"code":62)");
  writer.on_pin({at(1), Axis::Z, 3, true, 250.0});
  expect(R"("pin","line":1,"block":null,"axis":"Z","output":3,"state":1,"pulse_ms":250)");
  writer.on_open({at(1), OutputDevice::File, "REPORT.DAT"});
  expect(R"("open","line":1,"block":null,"device":"file","name":"REPORT.DAT")");
  writer.on_output({at(1), OutputDevice::Port2, "X1.5"});
  expect(R"("output","line":1,"block":null,"device":"port2","text":"X1.5")");
  writer.on_close({at(1), OutputDevice::Printer});
  expect(R"("close","line":1,"block":null,"device":"printer")");
  writer.on_message({at(1), "LOAD \"A\""});
  expect(R"("message","line":1,"block":null,"text":"LOAD \"A\"")");
  writer.on_prompt({at(1), "DIAMETER", "P1", "2.5"});
  expect(R"("prompt","line":1,"block":null,"text":"DIAMETER","variable":"P1","answer":"2.5")");
  writer.on_stop({at(1), StopKind::ToolChange});
  expect(R"("stop","line":1,"block":null,"kind":"tool_change")");
  writer.on_warning({at(1), {"CEN1", "odd", 1, 0}});
  expect(R"("warning","line":1,"block":null,"code":"CEN1","text":"odd")");
}

TEST_F(TraceWriterTest, EndAndAlarmAreHandedOverAtOnce) {
  begin();
  writer.on_end({at(9, 90), 12, true});
  EXPECT_EQ(text,
            "{\"event\":\"end\",\"line\":9,\"block\":\"90\",\"blocks\":12,\"rewind\":true}\n");
  text.clear();
  writer.on_alarm({at(9), {"CEN501", "unknown address", 9, 3}});
  EXPECT_EQ(text,
            "{\"event\":\"alarm\",\"line\":9,\"block\":null,\"code\":\"CEN501\",\"text\":"
            "\"unknown address\"}\n");
}

TEST_F(TraceWriterTest, LongTracesAreHandedOverInWholeLines) {
  std::size_t pieces = 0;
  std::size_t lines = 0;
  TraceWriter many([&](std::string_view part) {
    ++pieces;
    EXPECT_EQ(part.back(), '\n');
    lines += static_cast<std::size_t>(std::count(part.begin(), part.end(), '\n'));
  });
  many.on_program({"centurion", std::nullopt, Units::Inch, false});
  for (int i = 1; i <= 5000; ++i) {
    many.on_line({at(1), to(i, -i), Feed::per_minute(Length::inch(8))});
  }
  many.flush();
  EXPECT_EQ(lines, 5001U);
  EXPECT_GT(pieces, 5U);
}

}  // namespace
}  // namespace dripline::interpreter
