#include <gtest/gtest.h>
#include <string>

#include "gateway/interpreter/core/dialects.hpp"
#include "gateway/interpreter/core/program_source.hpp"
#include "tests/support/allocation_counter.hpp"

/// Ordinary blocks do not allocate: this program counts every call of operator new.
namespace dripline::interpreter::centurion {
namespace {

class MoveCounter final : public EventSink {
 public:
  void on_rapid(const Rapid&) override { ++moves; }
  void on_line(const Line&) override { ++moves; }
  void on_arc(const Arc&) override { ++moves; }
  int moves = 0;
};

struct BlockCase {
  const char* name;
  const char* head;   ///< executed before counting begins
  const char* block;  ///< repeated
};

class CenturionOrdinaryBlocks : public testing::TestWithParam<BlockCase> {};

TEST_P(CenturionOrdinaryBlocks, DoNotAllocate) {
  constexpr int kBlocks = 200;
  std::string text = GetParam().head;
  for (int i = 0; i < kBlocks; ++i) text += GetParam().block;
  MemorySource source(text);
  MoveCounter sink;
  const auto setup = parse_setup("[[tool]]\nnumber = 1\nradius = 0.1\ntip = 3\n", Units::Inch);
  const auto made = kCenturionDialect.make(*setup, source, sink);
  ASSERT_TRUE(made);
  ASSERT_EQ((*made)->step(20), StepState::Ran);  // the header, the first of everything
  const std::size_t before = test::allocations();
  ASSERT_EQ((*made)->step(kBlocks - 20), StepState::Ran);
  EXPECT_EQ(test::allocations(), before);
  EXPECT_GE(sink.moves, kBlocks / 4);
}

INSTANTIATE_TEST_SUITE_P(
    , CenturionOrdinaryBlocks,
    testing::Values(BlockCase{"straight", "G98 F9 G1\n", "U.5 W-.25\n"},
                    BlockCase{"rapid", "G0\n", "N10 U.5 W-.25\n"},
                    BlockCase{"arc", "G98 F9\n", "G2 U2 W1 R1\n"},
                    BlockCase{"compensated", "T0101 M6\nG98 F9 G42\n", "G1 U2\nW-1\nU1 W-1\n"},
                    BlockCase{"turned", "G98 F9\nG568 AA30\nG551 P2\nG511 X0\n", "G1 U1 W.1\n"},
                    BlockCase{"guarded", "G98 F9\nG22\n", "G1 U1 W.1\n"},
                    BlockCase{"referred", "G98 F9\n", "U1\nG28 U0\n"},
                    BlockCase{"computed", "P7=1 G98 F9\n", "U[P7+2*SIN[30]]\n"}),
    [](const auto& each) { return each.param.name; });

}  // namespace
}  // namespace dripline::interpreter::centurion
