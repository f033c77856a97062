// PROBE1 and PROBE2 of a Centurion on arcs and under G0 (CEN-191), with a gateway: where the axes
// end, what is recorded, and devices that can do neither.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gateway/machine/grbl/grbl_machine.hpp"
#include "tests/support/grbl/board.hpp"
#include "tests/unit/gateway/app/position_fixture.hpp"

namespace dripline::gateway {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

/// The face at Z-5 (X is a radius in a setup and a record, a diameter in the program).
constexpr const char* kFace = "units = \"mm\"\n[probe]\nsurface = [ { axis = \"Z\", at = -5 } ]\n";

std::vector<dds::ProbeText> probes_of(const Shop& shop) {
  std::vector<dds::ProbeText> probes;
  for (const auto& record : shop.records)
    if (record.kind == dds::RecordKind::Probe)
      probes.push_back(dds::decode_probe(record.text).value());
  return probes;
}

TEST(ProbeMoves, OnAnArcEndAtTheContactAndTheNextBlockBeginsThere) {
  Shop shop(interpreter::kCenturionDialect, kFace);
  ASSERT_EQ(shop.run("G21 G98 F600\nG0 X0 Z10\nPROBE1 G3 X0 Z-10 R10\n"
                     "POPEN P1\nDPRNT[X#209 Z#208]\nPCLOS\nG91 G1 X2 Z1\n"),
            "completed");
  const auto probes = probes_of(shop);
  ASSERT_EQ(probes.size(), 1u);
  EXPECT_TRUE(probes[0].tripped);
  EXPECT_NEAR(probes[0].at.at('X'), std::sqrt(75), 1e-9);
  EXPECT_NEAR(probes[0].at.at('Z'), -5, 1e-9);
  EXPECT_EQ(shop.lines(), std::vector<std::string>{"X8.660Z-5.000"});
  EXPECT_NEAR(shop.at(0), std::sqrt(75) + 1, 1e-9);
  EXPECT_NEAR(shop.at(2), -4, 1e-9);
}

TEST(ProbeMoves, OnAnArcThatMeetsNothingEndAtItsEnd) {
  Shop shop(interpreter::kCenturionDialect, kFace);
  ASSERT_EQ(shop.run("G21 G98 F600\nG0 X0 Z10\nPROBE1 G2 X-20 Z0 K-10\n"), "completed");
  const auto probes = probes_of(shop);
  ASSERT_EQ(probes.size(), 1u);
  EXPECT_FALSE(probes[0].tripped);
  EXPECT_NEAR(shop.at(0), -10, 1e-9);
  EXPECT_NEAR(shop.at(2), 0, 1e-9);
}

TEST(ProbeMoves, UnderG0EndAtTheContactWithoutAFeed) {
  Shop shop(interpreter::kCenturionDialect, kFace);
  ASSERT_EQ(shop.run("G21\nG0 X20 Z10\nPROBE1 Z-20\nPROBE2 Z3\n"), "completed");
  const auto probes = probes_of(shop);
  ASSERT_EQ(probes.size(), 2u);
  EXPECT_NEAR(probes[0].at.at('Z'), -5, 1e-9);
  EXPECT_NEAR(probes[1].at.at('Z'), -5, 1e-9) << "released where it begins to leave";
}

/// A board of the Grbl class that a gateway drives.
class ProbeMovesOfABoard : public testing::Test {
 protected:
  ProbeMovesOfABoard() {
    shop.motion = [this](machine::ExecutionSink& sink) {
      auto made = std::make_unique<machine::grbl::GrblMachine>(machine::grbl::GrblMachine::Settings{
          .sink = sink, .clock = std::shared_ptr<const Clock>(&shop.clock, [](const auto*) {})});
      machine = made.get();
      machine->line_opened();
      return made;
    };
    shop.each_turn = [this] {
      for (int i = 0; i < 10; ++i) {
        board.pass(0.001);
        const std::string in = board.take_output();
        const auto out = machine->exchange(std::as_bytes(std::span(in)));
        board.receive(out.real_time + out.lines);
      }
    };
    shop.restart_gateway();
    EXPECT_TRUE(shop.run_until([&] { return shop.status && machine->notice().empty(); }));
  }
  /// Lines that move towards the face.
  bool has_probed() const {
    return std::ranges::any_of(board.lines,
                               [](const std::string& line) { return line.starts_with("G38"); });
  }

  test_support::GrblBoard board{{.surface_z = -5}};
  Shop shop{interpreter::kCenturionDialect, "units = \"mm\"\n", "1x"};
  machine::grbl::GrblMachine* machine = nullptr;
};

TEST_F(ProbeMovesOfABoard, AreStraightAndAtAFeed) {
  EXPECT_EQ(shop.run("G21 G98 F600\nG0 X8 Z2\nPROBE1 G1 Z-10\n"), "completed");
  EXPECT_NEAR(board.position()[2], -5, 1e-3);
}

TEST_F(ProbeMovesOfABoard, OnAnArcAreRefusedBeforeTheyMove) {
  EXPECT_THAT(shop.run("G21 G98 F600\nG0 X8 Z2\nPROBE1 G3 X8 Z-10 R10\n"),
              AllOf(StartsWith("MCH0008"), HasSubstr("cannot probe on an arc")));
  EXPECT_FALSE(has_probed());
  EXPECT_NEAR(board.position()[2], 2, 1e-3);
}

TEST_F(ProbeMovesOfABoard, AtRapidTraverseAreRefusedBeforeTheyMove) {
  EXPECT_THAT(shop.run("G21 G98 F600\nG0 X8 Z2\nPROBE1 Z-10\n"),
              AllOf(StartsWith("MCH0008"), HasSubstr("cannot probe at rapid traverse")));
  EXPECT_FALSE(has_probed());
  EXPECT_NEAR(board.position()[2], 2, 1e-3);
}

}  // namespace
}  // namespace dripline::gateway
