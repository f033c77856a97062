// The path of a lathe's tool back to where its program continues: in stock, with many programs and
// places where the run stopped and where the tool is now. No approach leads through the stock.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <random>

#include "gateway/app/restart/approach.hpp"
#include "gateway/interpreter/core/dialects.hpp"
#include "tests/unit/gateway/app/restart/lathe_programs.hpp"
#include "tests/unit/gateway/app/restart/lathe_stock.hpp"

namespace dripline::gateway {
namespace {

using interpreter::Axis;
using interpreter::PlaneVector;
using interpreter::Position;
using testing::HasSubstr;

Position at(PlaneVector place) {
  Position position;
  for (const Axis axis : interpreter::kAllAxes) position.mark(axis);
  set_in_plane(position, kLathePlane, place);
  return position;
}
constexpr PlaneVector place(double x, double z) {
  return {z, x};
}
constexpr PlaneVector kHome = place(100, 150);

/// A program as its machine sees it, with the block of each move.
class Moves final : public interpreter::EventSink {
 public:
  struct One {
    PassedMove move;
    std::uint64_t block = 0;
    bool is_thread = false;
  };
  std::vector<One> all;
  std::string alarm;

  void on_rapid(const interpreter::Rapid& event) override { add(event, {{}, {}, true}); }
  void on_line(const interpreter::Line& event) override { add(event, {}); }
  void on_arc(const interpreter::Arc& event) override {
    add(event, {{},
                {},
                false,
                interpreter::PathArc{event.center_first, event.center_second, event.plane,
                                     event.turn, event.sweep}});
  }
  void on_thread(const interpreter::Thread& event) override {
    add(event, {});
    all.back().is_thread = true;
  }
  void on_alarm(const interpreter::Alarm& event) override { alarm = event.diagnostic.text; }

 private:
  template <class Event>
  void add(const Event& event, PassedMove move) {
    move.from = at_;
    if (event.to.has(Axis::X)) at_.second = event.to.raw(Axis::X);
    if (event.to.has(Axis::Z)) at_.first = event.to.raw(Axis::Z);
    move.to = at_;
    all.push_back({move, event.origin.block});
  }
  PlaneVector at_ = kHome;
};

void run(const std::string& program, interpreter::EventSink& sink) {
  auto setup = interpreter::parse_setup("[control]\nmodel = \"0i\"\n");
  ASSERT_TRUE(setup) << setup.error().what;
  setup->position = at(kHome);
  interpreter::MemorySource source(program);
  auto made = interpreter::kFanucLatheDialect.make(*setup, source, sink);
  ASSERT_TRUE(made) << made.error().what;
  (*made)->step(100'000);
}

/// A run that stopped in a block; `to` is where that block began.
struct Stopped {
  PassedPath passed;
  PlaneVector stop, to;
  std::size_t move = 0;  ///< within which it stopped
  std::uint64_t block = 0;
};

Stopped stop_in(const std::string& program, const Moves& moves, std::size_t move, double part) {
  Stopped stopped;
  stopped.move = move;
  stopped.block = moves.all[move].block;
  stopped.stop = moves.all[move].move.at(part);
  stopped.to = kHome;
  for (const auto& one : moves.all)
    if (one.block < stopped.block) stopped.to = one.move.to;
  stopped.passed.begin({.target = stopped.block - 1,
                        .executed = stopped.block - 1,
                        .at = at(kHome),
                        .is_begin_of_run = true});
  run(program, stopped.passed);
  stopped.passed.stop_at(at(stopped.stop));
  return stopped;
}

Approach::Plan plan_from(const Stopped& stopped, PlaneVector now) {
  Approach approach;
  approach.is_lathe = true;
  approach.from = at(now);
  approach.to = at(stopped.to);
  approach.highest = at(kHome);
  approach.feed = Feed::per_minute(Length::mm(100));
  approach.passed = &stopped.passed;
  approach.stopped_at = at(stopped.stop);
  return approach.plan();
}

/// The moves of a plan; those before the spindle is on are no cuts.
std::vector<PassedMove> moves_of(const Approach::Plan& plan, PlaneVector now) {
  std::vector<PassedMove> moves;
  for (const auto* part : {&plan.before, &plan.after}) {
    for (const ApproachMove& one : *part) {
      PassedMove move{now, now, !one.feed, one.arc};
      if (one.to.has(Axis::X)) move.to.second = one.to.raw(Axis::X);
      if (one.to.has(Axis::Z)) move.to.first = one.to.raw(Axis::Z);
      now = move.to;
      moves.push_back(move);
    }
  }
  return moves;
}

/// Stops programs by chance, and looks at the approaches from many places.
class StoppedRuns {
 public:
  struct Counts {
    int programs = 0, from_stop = 0, no_path = 0, jogged = 0, from_home = 0, elsewhere = 0;
    int refused = 0;
  };
  Counts counts;

  void try_one() {
    const LathePrograms::Made program = LathePrograms(random_).make();
    SCOPED_TRACE(program.text);
    Moves moves;
    run(program.text, moves);
    if (!moves.alarm.empty()) return;
    ++counts.programs;
    for (int k = 0; k < 4 && !testing::Test::HasFailure(); ++k) stop(program, moves);
  }

 private:
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  static LatheStock stock_of(const Moves& moves, const Stopped& stopped, bool is_bored) {
    LatheStock stock(25, 0, 70, is_bored);
    for (std::size_t i = 0; i < stopped.move; ++i)
      if (!moves.all[i].move.is_rapid) stock.cut(moves.all[i].move);
    const PassedMove& last = moves.all[stopped.move].move;
    if (!last.is_rapid) stock.cut(last.piece(0, *last.part_at(stopped.stop, 1e-3)));
    return stock;
  }
  void stop(const LathePrograms::Made& program, const Moves& moves) {
    const std::size_t move = random_() % moves.all.size();
    const Stopped stopped = stop_in(program.text, moves, move, between(0, 1));
    const LatheStock stock = stock_of(moves, stopped, program.is_bored);
    const auto check = [&](PlaneVector now, int& possible) {
      const bool is_possible = is_free(stopped, stock, now);
      ++(is_possible ? possible : counts.refused);
      return is_possible;
    };
    if (!moves.all[move].is_thread && !check(stopped.stop, counts.from_stop)) ++counts.no_path;
    check(kHome, counts.from_home);
    const double outward = between(0, 50), along = between(0, 50);
    check(kHome + place(outward, along), counts.from_home);
    const double out = program.is_bored ? -between(0, 2) : between(0, 60);
    const PlaneVector jogged = stopped.stop + place(out, 0);
    if (stock.depth_of({stopped.stop, jogged}) < 0.05) check(jogged, counts.jogged);
    for (int i = 0; i < 20; ++i) {
      const double x = between(0, 120), z = between(-60, 170);
      const PlaneVector elsewhere = place(x, z);
      if (stock.depth_at(elsewhere) == 0) check(elsewhere, counts.elsewhere);
    }
  }
  /// There is an approach, and it leads through nothing that the program has left; false: none.
  static bool is_free(const Stopped& stopped, const LatheStock& stock, PlaneVector now) {
    const Approach::Plan plan = plan_from(stopped, now);
    const auto moves = moves_of(plan, now);
    if (!plan.fault.empty()) {
      EXPECT_TRUE(moves.empty());
      return false;
    }
    for (const PassedMove& move : moves) {
      // A tool that stopped in a cut touches what it cuts.
      EXPECT_LT(stock.depth_of(move), 0.12)
          << (move.is_rapid ? "rapid" : "feed") << " X" << 2 * move.from.second << " Z"
          << move.from.first << " to X" << 2 * move.to.second << " Z" << move.to.first << " from X"
          << 2 * now.second << " Z" << now.first << " stopped at X" << 2 * stopped.stop.second
          << " Z" << stopped.stop.first;
    }
    EXPECT_LT(length((moves.empty() ? now : moves.back().to) - stopped.to), 1e-6);
    return true;
  }

  std::mt19937 random_{202611};
};

TEST(LatheApproach, LeadsThroughNoStock) {
  StoppedRuns runs;
  for (int n = 0; n < 250 && !testing::Test::HasFailure(); ++n) runs.try_one();
  const StoppedRuns::Counts& counts = runs.counts;
  std::printf(
      "%d programs: from the stop %d (refused %d), jogged %d, from home %d, elsewhere %d, "
      "refused %d\n",
      counts.programs, counts.from_stop, counts.no_path, counts.jogged, counts.from_home,
      counts.elsewhere, counts.refused);
  EXPECT_GT(counts.from_stop, 500);
  EXPECT_LT(counts.no_path, counts.from_stop / 10);
  EXPECT_GT(counts.jogged, 200);
  EXPECT_GT(counts.from_home, 500);
  EXPECT_GT(counts.refused, 1000);
}

/// Up out of a pocket of G71, over what it has cut, and not in front of the part.
TEST(LatheApproach, GoesBackOutOfAPocket) {
  const std::string program =
      "O1\nT0101\nG00 X50. Z-10.\nG01 X30. Z-15. F0.2\nZ-20.\nG01 X40. Z-30.\nG00 X52.\nM30\n";
  Moves moves;
  run(program, moves);
  ASSERT_EQ(moves.alarm, "");
  ASSERT_GT(moves.all.size(), 3U);
  const Stopped stopped = stop_in(program, moves, 3, 0.5);  // in the taper up
  const auto back = moves_of(plan_from(stopped, stopped.stop), stopped.stop);
  ASSERT_EQ(back.size(), 1U);
  EXPECT_FALSE(back[0].is_rapid);
  EXPECT_EQ(back[0].to.second, 15);
  EXPECT_EQ(back[0].to.first, -20);
  const auto jogged =
      moves_of(plan_from(stopped, place(60, stopped.stop.first)), place(60, stopped.stop.first));
  ASSERT_EQ(jogged.size(), 2U) << "straight to where it stopped, then back";
  EXPECT_EQ(jogged[0].to.second, stopped.stop.second);
  const auto home = moves_of(plan_from(stopped, place(110, 160)), place(110, 160));
  ASSERT_EQ(home.size(), 5U);
  EXPECT_EQ(home[0].to.second, 100) << "X first";
  EXPECT_EQ(home[1].to.first, 150);
  EXPECT_TRUE(home[2].is_rapid);
  EXPECT_EQ(home[2].to.second, 25);
  EXPECT_EQ(home[2].to.first, -10);
  EXPECT_FALSE(home[3].is_rapid);
  const std::string fault = plan_from(stopped, place(60, 5)).fault;
  EXPECT_THAT(fault, HasSubstr("the axes are at X120.000 Z5.000"));
  EXPECT_THAT(fault, HasSubstr("to X30.000 Z-20.000, where the program continues"));
  EXPECT_THAT(fault, HasSubstr("or to X200.000 Z150.000, where the program took it up"));
  EXPECT_THAT(fault, HasSubstr("or back to X35.000 Z-25.000, where it stopped"));
}

/// A thread between is free at one angle of the spindle alone.
TEST(LatheApproach, OffersNoPlaceThatNoPathLeadsFrom) {
  const std::string program =
      "O1\nT0101\nG97 S500 M03\nG00 X40. Z5.\nG32 Z-20. F2.\nG01 X44. Z-30. F0.2\nX60.\nM30\n";
  Moves moves;
  run(program, moves);
  ASSERT_EQ(moves.alarm, "");
  ASSERT_GT(moves.all.size(), 1U);
  const Stopped stopped = stop_in(program, moves, moves.all.size() - 1, 0.5);
  const std::string fault = plan_from(stopped, place(90, 20)).fault;
  EXPECT_THAT(fault, HasSubstr("to X44.000 Z-30.000, where the program continues"));
  EXPECT_THAT(fault, testing::Not(HasSubstr("where the program took it up")));
}

/// An arc is an arc backward too.
TEST(LatheApproach, GoesBackAlongAnArc) {
  const std::string program = "O1\nT0101\nG00 X20. Z0\nG03 X30. Z-5. R5. F0.2\nG00 X60.\nM30\n";
  Moves moves;
  run(program, moves);
  ASSERT_EQ(moves.alarm, "");
  const Stopped stopped = stop_in(program, moves, 1, 0.5);
  const Approach::Plan plan = plan_from(stopped, stopped.stop);
  ASSERT_EQ(plan.after.size(), 1U);
  ASSERT_TRUE(plan.after[0].arc);
  EXPECT_NEAR(plan.after[0].arc->sweep.degrees(), 45, 1e-6);
  EXPECT_NE(plan.after[0].arc->turn, moves.all[1].move.arc->turn);
  EXPECT_TRUE(plan.after[0].feed);
}

TEST(LatheApproach, AnotherToolIsTakenUpOnlyWhereTheProgramDidIt) {
  const std::string program =
      "O1\nT0101\nG00 X50. Z2.\nG01 Z-30. F0.2\nG00 X200. Z150.\nT0202\nG00 X60. Z-20.\nG01 X40.\n"
      "G00 X60.\nM30\n";
  Moves moves;
  run(program, moves);
  ASSERT_EQ(moves.alarm, "");
  Stopped stopped = stop_in(program, moves, 1, 0);
  stopped.passed.begin({.target = stopped.block - 1,
                        .executed = moves.all[4].block - 1,
                        .at = at(kHome),
                        .is_begin_of_run = true});
  run(program, stopped.passed);
  stopped.stop = place(25, -20);
  stopped.passed.stop_at(at(stopped.stop));
  EXPECT_THAT(plan_from(stopped, place(25, -20)).fault,
              HasSubstr("another tool is in its position"));
  EXPECT_EQ(plan_from(stopped, kHome).fault, "");
}

/// What an M function did to the part, and what an axis C turned, is not known.
TEST(LatheApproach, KnowsNothingOfBeforeAnMFunction) {
  const std::string program = "O1\nT0101\nG00 X50. Z2.\nM69\nG01 Z-30. F0.2\nX60.\nM30\n";
  Moves moves;
  run(program, moves);
  ASSERT_EQ(moves.alarm, "");
  const Stopped stopped = stop_in(program, moves, 2, 0.5);
  EXPECT_EQ(stopped.passed.moves().size(), 2U);
  EXPECT_FALSE(stopped.passed.taken_up_at());
  EXPECT_NE(plan_from(stopped, kHome).fault, "");
  EXPECT_EQ(plan_from(stopped, stopped.stop).fault, "");
}

/// A gear, a chuck that is closed: the tool is where it was taken up.
TEST(LatheApproach, KnowsWhereTheToolIsTakenUpAfterAnMFunctionThere) {
  const std::string program = "O1\nT0101\nM41\nG00 X50. Z2.\nG01 Z-30. F0.2\nX60.\nM30\n";
  Moves moves;
  run(program, moves);
  ASSERT_EQ(moves.alarm, "");
  EXPECT_EQ(plan_from(stop_in(program, moves, 2, 0.5), kHome).fault, "");
}

/// The control waits for the spindle where a thread begins, and not in the middle of it.
TEST(PassedPath, NamesTheBlockWhereAThreadBegins) {
  const std::string program =
      "O1\nT0101\nG97 S500 M03\nG00 X40. Z5.\nG32 Z-20. F2.\nX44. Z-25.\nZ-30.\nG00 X50.\nM30\n";
  const auto thread_of = [&](std::uint64_t target) {
    PassedPath passed;
    passed.begin({.target = target, .executed = target, .at = at(kHome), .is_begin_of_run = true});
    run(program, passed);
    return passed.thread_begins_in();
  };
  Moves moves;
  run(program, moves);
  const std::uint64_t first = moves.all[1].block;
  EXPECT_EQ(thread_of(first - 1), 0U);
  EXPECT_EQ(thread_of(first), first);
  EXPECT_EQ(thread_of(first + 1), first);
  EXPECT_EQ(thread_of(first + 2), 0U) << "after its end";
}

TEST(PassedPath, KnowsWhenItIsInAThread) {
  const std::string program = "O1\nT0101\nG97 S500 M03\nG00 X40. Z5.\nG32 Z-20. F2.\nM30\n";
  Moves moves;
  run(program, moves);
  PassedPath passed;
  const std::uint64_t executed = moves.all[1].block - 1;
  passed.begin(
      {.target = executed, .executed = executed, .at = at(kHome), .is_begin_of_run = true});
  run(program, passed);
  EXPECT_TRUE(passed.is_in_thread(at(place(20, -10))));
  EXPECT_FALSE(passed.is_in_thread(at(place(20, 5)))) << "where it begins";
  EXPECT_FALSE(passed.is_in_thread(at(place(22, -10))));
}

}  // namespace
}  // namespace dripline::gateway
