#include <gtest/gtest.h>
#include <string>

#include "gateway/interpreter/core/dialects.hpp"
#include "gateway/interpreter/core/program_source.hpp"
#include "tests/support/allocation_counter.hpp"

/// Ordinary blocks do not allocate: this program counts every call of operator new.
namespace dripline::interpreter::fanuc {
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

class OrdinaryBlocks : public testing::TestWithParam<BlockCase> {};

TEST_P(OrdinaryBlocks, DoNotAllocate) {
  constexpr int kBlocks = 200;
  std::string text = GetParam().head;
  for (int i = 0; i < kBlocks; ++i) text += GetParam().block;
  text += "M30\n";
  MemorySource source(text);
  MoveCounter sink;
  const auto made = kFanucDialect.make(interpreter::Setup{}, source, sink);
  ASSERT_TRUE(made);
  ASSERT_EQ((*made)->step(10), StepState::Ran);  // the header, the first of everything
  const std::size_t before = test::allocations();
  ASSERT_EQ((*made)->step(kBlocks - 10), StepState::Ran);
  EXPECT_EQ(test::allocations(), before);
  EXPECT_GT(sink.moves, kBlocks / 2);
}

INSTANTIATE_TEST_SUITE_P(
    , OrdinaryBlocks,
    testing::Values(BlockCase{"straight", "G91 G01 F100.\n", "X1.5 Y-.25\n"},
                    BlockCase{"rapid", "G91 G00\n", "N10 X1.5 Z.1\n"},
                    BlockCase{"arcs", "G91 G03 F100.\n", "X10. Y10. J10.\n"},
                    BlockCase{"codes", "G91 F100.\n", "G01 X1. S500 M03\n"},
                    BlockCase{"rotated", "G68 X0 Y0 R30.\nG91 G01 F100.\n", "X1. Y1.\n"},
                    BlockCase{"holes", "G91 G81 Z-1. R0 F100.\n", "X1.\n"},
                    BlockCase{"compensated", "G91 G41 G01 D1 F100.\n", "X1. Y.5\n"},
                    BlockCase{"variables", "G91 G01 F100.\n#1=.5\n", "X#1 Y[#1*2-1]\n"}),
    [](const auto& each) { return std::string(each.param.name); });

}  // namespace
}  // namespace dripline::interpreter::fanuc
