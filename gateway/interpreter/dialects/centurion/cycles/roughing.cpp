#include "gateway/interpreter/dialects/centurion/cycles/roughing.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "gateway/interpreter/dialects/centurion/motion/arcs.hpp"

namespace dripline::interpreter::centurion {

namespace {

bool is_facing(const PatternCycle& cycle) {
  return cycle.code == 72;
}
bool is_motion(const PatternMove& move) {
  return move.kind != PatternMove::Kind::Spindle;
}

int sign_of(double value) {
  return value < 0 ? -1 : 1;
}

/// The first move of the pattern that changes the depth leads to the work (manual: G71).
ProfileFrame frame_of(const PatternCycle& cycle) {
  const auto depth = [&](const PlanePoint& p) { return is_facing(cycle) ? p.z : p.x; };
  const auto along = [&](const PlanePoint& p) { return is_facing(cycle) ? p.x : p.z; };
  int out = 1;
  double before = depth(cycle.start);
  bool is_found = false;
  for (const PatternMove& move : cycle.moves) {
    if (!is_motion(move)) continue;
    if (!is_found && std::fabs(depth(move.to) - before) > kSameLength) {
      out = -sign_of(depth(move.to) - before);
      is_found = true;
    }
    before = depth(move.to);
  }
  // An exit may lead back, so the farthest point decides the direction of the cuts.
  double reach = 0;
  for (const PatternMove& move : cycle.moves) {
    if (!is_motion(move)) continue;
    const double distance = along(move.to) - along(cycle.start);
    if (std::fabs(distance) > std::fabs(reach)) reach = distance;
  }
  return {is_facing(cycle), out, sign_of(reach)};
}

void add_move(ProfilePieces& profile, const ProfileFrame& frame, const PlanePoint& from,
              const PatternMove& move) {
  if (move.kind != PatternMove::Kind::Arc) {
    return add_line(profile, frame.of(from), frame.of(move.to));
  }
  add_arc(profile, {frame.of(from), frame.of(move.to), frame.of(move.center),
                    move.is_clockwise != frame.keeps_rotation(), move.sweep});
}

/// The contour as it is programmed, from the end of its first move on. `exit` is where its last
/// move begins.
ProfilePieces contour_of(const PatternCycle& cycle, const ProfileFrame& frame, std::size_t& exit) {
  ProfilePieces profile;
  PlanePoint from = cycle.start;
  bool is_first = true;
  exit = 0;
  for (const PatternMove& move : cycle.moves) {
    if (!is_motion(move)) continue;
    exit = profile.size();
    if (!is_first) add_move(profile, frame, from, move);
    is_first = false;
    from = move.to;
  }
  return profile;
}

/// The last move may lead back and out; it is no part of the work then.
void drop_exit(ProfilePieces& profile, std::size_t exit) {
  if (exit == 0 || exit >= profile.size()) return;
  const ProfilePoint& from = profile[exit].from;
  const ProfilePoint& to = profile.back().to;
  if (to.along < from.along - kSameLength && to.depth > from.depth - kSameLength) {
    profile.resize(exit);
  }
}

struct Rules {
  ErrorCode depth_reverses, along_reverses, exceeds_start;
};
Rules rules_of(const PatternCycle& cycle) {
  if (is_facing(cycle)) {
    return {ErrorCode::FacingDepthReverses, ErrorCode::FacingAlongReverses,
            ErrorCode::FacingExceedsStart};
  }
  return {ErrorCode::TurningDepthReverses, ErrorCode::TurningAlongReverses,
          ErrorCode::TurningExceedsStart};
}

/// In the program's own terms, for messages.
double shown(const Run& run, const PlanePoint& point) {
  const double mm = run.state.mm_per_unit();
  return is_facing(run.state.pattern) ? point.z / mm - run.state.origin.z
                                      : (point.x / mm - run.state.origin.x) * 2;
}

/// The height at which a rapid move clears the contour between two places.
double clear_height(const Roughing& roughing, double above, double from, double to) {
  const auto highest =
      highest_between(roughing.profile, from + 2 * kSameLength, to - 2 * kSameLength);
  double height = above;
  if (highest && *highest > above + kSameLength) {
    height += std::ceil((*highest - above) / roughing.step - kSameLength) * roughing.step;
    if (height > roughing.first_level + kSameLength) {
      height = std::max(roughing.start.depth, *highest);
    }
  }
  return height + roughing.relief;
}

/// One level in the frame of the cuts.
class LevelCut {
 public:
  LevelCut(PassWriter& writer, const Roughing& roughing, double level, double above)
      : writer_(writer), roughing_(roughing), level_(level), above_(above) {}

  void cut(const std::vector<OpenInterval>& intervals) {
    double passed = roughing_.start.along;
    for (const OpenInterval& interval : intervals) {
      enter(interval, passed);
      feed({level_, interval.to});
      leave(interval);
      passed = interval.to;
    }
    if (intervals.size() > 1 || !intervals.front().is_open_at_start) {
      const double height = clear_height(roughing_, above_, roughing_.start.along, passed);
      if (height > tool().depth) rapid({height, tool().along});
    }
    rapid({tool().depth, roughing_.start.along});
  }

 private:
  ProfilePoint tool() const { return roughing_.frame.of(writer_.tool()); }
  void rapid(const ProfilePoint& to) { writer_.rapid(roughing_.frame.back(to)); }
  void feed(const ProfilePoint& to) { writer_.line(roughing_.frame.back(to), roughing_.feed); }

  void enter(const OpenInterval& interval, double passed) {
    if (interval.is_open_at_start) return rapid({level_, roughing_.start.along});
    const double height = clear_height(roughing_, above_, passed, interval.from);
    rapid({height, tool().along});
    rapid({height, interval.from});
    rapid({above_, interval.from});
    feed({level_, interval.from});
  }

  void leave(const OpenInterval& interval) {
    const ProfilePoint at = tool();
    if (roughing_.relief_is_45) {
      return rapid({at.depth + roughing_.relief,
                    std::max(at.along - roughing_.relief, roughing_.start.along)});
    }
    follow(interval.closing_piece);
    rapid({tool().depth + roughing_.relief, tool().along});
  }

  /// Up along the contour to the cut before, or to where the contour goes down again.
  void follow(std::size_t piece) {
    for (; piece < roughing_.profile.size(); ++piece) {
      const ProfilePiece& each = roughing_.profile[piece];
      if (each.to.depth < each.from.depth - kSameLength || tool().depth >= above_ - kSameLength) {
        return;
      }
      const bool is_last = each.to.depth >= above_ - kSameLength;
      const ProfilePoint to = is_last ? ProfilePoint{above_, along_at(each, above_)} : each.to;
      follow(each, to);
    }
  }

  void follow(const ProfilePiece& piece, const ProfilePoint& to) {
    const ProfilePoint from = tool();
    const bool is_there = std::fabs(to.depth - from.depth) < kSameLength &&
                          std::fabs(to.along - from.along) < kSameLength;
    if (is_there) return;
    if (!piece.is_arc) return feed(to);
    const ProfileFrame& frame = roughing_.frame;
    writer_.arc(frame.back(to), frame.back(piece.center),
                piece.is_counterclockwise != frame.keeps_rotation(), roughing_.feed);
  }

  PassWriter& writer_;
  const Roughing& roughing_;
  double level_;
  double above_;
};

}  // namespace

bool check_roughing(Run& run) {
  const PatternCycle& cycle = run.state.pattern;
  const ProfileFrame frame = frame_of(cycle);
  const Rules rules = rules_of(cycle);
  std::size_t exit = 0;
  ProfilePieces profile = contour_of(cycle, frame, exit);
  if (profile.empty()) {
    return run.fail(ErrorCode::IllegalStatement, 0, "the pattern has fewer than two moves");
  }
  const ProfilePoint start = frame.of(cycle.start);
  for (const ProfilePiece& piece : profile) {
    if (piece.to.depth <= start.depth + kSameLength) continue;
    return run.fail(rules.exceeds_start, 0,
                    fmt::format("{:.4f} is beyond {:.4f}", shown(run, frame.back(piece.to)),
                                shown(run, cycle.start)));
  }
  drop_exit(profile, exit);
  for (const ProfilePiece& piece : profile) {
    if (piece.to.along < piece.from.along - kSameLength) return run.fail(rules.along_reverses, 0);
    if (cycle.relief_is_45 && piece.to.depth < piece.from.depth - kSameLength) {
      return run.fail(rules.depth_reverses, 0);
    }
  }
  if (cycle.has_first_level) {
    const double level = frame.of({cycle.first_level, cycle.first_level}).depth;
    if (level > start.depth + kSameLength) {
      return run.fail(ErrorCode::ParameterOutOfRange, 0,
                      "the first cut V is beyond the start point");
    }
  }
  return true;
}

Roughing roughing_of(const PatternCycle& cycle) {
  Roughing roughing{frame_of(cycle), {}, {}, 0, 0, 0, false, {}};
  const ProfileFrame& frame = roughing.frame;
  const ProfilePoint stock =
      frame.of({cycle.finish.x + cycle.rough.x, cycle.finish.z + cycle.rough.z});
  roughing.start = frame.of(cycle.start);
  std::size_t exit = 0;
  roughing.profile = contour_of(cycle, frame, exit);
  drop_exit(roughing.profile, exit);
  shift(roughing.profile, stock.depth, stock.along);
  const ProfilePoint last = roughing.profile.empty() ? roughing.start : roughing.profile.back().to;
  if (last.depth < roughing.start.depth) {
    add_line(roughing.profile, last, {roughing.start.depth, last.along});
  }
  roughing.step = cycle.step;
  roughing.relief = cycle.relief;
  roughing.relief_is_45 = cycle.relief_is_45;
  roughing.feed = cycle.feed;
  roughing.first_level = roughing.start.depth + stock.depth - cycle.step;
  if (cycle.has_first_level) {
    roughing.first_level = frame.of({cycle.first_level, cycle.first_level}).depth;
  }
  return roughing;
}

bool cut_level(PassWriter& writer, const Roughing& roughing, std::uint32_t number) {
  const double level = roughing.first_level - number * roughing.step;
  const auto intervals = open_at(roughing.profile, level, roughing.start.along);
  if (intervals.empty()) return false;
  const double above = number == 0 ? roughing.start.depth : level + roughing.step;
  LevelCut(writer, roughing, level, above).cut(intervals);
  return true;
}

void cut_contour(Run& run, PassWriter& writer) {
  const PatternCycle& cycle = run.state.pattern;
  const ProfileFrame frame = frame_of(cycle);
  const Origin origin = run.origin;
  Feed feed = cycle.feed;
  bool is_first = true;
  for (const PatternMove& move : cycle.moves) {
    run.origin.line = move.line;
    run.origin.sequence = move.sequence;
    if (is_first && move.kind == PatternMove::Kind::Arc) {
      writer.rapid({cycle.start.x + cycle.finish.x, cycle.start.z + cycle.finish.z});
    }
    if (is_motion(move)) is_first = false;
    if (move.kind == PatternMove::Kind::Line || move.kind == PatternMove::Kind::Arc) {
      const Length length = Length::mm(move.feed);
      feed = move.is_feed_per_revolution ? Feed::per_revolution(length) : Feed::per_minute(length);
    }
    writer.follow(move, cycle.finish, std::nullopt);
  }
  run.origin = origin;
  const ProfilePoint at = frame.of(writer.tool());
  const ProfilePoint start = frame.of(cycle.start);
  if (at.depth < start.depth) writer.line(frame.back({start.depth, at.along}), feed);
  writer.rapid(cycle.start);
}

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
