#include "gateway/interpreter/core/program_source.hpp"
#include "tests/support/dialect_programs.hpp"
#include "tests/unit/gateway/machine/grbl/grbl_shop.hpp"

/// The same program on the simulated machine and on a board, for each control.
namespace dripline::machine::grbl::test {
namespace {

using interpreter::StepState;
using test_support::BlockEnds;
using test_support::DialectProgram;

class SixDialects : public testing::TestWithParam<std::size_t> {
 protected:
  const DialectProgram& program() const { return test_support::dialect_programs()[GetParam()]; }
  /// Feeds the program as the gateway does, and resumes its stops.
  void run(GrblShop& shop, const std::function<void()>& at_stop) {
    shop.begin();
    interpreter::MemorySource source(program().text);
    const auto dialect = interpreter::find_dialect(program().control);
    ASSERT_TRUE(dialect);
    auto made = (*dialect)->make({}, source, shop.machine.events());
    ASSERT_TRUE(made) << made.error().what;
    bool is_over = false;
    ASSERT_TRUE(shop.pass_until(
        [&] {
          while (!is_over && shop.machine.has_room()) is_over = (*made)->step(1) != StepState::Ran;
          const MachineState state = shop.machine.state();
          if (state == MachineState::SingleBlock || state == MachineState::ProgramStop) {
            at_stop();
            (void)shop.machine.resume();
          }
          return state == MachineState::Completed || state == MachineState::Alarmed;
        },
        600));
    EXPECT_EQ(shop.machine.state(), MachineState::Completed) << shop.alarm();
    at_stop();
  }
};

TEST_P(SixDialects, EndEveryBlockWhereTheSimulatedMachineDoes) {
  const BlockEnds expected = test_support::simulated_ends(program());
  ASSERT_GE(expected.size(), 4U);
  GrblShop shop;
  shop.machine.set_panel({.single_block = true});
  BlockEnds ends;
  run(shop, [&] {
    const auto status = shop.machine.status();
    auto& end = ends[status.executed];
    for (std::size_t i = 0; i < end.size(); ++i) end[i] = status.position.raw(static_cast<Axis>(i));
  });
  EXPECT_EQ(shop.recorder.blocks.size(), expected.size());
  double traveled = 0;
  for (const auto& [block, end] : expected) {
    for (const double value : end) traveled += std::fabs(value);
    if (block == 0 || !ends.contains(block)) continue;  // its end is that of the block before
    for (std::size_t i = 0; i < end.size(); ++i)
      EXPECT_NEAR(ends[block][i], end[i], 0.001) << "block " << block << " axis " << i;
  }
  EXPECT_GT(traveled, 10) << "the program moves";
  EXPECT_GE(ends.size(), 4U) << "some controls stop after blocks that move alone";
}

TEST_P(SixDialects, PassTheSamePointsWithoutStops) {
  const BlockEnds expected = test_support::simulated_ends(program());
  GrblShop shop;
  run(shop, [] {});
  const auto is_same = [](const auto& a, const auto& b) {
    for (std::size_t i = 0; i < a.size(); ++i)
      if (std::fabs(a[i] - b[i]) > 0.001) return false;
    return true;
  };
  auto done = shop.board.done.begin();
  GrblBoard::Point last{};
  for (const auto& [block, end] : expected) {
    if (is_same(end, last)) continue;  // no motion
    done = std::find_if(done, shop.board.done.end(),
                        [&, &point = end](const auto& at) { return is_same(at.at, point); });
    ASSERT_NE(done, shop.board.done.end()) << "the axes did not pass the end of block " << block;
    last = end;
    ++done;
  }
  EXPECT_EQ(done, shop.board.done.end()) << "and nowhere else after it";
  EXPECT_FALSE(shop.board.has_overrun);
}

INSTANTIATE_TEST_SUITE_P(, SixDialects, testing::Range<std::size_t>(0, 6), [](const auto& i) {
  std::string name(test_support::dialect_programs()[i.param].control);
  std::erase(name, '-');
  return name;
});

}  // namespace
}  // namespace dripline::machine::grbl::test
