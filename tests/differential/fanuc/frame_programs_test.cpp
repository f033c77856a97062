#include <fmt/format.h>
#include <gtest/gtest.h>
#include <cmath>
#include <fstream>

#include "clients/tools/offline/offline_run.hpp"
#include "clients/tools/post/conversion.hpp"
#include "gateway/interpreter/registry.hpp"
#include "tests/differential/fanuc/frame_programs.hpp"
#include "tests/differential/rs274ngc/peer.hpp"
#include "tests/support/temporary_folder.hpp"

/// Changes of coordinates on a Fanuc-class mill beside their own computation, and beside what
/// LinuxCNC makes of the programs that `dnc convert` writes of them. Rows: FAN-036, FAN-037,
/// FAN-038, FAN-040, FAN-041, FAN-052, FAN-054, FAN-091.
namespace dripline::differential {
namespace {

using interpreter::Axis;

class EndsOfMoves final : public interpreter::EventSink {
 public:
  void on_rapid(const interpreter::Rapid& event) override { add(event.to); }
  void on_line(const interpreter::Line& event) override { add(event.to); }
  void on_arc(const interpreter::Arc& event) override { add(event.to); }
  void on_alarm(const interpreter::Alarm& event) override { alarm = event.diagnostic.text; }
  std::vector<MachinePoint> ends;
  std::string alarm;

 private:
  void add(const interpreter::Position& to) {
    ends.push_back({to.raw(Axis::X), to.raw(Axis::Y), to.raw(Axis::Z)});
  }
};

/// Without moves that are none, which one side may leave out.
std::vector<MachinePoint> changes(const std::vector<MachinePoint>& ends, double least) {
  std::vector<MachinePoint> kept{{0, 0, 100}};
  for (const MachinePoint& to : ends) {
    const MachinePoint& at = kept.back();
    if (std::hypot(to[0] - at[0], to[1] - at[1], to[2] - at[2]) > least) kept.push_back(to);
  }
  return kept;
}

/// Empty when they are the same.
std::string first_difference(std::vector<MachinePoint> a, std::vector<MachinePoint> b,
                             double tolerance) {
  a = changes(a, 3 * tolerance);
  b = changes(b, 3 * tolerance);
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    const double off = std::hypot(a[i][0] - b[i][0], a[i][1] - b[i][1], a[i][2] - b[i][2]);
    if (off > tolerance)
      return fmt::format("move {}: {} {} {} and {} {} {}", i, a[i][0], a[i][1], a[i][2], b[i][0],
                         b[i][1], b[i][2]);
  }
  return a.size() == b.size() ? "" : fmt::format("{} moves and {}", a.size(), b.size());
}

TEST(FanucFrames, EndTheMovesWhereTheManualHasThem) {
  constexpr std::uint64_t kPrograms = 1'000;
  const auto setup = interpreter::parse_setup(kFrameSetup);
  ASSERT_TRUE(setup) << setup.error().what;
  const auto dialect = interpreter::find_dialect("fanuc");
  for (std::uint64_t number = 1; number <= kPrograms; ++number) {
    const FrameProgram program = make_frame_program(number);
    interpreter::MemorySource source(program.text);
    EndsOfMoves sink;
    auto run = interpreter::OfflineRun::begin(**dialect, *setup, source, sink);
    ASSERT_TRUE(run) << run.error().what;
    while (!*run->step(1000)) {
    }
    ASSERT_EQ(sink.alarm, "") << number << '\n' << program.text;
    ASSERT_EQ(first_difference(program.ends, sink.ends, 1e-6), "") << number << '\n'
                                                                   << program.text;
  }
}

/// A number in a written program has four decimals.
TEST(FanucFrames, AreWrittenForLinuxCncWithTheSameEnds) {
  if (!has_peer()) GTEST_SKIP() << "rs274 (Debian's linuxcnc-uspace) is not installed";
  constexpr std::uint64_t kPrograms = 100;
  const auto setup = interpreter::parse_setup(kFrameSetup);
  const auto dialect = interpreter::find_dialect("fanuc");
  const auto target = post::find_target("linuxcnc");
  const test_support::TemporaryFolder folder;
  std::ofstream(folder.path() / "tool.tbl") << tool_table();
  post::ConversionOptions options;
  options.is_as_set_up = true;
  options.tolerance = 0.001;  // of an arc between two rounded ends
  for (std::uint64_t number = 1; number <= kPrograms; ++number) {
    const FrameProgram program = make_frame_program(number);
    interpreter::MemorySource source(program.text);
    const auto file = folder.path() / "program.ngc";
    std::ofstream out(file);
    const auto written = post::write_program({**dialect, *setup, source, program.text}, **target,
                                             options, [&](std::string_view text) -> Result<void> {
                                               out << text;
                                               return {};
                                             });
    ASSERT_TRUE(written) << number << ": " << written.error().what << '\n' << program.text;
    out.close();
    const Behavior peer = run_peer(file, folder.path() / "tool.tbl");
    ASSERT_TRUE(peer.is_accepted) << number << ": " << peer.complaint;
    std::vector<MachinePoint> ends;
    for (const Move& move : peer.moves) ends.push_back({move.to[0], move.to[1], move.to[2]});
    ASSERT_EQ(first_difference(program.ends, ends, 2e-4), "") << number << '\n' << program.text;
  }
}

}  // namespace
}  // namespace dripline::differential
