#include <fmt/core.h>
#include <algorithm>
#include <array>
#include <cmath>

#include "gateway/interpreter/dialects/fanuc/execution/motion.hpp"
#include "gateway/interpreter/dialects/fanuc/turning/turning.hpp"

/// G70 to G76: what their words mean, and the cycles without a contour.
namespace dripline::interpreter::fanuc {
namespace {

constexpr double kMaxCuts = 5000;

bool refuse_cycle(Run& run, std::uint32_t column, std::string_view why) {
  return run.fail(ErrorCode::IllegalContour, column, why);
}

/// A radius or a length of the cycles, not negative; P and Q have no point and count increments.
double size_of(const Run& run, Address address) {
  const Word& word = run.block.words[address];
  const bool counts = word.form == WordForm::Whole && (address == P || address == Q);
  return counts ? word.value / run.increments.per_unit * run.increments.mm_per_unit
                : run.length(word);
}

/// The first block of a pair: data for the next.
bool keep_cycle_data(Run& run, std::uint8_t code) {
  const Words& words = run.block.words;
  TurningData& data = run.state.turning;
  const AddressSet known = code == 171   ? set_of(U, R)
                           : code == 172 ? set_of(W, R)
                           : code == 173 ? set_of(U, W, R)
                           : code == 176 ? set_of(P, Q, R)
                                         : set_of(R);
  constexpr AddressSet kOthers = kAxisWords | kCenterWords | set_of(P, Q, R);
  if (const AddressSet bad = words.present() & kOthers & ~known; bad != 0) {
    return refuse_cycle(run, words.first_column(bad), "not a word of this block of the cycle");
  }
  run.ledger.take(known);
  switch (code) {
    case 171:
    case 172:
      if (words.has(U)) data.depth = size_of(run, U);
      if (words.has(W)) data.depth = size_of(run, W);
      if (words.has(R)) data.escape = size_of(run, R);
      if (data.depth > 0 && data.escape >= 0) return true;
      return refuse_cycle(run, run.block.parts.g_column, "the depth of a cut is above 0");
    case 173:
      if (words.has(U)) data.relief_x = size_of(run, U);
      if (words.has(W)) data.relief_z = size_of(run, W);
      if (words.has(R)) data.repeats = run.whole(words[R]);
      if (data.repeats >= 1 && data.repeats <= kMaxCuts && data.repeats == std::trunc(data.repeats))
        return true;
      return refuse_cycle(run, run.block.parts.g_column, "R is the number of passes");
    case 176: {
      if (words.has(P)) {
        const double written = run.whole(words[P]);
        data.thread_finishes = std::trunc(written / 10'000);
        data.thread_chamfer = std::fmod(std::trunc(written / 100), 100) / 10;
        data.thread_angle = std::fmod(written, 100);
      }
      if (words.has(Q)) data.thread_least = size_of(run, Q);
      if (words.has(R)) data.thread_finish = size_of(run, R);
      constexpr std::array kAngles{80., 60., 55., 30., 29., 0.};
      const bool is_angle =
          std::find(kAngles.begin(), kAngles.end(), data.thread_angle) != kAngles.end();
      if (data.thread_finishes >= 1 && is_angle && data.thread_finish >= 0) return true;
      return refuse_cycle(run, words.column(P),
                          "P is passes, chamfer and angle: 01 to 99, 00 to 99, 80 60 55 30 29 00");
    }
    default:
      data.peck_return = words.has(R) ? size_of(run, R) : data.peck_return;
      return true;
  }
}

/// G70 to G73 with P and Q: from here on the program goes through the contour.
bool begin_contour_cycle(Run& run, std::uint8_t code) {
  ModalState& state = run.state;
  const Words& words = run.block.words;
  const std::uint32_t column = run.block.parts.g_column;
  if (state.contour.code != 0) return refuse_cycle(run, column, "a cycle within P to Q");
  if (run.options.is_dnc && state.at.program == kMainProgram) {
    return run.fail(ErrorCode::MacroInDnc, column, "the contour of a cycle");
  }
  if (!words.has(P) || !words.has(Q)) return refuse_cycle(run, column, "P and Q name the contour");
  if (code != 170 && state.is_compensating())
    return refuse_cycle(run, column, "roughing needs G40");
  if (code != 170 && state.plane() != Plane::ZX)
    return refuse_cycle(run, column, "roughing needs G18");
  if (code != 170 && !check_feed(run)) return false;
  if ((code == 171 || code == 172) && !(state.turning.depth > 0)) {
    return refuse_cycle(run, column, "no depth of cut: G71 U R, or G72 W R, comes before");
  }
  if (code == 173 && !(state.turning.repeats >= 1)) {
    return refuse_cycle(run, column, "no passes: G73 U W R comes before");
  }
  const double first = run.whole(words[P]);
  const double last = run.whole(words[Q]);
  if (!(first >= 1 && first <= 99'999'999 && last >= 1 && last <= 99'999'999)) {
    return refuse_cycle(run, words.column(P), "P and Q are sequence numbers");
  }
  run.ledger.take(set_of(Q, U, W));
  ContourCycle& cycle = state.contour;
  cycle = {};
  cycle.code = code;
  cycle.last = static_cast<std::uint32_t>(last);
  if (words.has(U)) cycle.allowance_x = run.coordinate(Axis::X, words[U]);
  if (words.has(W)) cycle.allowance_z = run.length(words[W]);
  ModesBefore& before = state.modes_before;
  before = {state.g,       state.feed, state.position, state.spindle,
            state.coolant, state.tool, state.h_number, state.d_number};
  Jump& jump = state.jump;
  jump = Jump{};
  jump.kind = JumpKind::Goto;
  jump.is_return = true;
  jump.number = static_cast<std::uint32_t>(first);
  jump.from = state.at;
  run.events();
  run.lead_stages();
  return true;
}

/// G74 pecks along Z and steps along X, G75 the reverse.
bool cut_pecks(Run& run, bool along_z) {
  ModalState& state = run.state;
  const Words& words = run.block.words;
  const Axis peck_axis = along_z ? Axis::Z : Axis::X;
  const Axis step_axis = along_z ? Axis::X : Axis::Z;
  const Address peck_word = along_z ? Q : P;
  const Address step_word = along_z ? P : Q;
  run.ledger.take(kAxisWords | set_of(Q, R));
  if (!check_feed(run)) return false;
  Position to;
  if (!read_target(run, to)) return false;
  const Position start = state.position;
  const double depth = to.raw(peck_axis) - start.raw(peck_axis);
  const double width = to.raw(step_axis) - start.raw(step_axis);
  const double peck = words.has(peck_word) ? size_of(run, peck_word) : std::fabs(depth);
  const double step = words.has(step_word) ? size_of(run, step_word) : 0;
  const std::uint32_t column = run.block.parts.g_column;
  if (words.has(R) && size_of(run, R) != 0) {
    return refuse_cycle(run, words.column(R),
                        "R, the relief at the bottom: whether the first cut, between two walls, "
                        "has it differs between controls");
  }
  if (depth == 0) return refuse_cycle(run, column, "the cycle has no depth");
  if (!(peck > 0) || step < 0) return refuse_cycle(run, column, "P and Q are above 0");
  if (width != 0 && step == 0)
    return refuse_cycle(run, column, "the step between the cuts is missing");
  const double cuts = width == 0 ? 0 : std::ceil(std::fabs(width) / step - 1e-9);
  const double pecks = std::ceil(std::fabs(depth) / peck - 1e-9);
  if (!((cuts + 1) * pecks <= kMaxCuts)) {
    return refuse_cycle(run, column, fmt::format("more than {} pecks in one block", kMaxCuts));
  }
  const Feed feed = run.active_feed();
  const auto at = [&](Axis axis, double value) {
    Position place = state.position;
    place.set_raw(axis, value);
    return place;
  };
  const double sign = depth < 0 ? -1 : 1;
  for (double cut = 0; cut <= cuts; ++cut) {
    const double along =
        cut == cuts ? to.raw(step_axis) : start.raw(step_axis) + std::copysign(cut * step, width);
    if (!rapid_to(run, at(step_axis, along))) return false;
    for (double n = 1; n < pecks; ++n) {
      const double reached = start.raw(peck_axis) + sign * n * peck;
      const double back = std::fmin(state.turning.peck_return, n * peck);
      if (!line_to(run, at(peck_axis, reached), feed) ||
          !rapid_to(run, at(peck_axis, reached - sign * back))) {
        return false;
      }
    }
    if (!line_to(run, at(peck_axis, to.raw(peck_axis)), feed)) return false;
    if (!rapid_to(run, at(peck_axis, start.raw(peck_axis)))) return false;
  }
  return rapid_to(run, start);
}

/// The depths of G76, radii from the crest: the area of each cut is the same.
class ThreadPasses {
 public:
  ThreadPasses(Run& run, const Position& end, double taper, double height, double first)
      : run_(run),
        data_(run.state.turning),
        start_(run.state.position),
        end_(end),
        taper_(taper),
        height_(height),
        first_(first),
        out_(start_.raw(Axis::X) > end.raw(Axis::X) ? 1 : -1) {}

  /// Otherwise X goes back into the work after each pass, and the pull-out before that.
  bool begins_outside() const {
    const double first = std::min(first_, height_ - data_.thread_finish);
    const double crest = end_.raw(Axis::X) + out_ * (height_ - first);
    const double rise = std::max(out_ * taper_, 0.0);
    return out_ * (start_.raw(Axis::X) - crest) - rise >= -1e-9;
  }

  bool make() {
    const double rough = height_ - data_.thread_finish;
    double reached = 0;
    for (int n = 1; reached < rough - 1e-9; ++n) {
      if (n > kMaxCuts) return refuse_cycle(run_, run_.block.parts.g_column, "too many passes");
      double next = first_ * std::sqrt(n);
      if (next - reached < data_.thread_least) next = reached + data_.thread_least;
      reached = std::min(next, rough);
      if (!pass(reached)) return false;
    }
    for (double n = 0; n < data_.thread_finishes; ++n) {
      if (!pass(height_)) return false;
    }
    return true;
  }

 private:
  /// Infeed along one flank. The taper is that from the start to the end, wherever a pass begins:
  /// all of them are parallel.
  bool pass(double depth) {
    const double half = data_.thread_angle / 2 * (Angle::kPi / 180);
    const double along = end_.raw(Axis::Z) - start_.raw(Axis::Z);
    const double shift = std::copysign(depth * std::tan(half), along);
    const double rise = taper_ * (1 - shift / along);
    const double root = end_.raw(Axis::X);  // where the thread is deepest
    Position begin = start_;
    begin.set_raw(Axis::Z, start_.raw(Axis::Z) + shift);
    Position cut = begin;
    cut.set_raw(Axis::X, root + rise + out_ * (height_ - depth));
    Position end = end_;
    end.set_raw(Axis::X, root + out_ * (height_ - depth));
    if (!rapid_to(run_, begin) || !rapid_to(run_, cut)) return false;
    if (!thread(cut, end)) return false;
    Position away = run_.state.position;
    away.set_raw(Axis::X, start_.raw(Axis::X));
    return rapid_to(run_, away) && rapid_to(run_, start_);
  }

  Length lead(const Position& from, const Position& to) const {
    return lead_of_path(from, to, run_.state.feed[1]);
  }

  bool thread(const Position& cut, const Position& end) {
    const double chamfer = data_.thread_chamfer * run_.state.feed[1];
    const double along = end.raw(Axis::Z) - cut.raw(Axis::Z);
    if (!(chamfer > 0 && chamfer < std::fabs(along))) {
      return thread_to(run_, end, lead(cut, end), {});
    }
    const double part = 1 - chamfer / std::fabs(along);
    Position turn = end;
    turn.set_raw(Axis::X, cut.raw(Axis::X) + part * (end.raw(Axis::X) - cut.raw(Axis::X)));
    turn.set_raw(Axis::Z, cut.raw(Axis::Z) + part * along);
    // at 45 degrees, until X is where the pass began
    const double pull = std::min(chamfer, std::fabs(start_.raw(Axis::X) - turn.raw(Axis::X)));
    Position out = turn;
    out.set_raw(Axis::X, turn.raw(Axis::X) + out_ * pull);
    out.set_raw(Axis::Z, turn.raw(Axis::Z) + std::copysign(pull, along));
    return thread_to(run_, turn, lead(cut, turn), {}) && thread_to(run_, out, lead(turn, out), {});
  }

  Run& run_;
  const TurningData& data_;
  Position start_, end_;
  double taper_, height_, first_;
  double out_;  ///< away from the work
};

bool cut_threads(Run& run) {
  ModalState& state = run.state;
  const Words& words = run.block.words;
  const std::uint32_t column = run.block.parts.g_column;
  run.ledger.take(kAxisWords | set_of(Q, R));
  if (!(state.turning.thread_finishes >= 1)) {
    return refuse_cycle(run, column, "no passes and angle: G76 P Q R comes before");
  }
  if (!words.has(P) || !words.has(Q))
    return refuse_cycle(run, column, "P is the height, Q the first cut");
  if (!(state.feed[1] > 0)) return run.fail(ErrorCode::NoFeed, words.column(F));
  const double height = size_of(run, P);
  const double first = size_of(run, Q);
  const double taper = words.has(R) ? size_of(run, R) : 0;
  if (!(height > 0 && first > 0 && state.turning.thread_finish < height)) {
    return refuse_cycle(run, words.column(P), "height and first cut are above 0");
  }
  Position end;
  if (!read_target(run, end)) return false;
  if (end.raw(Axis::Z) == state.position.raw(Axis::Z) ||
      end.raw(Axis::X) == state.position.raw(Axis::X)) {
    return refuse_cycle(run, column, "the cycle has no length or no height");
  }
  const double half = state.turning.thread_angle / 2 * (Angle::kPi / 180);
  const double travel = std::fabs(end.raw(Axis::Z) - state.position.raw(Axis::Z));
  if (travel <= height * std::tan(half)) {
    return refuse_cycle(run, column, "the thread is shorter than its infeed along the flank");
  }
  ThreadPasses passes(run, end, taper, height, first);
  if (!passes.begins_outside()) {
    return refuse_cycle(run, column, "the first cut is beyond where X is at the cycle's start");
  }
  return passes.make();
}

}  // namespace

bool execute_turning_cycle(Run& run) {
  const Words& words = run.block.words;
  const std::uint8_t code = run.block.parts.one_shot;
  if (run.state.contour.code != 0) {
    return refuse_cycle(run, run.block.parts.g_column, "a cycle within P to Q");
  }
  constexpr AddressSet kOneBlockForm = kCenterWords | set_of(A, D);
  if (const AddressSet old = words.present() & kOneBlockForm; old != 0) {
    return refuse_cycle(run, words.first_column(old), "the form of one block is another control's");
  }
  if (code == 170) return begin_contour_cycle(run, code);
  const bool has_contour = code <= 173;
  const bool is_first = has_contour ? !words.has(P) && !words.has(Q) : !words.has_any(kAxisWords);
  if (is_first) return keep_cycle_data(run, code);
  if (has_contour) return begin_contour_cycle(run, code);
  if (run.state.is_compensating()) {
    return refuse_cycle(run, run.block.parts.g_column, "the cycle needs G40");
  }
  if (!resolve_increments(run)) return false;
  run.block.parts.has_motion = true;
  return code == 176 ? cut_threads(run) : cut_pecks(run, code == 174);
}

}  // namespace dripline::interpreter::fanuc
