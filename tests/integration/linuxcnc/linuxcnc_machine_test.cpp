// What the operator does, and what is not motion.
#include "tests/integration/linuxcnc/linuxcnc_shop.hpp"

namespace dripline::integration {
namespace {

using interpreter::StopKind;

TEST_F(LinuxCncTest, HoldsResumesAndAborts) {
  begin();
  for (int i = 1; i <= 300; ++i) program->line(i, 0, 6000);
  ASSERT_TRUE(wait([&] { return recorder.blocks.size() > 5; }));
  for (int i = 0; i < 4; ++i) {
    machine->hold();
    ASSERT_TRUE(rests());
    const double held_at = x();
    ASSERT_TRUE(wait([&] { return !machine->is_moving(); }));
    EXPECT_EQ(machine->state(), MachineState::Held);
    EXPECT_TRUE(machine->resume());
    ASSERT_TRUE(wait([&] { return x() > held_at + 10; })) << i;
  }
  machine->abort();
  ASSERT_TRUE(wait_over());
  EXPECT_EQ(machine->state(), MachineState::Aborted);
  ASSERT_TRUE(rests());
  EXPECT_LT(x(), 299);
  EXPECT_LE(recorder.blocks.back(), static_cast<std::uint64_t>(x()) + 1);
  EXPECT_GE(recorder.blocks.back() + 1, static_cast<std::uint64_t>(x()));
  runs = false;
  ASSERT_TRUE(wait([&] { return refusal(machine->status().position).empty(); })) << refusal();
  begin();  // the position is kept
  program->line(10, 0, 6000);
  program->end();
  ASSERT_TRUE(wait_over());
  EXPECT_EQ(machine->state(), MachineState::Completed) << alarm();
  ASSERT_TRUE(rests()) << "the witness has written what it saw";
  EXPECT_NEAR(x(), 10, 0.001);
}

TEST_F(LinuxCncTest, ExecutesWhatIsNotMotionBetweenTheMoves) {
  begin();
  program->line(5, 0, 6000);
  program->spindle(1000);
  const auto& origin = program->begin_block();
  machine->events().on_coolant({origin, true, true});
  machine->events().on_tool({.origin = origin, .number = 2, .offset = {}});
  machine->events().on_pin({origin, interpreter::Axis::X, 1, true, std::nullopt});
  program->end_block();
  program->dwell(0.3);
  program->output("x5");
  program->line(7, 0, 6000);
  program->stop();
  program->line(9, 0, 6000);
  program->end();
  ASSERT_TRUE(wait([&] { return machine->state() == MachineState::ProgramStop || is_over(); }));
  ASSERT_EQ(machine->state(), MachineState::ProgramStop) << alarm();
  ASSERT_TRUE(rests());
  EXPECT_NEAR(x(), 7, 0.001) << "the stop waits for the motion before it, and holds the rest";
  const auto status = machine->status();
  EXPECT_NEAR(status.spindle_rpm, 1000, 1e-6) << "a tool change stops LinuxCNC's spindle";
  EXPECT_TRUE(status.flood && status.mist);
  EXPECT_EQ(status.tool, 2);
  EXPECT_TRUE(machine->resume());
  ASSERT_TRUE(wait_over());
  EXPECT_THAT(recorder.lines,
              testing::ElementsAre("block 1", "spindle", "block 2", "coolant true true", "tool 2",
                                   "pin 1 true", "block 3", "block 4", "output x5", "block 5",
                                   "block 6", "stop", "block 7", "block 8", "block 9", "end"));
}

// What a program reads as #<_hal[...]>: a pin of the running HAL, after a move that changed it.
TEST_F(LinuxCncTest, ReadsHalPins) {
  begin();
  program->line(5, 0, 6000);
  ASSERT_TRUE(wait([&] { return machine->drained() && !machine->is_moving(); })) << alarm();
  const auto read = [&](const std::string& name) {
    std::optional<interpreter::SignalValue> value;
    EXPECT_TRUE(wait([&] {
      value = machine->signal(name);
      return value.has_value();
    }));
    return value.value_or(interpreter::SignalValue{});
  };
  const auto at = read("axis.x.pos-cmd");
  ASSERT_TRUE(at.value) << at.reason;
  EXPECT_NEAR(*at.value, 5, 0.001);
  EXPECT_EQ(read("motion.motion-enabled").value, 1.0) << "a bit";
  const auto nothing = read("no.such-pin");
  EXPECT_FALSE(nothing.value);
  EXPECT_FALSE(nothing.reason.empty());
  EXPECT_EQ(machine->inputs().size(), 32U);
  program->line(7, 0, 6000);
  program->end();
  ASSERT_TRUE(wait_over());
  EXPECT_EQ(machine->state(), MachineState::Completed) << alarm() << ": reading stops nothing";
}

TEST_F(LinuxCncTest, ProbesAndContinuesFromTheContact) {
  begin();
  program->line(5, 0, 6000);
  machine->begin_probe({.origin = program->begin_block(),
                        .from = {},
                        .to = machine::test::Program::at(5, -150),
                        .feed = Feed::per_minute(Length::mm(6000)),
                        .result = {}});
  ASSERT_TRUE(wait([&] { return !recorder.probes.empty() || is_over(); })) << alarm();
  ASSERT_EQ(recorder.probes.size(), 1U) << alarm();
  const auto result = recorder.probes.front().result;
  EXPECT_TRUE(result->tripped);
  EXPECT_NEAR(result->at.raw(interpreter::Axis::Z), -100, 0.3)
      << "the table, a period's travel off";
  ASSERT_TRUE(rests());
  EXPECT_NEAR(z(), result->at.raw(interpreter::Axis::Z), 0.001);
  program->end_block();
  machine->begin_probe({.origin = program->begin_block(),
                        .from = {},
                        .to = machine::test::Program::at(5, -150),
                        .feed = Feed::per_minute(Length::mm(6000)),
                        .result = {}});
  ASSERT_TRUE(wait([&] { return recorder.probes.size() > 1 || is_over(); })) << alarm();
  const auto again = recorder.probes.back().result;
  EXPECT_TRUE(again->tripped) << "it is in contact";
  EXPECT_EQ(again->at.raw(interpreter::Axis::Z), result->at.raw(interpreter::Axis::Z));
  program->end_block();
  program->line(5, -50, 6000);
  machine->begin_probe({.origin = program->begin_block(),
                        .from = {},
                        .to = machine::test::Program::at(5, -60),
                        .feed = Feed::per_minute(Length::mm(3000)),
                        .result = {}});
  ASSERT_TRUE(wait([&] { return recorder.probes.size() > 2 || is_over(); }));
  EXPECT_FALSE(recorder.probes.back().result->tripped) << alarm();
  program->end_block();
  program->line(5, 0, 6000);
  program->end();
  ASSERT_TRUE(wait_over());
  EXPECT_EQ(machine->state(), MachineState::Completed) << alarm();
  ASSERT_TRUE(rests());
  EXPECT_NEAR(z(), 0, 0.001);
}

// Off the surface the axes brake past the edge, and come back to it.
TEST_F(LinuxCncTest, MovesOffASurfaceAndContinuesFromItsEdge) {
  begin();
  const auto probe = [&](double to, interpreter::ProbeUntil until) {
    const std::size_t before = recorder.probes.size();
    machine->begin_probe({.origin = program->begin_block(),
                          .from = {},
                          .to = machine::test::Program::at(0, to),
                          .until = until,
                          .feed = Feed::per_minute(Length::mm(6000)),
                          .result = {}});
    EXPECT_TRUE(wait([&] { return recorder.probes.size() > before || is_over(); })) << alarm();
    program->end_block();
    return recorder.probes.size() > before ? *recorder.probes.back().result
                                           : interpreter::ProbeResult{};
  };
  for (int pass = 0; pass < 3; ++pass) {
    const auto touched = probe(-150, interpreter::ProbeUntil::Contact);
    ASSERT_TRUE(touched.tripped) << alarm();
    const auto released = probe(0, interpreter::ProbeUntil::Release);
    ASSERT_TRUE(released.tripped) << alarm();
    EXPECT_NEAR(released.at.raw(interpreter::Axis::Z), -100, 0.3);
    ASSERT_TRUE(rests());
    EXPECT_NEAR(z(), released.at.raw(interpreter::Axis::Z), 0.001);
  }
  program->line(0, 0, 6000);
  program->end();
  ASSERT_TRUE(wait_over());
  EXPECT_EQ(machine->state(), MachineState::Completed) << alarm();
}

TEST_F(LinuxCncTest, StopsAfterEveryBlockInSingleBlock) {
  auto panel = machine->panel();
  panel.single_block = true;
  machine->set_panel(panel);
  begin();
  for (int i = 1; i <= 3; ++i) program->line(2.0 * i, 0, 6000);
  program->end();
  for (int i = 1; i <= 3; ++i) {
    ASSERT_TRUE(wait([&] { return machine->state() == MachineState::SingleBlock; })) << alarm();
    EXPECT_EQ(machine->status().executed, static_cast<std::uint64_t>(i));
    EXPECT_NEAR(machine->status().position.raw(interpreter::Axis::X), 2.0 * i, 1e-6);
    EXPECT_TRUE(machine->resume());
  }
  ASSERT_TRUE(wait_over());
}

TEST_F(LinuxCncTest, TakesOverridesAndAnOptionalStop) {
  auto panel = machine->panel();
  panel.feed_override = 0.25;
  panel.optional_stop = true;
  machine->set_panel(panel);
  begin();
  program->line(40, 0, 6000);  // 100 mm/s
  program->stop(StopKind::Optional);
  program->end();
  double fastest = 0;
  ASSERT_TRUE(wait([&] {
    fastest = std::max(fastest, machine->status().feed_per_minute);
    return machine->state() == MachineState::OptionalStop || is_over();
  }));
  EXPECT_EQ(machine->state(), MachineState::OptionalStop) << alarm();
  EXPECT_NEAR(fastest, 1500, 15);
  EXPECT_TRUE(machine->resume());
  ASSERT_TRUE(wait_over());
}

TEST_F(LinuxCncTest, RefusesAStartWhereSetupAndMachineDisagree) {
  EXPECT_EQ(refusal(machine::test::Program::at(3, 0)), "X is at 0.000, the setup begins at 3.000");
  interpreter::Position with_a;
  with_a.set_raw(interpreter::Axis::A, 5);
  EXPECT_EQ(refusal(with_a), "the setup begins at A 5, the machine has no such axis");
  begin();
  program->line(5, 0, 6000);
  program->line(500, 0, 6000);
  program->end();
  ASSERT_TRUE(wait_over());
  EXPECT_NE(alarm().find("MCH0001 X 500 mm is outside the machine's travel of -400 to 400"),
            std::string::npos)
      << alarm();
  ASSERT_TRUE(rests());
  EXPECT_NEAR(x(), 5, 0.001) << "everything before it is executed";
}

}  // namespace
}  // namespace dripline::integration
