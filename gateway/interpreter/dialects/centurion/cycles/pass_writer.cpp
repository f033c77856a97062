#include "gateway/interpreter/dialects/centurion/cycles/pass_writer.hpp"

#include <cmath>

#include "gateway/interpreter/dialects/centurion/cycles/profile.hpp"
#include "gateway/interpreter/dialects/centurion/motion/arcs.hpp"

namespace dripline::interpreter::centurion {
namespace {

constexpr double kNoMove = 1e-9;

Spindle spindle_of(const PatternMove& move, const Origin& origin) {
  Spindle event;
  event.origin = origin;
  event.state = move.spindle;
  event.revolutions_per_minute = move.revolutions;
  if (move.surface >= 0) event.surface_speed = Length::mm(move.surface);
  if (move.max_revolutions >= 0) event.max_revolutions = move.max_revolutions;
  return event;
}

Feed feed_of(const PatternMove& move) {
  const Length feed = Length::mm(move.feed);
  return move.is_feed_per_revolution ? Feed::per_revolution(feed) : Feed::per_minute(feed);
}

}  // namespace

bool PassWriter::is_at(const PlanePoint& to) const {
  return std::fabs(to.x - cycle_.tool.x) < kNoMove && std::fabs(to.z - cycle_.tool.z) < kNoMove;
}

Position PassWriter::position_of(const PlanePoint& to) {
  run_.state.moved_axes = 3;
  Position position;
  position.set(Axis::X, Length::mm(to.x));
  position.set(Axis::Z, Length::mm(to.z));
  return position;
}

void PassWriter::arrive(const PlanePoint& to) {
  run_.loops.note_progress();
  const double mm = run_.state.mm_per_unit();
  cycle_.tool = to;
  run_.state.position = {to.x / mm, to.z / mm};
}

void PassWriter::rapid(const PlanePoint& to) {
  if (is_at(to)) return;
  run_.events().on_rapid({run_.origin, position_of(to)});
  arrive(to);
}

void PassWriter::line(const PlanePoint& to, Feed feed) {
  if (is_at(to)) return;
  run_.events().on_line({run_.origin, position_of(to), feed});
  arrive(to);
}

void PassWriter::arc(const PlanePoint& to, const PlanePoint& center, bool is_clockwise, Feed feed) {
  Arc event;
  event.origin = run_.origin;
  event.plane = Plane::ZX;
  event.turn = is_clockwise ? Turn::Clockwise : Turn::Counterclockwise;
  event.center_first = Length::mm(center.z);
  event.center_second = Length::mm(center.x);
  event.sweep = Angle::degrees(sweep_of({cycle_.tool, to, center, is_clockwise}));
  event.feed = feed;
  event.to = position_of(to);
  run_.events().on_arc(event);
  arrive(to);
}

void PassWriter::follow(const PatternMove& move, const PlanePoint& stock,
                        std::optional<Feed> feed) {
  const PlanePoint to{move.to.x + stock.x, move.to.z + stock.z};
  switch (move.kind) {
    case PatternMove::Kind::Rapid:
      return rapid(to);
    case PatternMove::Kind::Line:
      return line(to, feed ? *feed : feed_of(move));
    case PatternMove::Kind::Arc:
      return arc(to, {move.center.x + stock.x, move.center.z + stock.z}, move.is_clockwise,
                 feed ? *feed : feed_of(move));
    case PatternMove::Kind::Spindle:
      if (!feed) run_.events().on_spindle(spindle_of(move, run_.origin));
  }
}

}  // namespace dripline::interpreter::centurion
