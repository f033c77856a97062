#include "server/library/control_catalog.hpp"

#include <gmock/gmock.h>

namespace dripline::library {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(StartSearch, IsWhatTheControlsDialectAccepts) {
  const auto& centurion = start_search_of("centurion");
  EXPECT_THAT(centurion.at, ElementsAre("block", "line", "byte", "tool", "count"));
  EXPECT_TRUE(centurion.has_memory);
  EXPECT_TRUE(centurion.has_pass);
  const auto& tnc = start_search_of("tnc155");
  EXPECT_THAT(tnc.at, ElementsAre("block"));
  EXPECT_FALSE(tnc.has_memory);
  EXPECT_TRUE(tnc.has_pass);
}

TEST(StartSearch, IsNoneOfControlsThatDoNotLookThroughTheirPrograms) {
  for (const auto* control : {"tektronix-1704", "prototrak-plus"}) {
    EXPECT_THAT(start_search_of(control).at, ElementsAre("block")) << control;
    EXPECT_FALSE(start_search_of(control).has_pass) << control;
  }
  for (const auto* control : {"fanuc", "rs274ngc", "", "other"})
    EXPECT_THAT(start_search_of(control).at, IsEmpty()) << control;
}

}  // namespace
}  // namespace dripline::library
