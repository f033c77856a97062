#include "gateway/machine/given_action.hpp"

#include <gtest/gtest.h>
#include <cmath>
#include <vector>

namespace dripline::machine {
namespace {

using Kind = GivenAction::Kind;

/// A path in X and Y, each move a block.
class Path {
 public:
  Path& to(double x, double y) {
    GivenAction move = next(Kind::Motion);
    move.end = {x, y};
    actions_.push_back(move);
    at_ = move.end;
    return *this;
  }
  /// About a center, counterclockwise with a positive `sweep` in degrees.
  Path& arc(double center_x, double center_y, double sweep) {
    GivenAction move = next(Kind::Motion);
    GivenAction::Arc arc;
    arc.center_first = center_x;
    arc.center_second = center_y;
    arc.start_radius = arc.end_radius = std::hypot(at_[0] - center_x, at_[1] - center_y);
    arc.start = std::atan2(at_[1] - center_y, at_[0] - center_x);
    arc.sweep = sweep * Angle::kPi / 180;
    move.end = {center_x + arc.start_radius * std::cos(arc.start + arc.sweep),
                center_y + arc.start_radius * std::sin(arc.start + arc.sweep)};
    move.arc = arc;
    actions_.push_back(move);
    at_ = move.end;
    return *this;
  }
  Path& waits() {
    actions_.push_back(next(Kind::Other));
    return *this;
  }
  /// "2" or "2-5", or "elsewhere".
  std::string at(double x, double y) const {
    const auto found = reached(actions_, {x, y});
    if (!found) return "elsewhere";
    const std::string least = std::to_string(found->least);
    return found->is_certain() ? least : least + "-" + std::to_string(found->most);
  }

 private:
  GivenAction next(Kind kind) const {
    GivenAction action;
    action.origin.block = actions_.size() + 1;
    action.kind = kind;
    action.ends_block = true;
    action.from = action.end = at_;
    return action;
  }
  GivenAction::Point at_{};
  std::vector<GivenAction> actions_;
};

TEST(GivenAction, IsDoneAtItsEnd) {
  const Path path = Path().to(10, 0).to(10, 10).to(20, 10);
  EXPECT_EQ(path.at(0, 0), "0");
  EXPECT_EQ(path.at(5, 0), "0");
  EXPECT_EQ(path.at(10, 0), "1");
  EXPECT_EQ(path.at(10, 9.9), "1");
  EXPECT_EQ(path.at(10, 9.996), "2") << "within a step";
  EXPECT_EQ(path.at(20, 10), "3");
  EXPECT_EQ(path.at(20.1, 10), "elsewhere");
  EXPECT_EQ(path.at(5, 0.03), "elsewhere");
}

TEST(GivenAction, IsUncertainWhereThePathComesBack) {
  const Path path = Path().to(10, 0).to(0, 0).to(0, 10);
  EXPECT_EQ(path.at(5, 0), "0-1");
  EXPECT_EQ(path.at(10, 0), "1") << "the turn is one place";
  EXPECT_EQ(path.at(0, 0), "0-2");
  EXPECT_EQ(path.at(0, 5), "2");
}

TEST(GivenAction, TellsSmallMovesApart) {
  Path path;
  for (int i = 1; i <= 500; ++i) path.to(i * 0.01, 0);
  EXPECT_EQ(path.at(0, 0), "0");
  EXPECT_EQ(path.at(2.5, 0), "250");
  EXPECT_EQ(path.at(2.5, 0.005), "250");
  EXPECT_EQ(path.at(5, 0), "500");
}

TEST(GivenAction, FollowsArcs) {
  const Path path = Path().to(10, 0).arc(10, 10, 90).to(20, 30).arc(20, 40, -360).to(0, 30);
  EXPECT_EQ(path.at(10 + 10 * std::sin(0.5), 10 - 10 * std::cos(0.5)), "1");
  EXPECT_EQ(path.at(20, 10), "2");
  EXPECT_EQ(path.at(20, 10.5), "2") << "the line after it is not the arc";
  EXPECT_EQ(path.at(20 - 10, 40), "3");
  EXPECT_EQ(path.at(20, 50), "3");
  EXPECT_EQ(path.at(20, 30), "3-4") << "before or after the circle";
  EXPECT_EQ(path.at(0, 30), "5");
}

TEST(GivenAction, IsNotReachedBeyondWhatMustWait) {
  const Path path = Path().to(10, 0).waits().to(20, 0);
  EXPECT_EQ(path.at(10, 0), "1");
  EXPECT_EQ(path.at(15, 0), "elsewhere");
}

}  // namespace
}  // namespace dripline::machine
