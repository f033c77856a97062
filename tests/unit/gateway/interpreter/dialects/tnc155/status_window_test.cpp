#include <gtest/gtest.h>
#include <tuple>

#include "gateway/interpreter/core/program_source.hpp"
#include "gateway/interpreter/core/setup.hpp"
#include "gateway/interpreter/registry.hpp"

/// What the status window shows of datum, ROT, SCL, mirrored axes, CC and the tool's axis, and the
/// position display's program coordinates. Rows: HD-082, HD-084.
namespace dripline::interpreter {
namespace {

/// Keeps where the last move led.
struct LastPlace final : EventSink {
  CoordinateFrame::Values at{};
  void on_line(const Line& event) override { take(event.to); }
  void on_arc(const Arc& event) override { take(event.to); }
  void take(const Position& to) {
    for (std::size_t i = 0; i < at.size(); ++i) at[i] = to.raw(static_cast<Axis>(i));
  }
};

/// A program within BEGIN PGM 7 and END PGM 7; block numbers are put in front.
class WindowRun {
 public:
  explicit WindowRun(const std::vector<std::string>& blocks, const std::string& setup = "")
      : text_(text_of(blocks)), source_(text_) {
    auto parsed = parse_setup(setup, Units::Millimeter);
    EXPECT_TRUE(parsed) << parsed.error().what;
    auto made = (*find_dialect("tnc155"))->make(*parsed, source_, place_);
    EXPECT_TRUE(made) << made.error().what;
    interpreter_ = *std::move(made);
    EXPECT_EQ(interpreter_->step(1), StepState::Ran);  // BEGIN PGM
  }
  void step(int blocks) {
    for (int i = 0; i < blocks; ++i) EXPECT_EQ(interpreter_->step(1), StepState::Ran);
  }
  StepState step() { return interpreter_->step(1); }
  CoordinateFrame frame() const { return interpreter_->frame().value(); }
  ActiveModes modes() const { return interpreter_->modes(); }
  std::uint32_t changes() const { return modes().frame_changes; }
  Interpreter& interpreter() { return *interpreter_; }
  /// Where the last move led, as the program says it.
  CoordinateFrame::Values programmed() const { return frame().to_program(place_.at); }

 private:
  static std::string text_of(const std::vector<std::string>& blocks) {
    std::string text = "0 BEGIN PGM 7 MM\n";
    int number = 0;
    for (const std::string& block : blocks) text += std::to_string(++number) + " " + block + "\n";
    return text + std::to_string(number + 1) + " END PGM 7 MM\n";
  }
  std::string text_;
  MemorySource source_;
  LastPlace place_;
  std::unique_ptr<Interpreter> interpreter_;
};

const std::vector<std::string> kTransformed{
    "TOOL DEF 1 L+0 R+4",     "TOOL CALL 1 Z S800",     "CYCL DEF 7.0 DATUM SHIFT",
    "CYCL DEF 7.1 X+10",      "CYCL DEF 7.2 Y+20",      "CYCL DEF 8.0 MIRROR IMAGE",
    "CYCL DEF 8.1 X",         "CYCL DEF 10.0 ROTATION", "CYCL DEF 10.1 ROT +30",
    "CYCL DEF 11.0 SCALING",  "CYCL DEF 11.1 SCL 0,5",  "CC X+1 Y+2",
    "L X+3 Y+4 Z+5 R0 F500 M"};

const char* const kDatumAndRotation =
    "[[offset]]\nname = \"datum\"\nX = 100\nY = 50\nZ = 10\n[control]\nbasic_rotation = 12\n";

TEST(TncStatusWindow, ShowsWhatIsInForce) {
  WindowRun run(kTransformed, kDatumAndRotation);
  EXPECT_FALSE(run.modes().tool_axis);
  EXPECT_EQ(run.frame().pole_axes, 0) << "no CC yet";
  run.step(13);
  const CoordinateFrame frame = run.frame();
  EXPECT_EQ(frame.datum[0], 100);
  EXPECT_EQ(frame.datum[2], 10);
  EXPECT_EQ(frame.shift[0], 10);
  EXPECT_EQ(frame.shift[1], 20);
  EXPECT_EQ(frame.rotation, 30);
  EXPECT_EQ(frame.basic_rotation, 12);
  EXPECT_EQ(frame.mirrored, (std::array<bool, 3>{true, false, false}));
  EXPECT_EQ(frame.scale[0], 0.5);
  EXPECT_EQ(frame.scale[1], 0.5);
  EXPECT_EQ(frame.pole_axes, 3) << "X and Y";
  EXPECT_EQ(frame.pole[0], 1);
  EXPECT_EQ(frame.pole[1], 2);
  EXPECT_EQ(run.modes().tool_axis, Axis::Z);
}

TEST(TncStatusWindow, KnowsProgramCoordinatesUnderEveryTransformation) {
  WindowRun run(kTransformed, kDatumAndRotation);
  run.step(13);
  const auto at = run.programmed();
  EXPECT_NEAR(at[0], 3, 1e-9);
  EXPECT_NEAR(at[1], 4, 1e-9);
  EXPECT_NEAR(at[2], 5, 1e-9);
  WindowRun shifted({"CYCL DEF 7.0 DATUM SHIFT", "CYCL DEF 7.1 X+10", "L X+3 Y+4 R0 F500 M"});
  shifted.step(3);
  EXPECT_EQ(shifted.programmed()[0], 3);
  EXPECT_EQ(shifted.programmed()[1], 4);
}

TEST(TncStatusWindow, OtherAxesLieAtTheirDatum) {
  WindowRun run({"L C+750 R0 F900", "L C+40 M94"});
  run.step(2);
  EXPECT_NEAR(run.programmed()[5], 40, 1e-9);
  EXPECT_EQ(run.frame().datum[5], 720) << "M94 took two revolutions off what is shown";
}

/// The gateway asks for the frame only when the number is another.
TEST(TncStatusWindow, SaysWhenTheFrameHasChanged) {
  WindowRun run({"TOOL CALL 0 Z S800", "L X+1 R0 F500 M", "L X+2", "CC X+1 Y+2", "L X+3",
                 "CYCL DEF 7.0 DATUM SHIFT", "CYCL DEF 7.1 X+10", "L X+3",
                 "CYCL DEF 8.0 MIRROR IMAGE", "CYCL DEF 8.1 X", "CYCL DEF 10.0 ROTATION",
                 "CYCL DEF 10.1 ROT +30", "CYCL DEF 11.0 SCALING", "CYCL DEF 11.1 SCL 2",
                 "L C+400 M94"});
  const auto changes_with = [&run](int blocks) {
    const CoordinateFrame before = run.frame();
    const std::uint32_t changes = run.changes();
    run.step(blocks);
    const CoordinateFrame after = run.frame();
    const auto shown = [](const CoordinateFrame& frame) {
      return std::tie(frame.datum, frame.shift, frame.rotation, frame.scale, frame.mirrored,
                      frame.pole, frame.pole_axes);
    };
    const bool is_other = shown(before) != shown(after);
    EXPECT_EQ(is_other, run.changes() != changes);
    return run.changes() != changes;
  };
  EXPECT_FALSE(changes_with(3)) << "moves";
  EXPECT_TRUE(changes_with(1)) << "CC";
  EXPECT_FALSE(changes_with(1)) << "a move";
  EXPECT_TRUE(changes_with(2)) << "cycle 7";
  EXPECT_FALSE(changes_with(1)) << "a move";
  EXPECT_TRUE(changes_with(2)) << "cycle 8";
  EXPECT_TRUE(changes_with(2)) << "cycle 10";
  EXPECT_TRUE(changes_with(2)) << "cycle 11";
}

TEST(TncStatusWindow, NoticesTheEndThatCancelsTransformations) {
  WindowRun run({"CYCL DEF 7.0 DATUM SHIFT", "CYCL DEF 7.1 X+10"});
  run.step(2);
  const std::uint32_t changes = run.changes();
  EXPECT_EQ(run.step(), StepState::Ended);
  EXPECT_NE(run.changes(), changes);
  EXPECT_EQ(run.frame().shift[0], 0);
}

TEST(TncStatusWindow, NoticesAnotherWorkingPlane) {
  WindowRun run({"TOOL DEF 1 L+0 R+4", "TOOL CALL 1 Z S800", "CC X+1 Y+2", "TOOL CALL Y"});
  run.step(3);
  const std::uint32_t changes = run.changes();
  EXPECT_EQ(run.frame().pole_axes, 3);
  run.step(1);
  EXPECT_NE(run.changes(), changes);
  EXPECT_EQ(run.frame().pole_axes, 5);
}

// HD-185: MP 173 leaves them in force.
TEST(TncStatusWindow, KeepsTransformationsWhereTheEndDoesNotCancelThem) {
  WindowRun run({"CYCL DEF 7.0 DATUM SHIFT", "CYCL DEF 7.1 X+10"},
                "[control]\ncancel_transformations = false\n");
  run.step(2);
  EXPECT_EQ(run.step(), StepState::Ended);
  EXPECT_EQ(run.frame().shift[0], 10);
}

TEST(TncStatusWindow, NoticesARestoredState) {
  WindowRun shifted({"CYCL DEF 7.0 DATUM SHIFT", "CYCL DEF 7.1 X+10", "L X+3 R0 F500 M"});
  const Snapshot start = shifted.interpreter().snapshot();
  shifted.step(2);
  const std::uint32_t changes = shifted.changes();
  ASSERT_TRUE(shifted.interpreter().restore(start));
  EXPECT_NE(shifted.changes(), changes);
  EXPECT_EQ(shifted.frame().shift[0], 0);
}

}  // namespace
}  // namespace dripline::interpreter
