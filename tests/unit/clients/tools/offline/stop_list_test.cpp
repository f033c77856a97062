#include "clients/tools/offline/stop_list.hpp"

#include <gtest/gtest.h>

namespace dripline::interpreter {
namespace {

Stop stop_at(std::uint64_t offset, StopKind kind, ProgramIndex program = kMainProgram) {
  Stop stop;
  stop.origin.offset = offset;
  stop.origin.program = program;
  stop.kind = kind;
  return stop;
}

TEST(StopList, KeepsPlacesInTheOrderTheyAreMet) {
  StopList list;
  list.on_stop(stop_at(70, StopKind::Program));
  list.on_stop(stop_at(20, StopKind::ToolChange, 1));
  list.on_stop(stop_at(20, StopKind::Program, 2));
  ASSERT_EQ(list.places().size(), 3U);
  EXPECT_EQ(list.places()[0].stop.origin.offset, 70U);
  EXPECT_EQ(list.places()[1].stop.kind, StopKind::ToolChange);
  EXPECT_EQ(list.places()[2].stop.origin.program, 2U);
  EXPECT_EQ(list.count(), 3U);
}

TEST(StopList, CountsAPlaceThatIsMetAgain) {
  StopList list;
  for (int pass = 0; pass < 3; ++pass) {
    list.on_stop(stop_at(20, StopKind::ToolChange));
    list.on_stop(stop_at(20, StopKind::Program));
  }
  ASSERT_EQ(list.places().size(), 2U);
  EXPECT_EQ(list.places()[0].times, 3U);
  EXPECT_EQ(list.places()[1].times, 3U);
  EXPECT_EQ(list.count(), 6U);
}

TEST(StopList, IsBoundedAndCountsOn) {
  StopList list;
  for (std::uint64_t i = 0; i < StopList::kMaxPlaces + 5; ++i) {
    list.on_stop(stop_at(i, StopKind::Program));
  }
  list.on_stop(stop_at(3, StopKind::Program));
  EXPECT_EQ(list.places().size(), StopList::kMaxPlaces);
  EXPECT_EQ(list.places()[3].times, 2U);
  EXPECT_EQ(list.count(), StopList::kMaxPlaces + 6);
}

}  // namespace
}  // namespace dripline::interpreter
