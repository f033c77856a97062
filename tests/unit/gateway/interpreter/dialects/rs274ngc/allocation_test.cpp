#include <gtest/gtest.h>
#include <string>

#include "gateway/interpreter/core/dialects.hpp"
#include "gateway/interpreter/core/program_source.hpp"
#include "tests/support/allocation_counter.hpp"

/// Ordinary blocks do not allocate: this program counts every call of operator new.
namespace dripline::interpreter::rs274ngc {
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

class Rs274OrdinaryBlocks : public testing::TestWithParam<BlockCase> {};

TEST_P(Rs274OrdinaryBlocks, DoNotAllocate) {
  constexpr int kBlocks = 200;
  std::string text = GetParam().head;
  for (int i = 0; i < kBlocks; ++i) text += GetParam().block;
  text += "M30\n";
  MemorySource source(text);
  MoveCounter sink;
  const auto setup = parse_setup("[control]\nprofile = \"linuxcnc\"\n");
  const auto made = kRs274NgcDialect.make(*setup, source, sink);
  ASSERT_TRUE(made);
  ASSERT_EQ((*made)->step(20), StepState::Ran);  // the header, the first of everything
  const std::size_t before = test::allocations();
  ASSERT_EQ((*made)->step(kBlocks - 20), StepState::Ran);
  EXPECT_EQ(test::allocations(), before);
  EXPECT_GE(sink.moves, kBlocks / 4);
}

INSTANTIATE_TEST_SUITE_P(
    , Rs274OrdinaryBlocks,
    testing::Values(
        BlockCase{"straight", "G21 G91 G1 F100\n", "X1.5 Y-.25\n"},
        BlockCase{"rapid", "G91 G0\n", "N10 X1.5 Z.1\n"},
        BlockCase{"arc", "G91 F10\n", "G2 X2 Y0 I1 J0\n"},
        BlockCase{"turned", "G10 L2 P1 R30\nG91 G1 F10\n", "X1 Y2\n"},
        BlockCase{"hole", "G21 F10 G0 Z9\n", "G81 X1 Z-1 R1\nX2\n"},
        BlockCase{"compensated", "G91 F10\nG41.1 D1\n", "G1 X9\nY9\nX9\nY-9\n"},
        BlockCase{"computed", "#<path>=2 #7=1\nG91 G1 F10\n", "X[#7+#<path>*SIN[30]]\n"},
        BlockCase{"looped", "#1=0 G91 G0\no1 while [#1 lt 9999]\n#1=[#1+1]\nX#1\no1 endwhile\n",
                  "\n"}),
    [](const auto& each) { return each.param.name; });

}  // namespace
}  // namespace dripline::interpreter::rs274ngc
