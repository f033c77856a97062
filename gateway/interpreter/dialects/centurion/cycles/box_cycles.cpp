#include "gateway/interpreter/dialects/centurion/cycles/block_cycles.hpp"

#include <cmath>

#include "gateway/interpreter/dialects/centurion/cycles/thread_words.hpp"
#include "gateway/interpreter/dialects/centurion/motion/motion.hpp"

namespace dripline::interpreter::centurion {
namespace {

constexpr int kCutLength = 121;
constexpr int kCutDepth = 122;
constexpr int kEndPoint = 123;
constexpr int kDiameter = 124;
constexpr int kTurningTaper = 125;
constexpr int kFacingTaper = 126;

struct Box {
  Point start;
  Point cut_from;
  Point cut_to;
  Point out;
};

bool cut(Run& run, const Box& box) {
  if (!check_feed(run) || !check_target(run, box.cut_from)) return false;
  const Feed feed = run.active_feed();
  rapid_to(run, box.cut_from, kBothAxes);
  feed_to(run, box.cut_to, kBothAxes, feed);
  feed_to(run, box.out, kBothAxes, feed);
  rapid_to(run, box.start, kBothAxes);
  return true;
}

double word_or_zero(const Run& run, Address address) {
  return run.block.words.has(address) ? run.block.words[address] : 0;
}

void keep_end(Run& run, const Point& end) {
  run.parameters[kEndPoint] = end.z - run.state.origin.z;
  run.parameters[kDiameter] = (end.x - run.state.origin.x) * 2;
}

}  // namespace

bool cut_turning_box(Run& run) {
  Target target;
  if (!read_cycle_target(run, target)) return false;
  const Point start = run.state.position;
  const Point& end = target.to;
  const double taper = word_or_zero(run, Address::I);
  keep_end(run, end);
  run.parameters[kTurningTaper] = taper;
  run.parameters[kCutLength] = std::fabs(end.z - start.z);
  run.parameters[kCutDepth] = std::fabs(end.x - start.x);
  return cut(run, {start, {end.x + taper, start.z}, end, {start.x, end.z}});
}

bool cut_facing_box(Run& run) {
  Target target;
  if (!read_cycle_target(run, target)) return false;
  const Point start = run.state.position;
  const Point& end = target.to;
  const double taper = word_or_zero(run, Address::K);
  keep_end(run, end);
  run.parameters[kFacingTaper] = taper;
  run.parameters[kCutLength] = std::fabs(end.x - start.x);
  run.parameters[kCutDepth] = std::fabs(end.z - start.z);
  return cut(run, {start, {start.x, end.z + taper}, end, {end.x, start.z}});
}

}  // namespace dripline::interpreter::centurion
