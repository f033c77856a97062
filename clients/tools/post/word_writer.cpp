#include <fmt/format.h>
#include <algorithm>

#include "clients/tools/post/carried_comments.hpp"
#include "clients/tools/post/program_writer.hpp"
#include "gateway/interpreter/core/geometry/plane_axes.hpp"
#include "protocol/base/invariant.hpp"

namespace dripline::post {
namespace {

using interpreter::Axis;
using interpreter::Plane;
using interpreter::SpindleState;
using interpreter::Units;

/// How a tool is called.
enum class ToolCall : std::uint8_t { Change, Turret, TurretWithM6 };

/// The words of a control of G and M codes.
struct WordRow {
  std::string_view target = {};
  std::string_view g_format = {};  ///< of a G or M code below 100
  bool has_program_number = true;  ///< O
  bool has_tape_marks = true;      ///< % around the program
  std::string_view modes = {};     ///< of the head, after G20 or G21
  std::string_view per_minute = {};
  std::string_view per_revolution = {};
  bool starts_per_minute = false;  ///< the head puts feed per minute in force
  std::string_view dwell = {};     ///< with the address
  int dwell_shift = 0;  ///< decimals of seconds that its unit takes in: 3 of milliseconds
  std::string_view length_call = {};  ///< of the tool's length; ends with H: its number follows
  std::string_view thread = {};       ///< with the motion that it needs
  int thread_motion = -1;             ///< in force after it; -1: a code that is none of 0 to 3
  int thread_angle_decimals = 0;      ///< of Q in degrees
  ToolCall tool = ToolCall::Change;
  std::string_view speed_limit =
      {};                     ///< before the value, in a block of its own; D: in that of G96
  bool has_points = false;    ///< whole coordinates have a point
  bool has_capitals = false;  ///< comments in capitals
  std::string_view end = {};
};

constexpr std::array kRows{
    WordRow{.target = "centurion",
            .g_format = "{}{}",
            .has_tape_marks = false,
            .modes = "G40 G80 G93 G97 G501 G550 G569 G54",
            .per_minute = "G98",
            .per_revolution = "G99",
            .dwell = "G4 P",
            .thread = "G32 G1",
            .thread_motion = 1,
            .thread_angle_decimals = 3,
            .tool = ToolCall::TurretWithM6,
            .speed_limit = "G50 S",
            .has_points = true,
            .has_capitals = true,
            .end = "M30"},
    WordRow{.target = "fanuc",
            .g_format = "{}{:02}",
            .modes = "G17 G40 G49 G80 G90 G94 G54",
            .per_minute = "G94",
            .per_revolution = "G95",
            .starts_per_minute = true,
            .dwell = "G04 P",
            .dwell_shift = 3,
            .length_call = "G43 H",
            .has_points = true,
            .has_capitals = true,
            .end = "M30"},
    WordRow{.target = "fanuc-t",
            .g_format = "{}{:02}",
            .modes = "G40 G97 G54",
            .per_minute = "G98",
            .per_revolution = "G99",
            .dwell = "G04 P",
            .dwell_shift = 3,
            .thread = "G32",
            .tool = ToolCall::Turret,
            .speed_limit = "G50 S",
            .has_points = true,
            .has_capitals = true,
            .end = "M30"},
    WordRow{.target = "linuxcnc",
            .g_format = "{}{}",
            .has_program_number = false,
            .modes = "G17 G40 G49 G80 G90 G91.1 G94 G97 G54",
            .per_minute = "G94",
            .per_revolution = "G95",
            .starts_per_minute = true,
            .dwell = "G4 P",
            .length_call = "G43",
            .speed_limit = "D",
            .end = "M2"},
    WordRow{.target = "rs274ngc",
            .g_format = "{}{}",
            .has_program_number = false,
            .modes = "G17 G40 G49 G80 G90 G94 G54",
            .per_minute = "G94",
            .starts_per_minute = true,
            .dwell = "G4 P",
            .length_call = "G43 H",
            .end = "M2"},
};

std::string in_capitals(std::string_view text) {
  std::string capitals(text);
  for (char& c : capitals) {
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  }
  return capitals;
}

class WordWriter final : public ProgramWriter {
 public:
  WordWriter(const Target& target, const WordRow& row) : target_(target), row_(row) {}

  void head(std::string& out, const ProgramHead& head) override {
    units_ = head.units;
    if (row_.has_tape_marks) block(out, "%");
    if (row_.has_program_number) block(out, fmt::format("O{:04}", head.number));
    block(out, fmt::format("{} {}", head.units == Units::Inch ? "G20" : "G21", row_.modes));
    if (row_.starts_per_minute) is_per_revolution_ = false;
  }

  void rapid(std::string& out, const MoveWords& move) override { straight(out, 0, move); }
  void line(std::string& out, const MoveWords& move) override { straight(out, 1, move); }

  bool arc(std::string& out, const ArcWords& arc) override {
    if (has_length_pending_ && arc.named.test(static_cast<std::size_t>(Axis::Z)))
      block(out, take_length_call());
    std::string words;
    if (!target_.is_lathe && plane_ != arc.plane) {
      constexpr std::array<std::string_view, 3> kPlanes{"G17", "G18", "G19"};
      append(words, kPlanes[static_cast<std::size_t>(arc.plane)]);
      plane_ = arc.plane;
    }
    append_feed_mode(words, arc.feed);
    append_motion(words, arc.turn == interpreter::Turn::Clockwise ? 2 : 3);
    append_compensation(words, arc.compensation);
    append_coordinates(words, arc);
    const auto axes = interpreter::axes_of(arc.plane);
    std::array<std::pair<Axis, std::int64_t>, 2> centers{
        {{axes.first, arc.center[0]}, {axes.second, arc.center[1]}}};
    if (centers[0].first > centers[1].first) std::swap(centers[0], centers[1]);
    for (const auto& [axis, value] : centers) {
      append(words, std::string(1, "IJK"[static_cast<std::size_t>(axis)]));
      append_number(words, value, range_of(target_.coordinate, units_).decimals, look());
    }
    append_feed(words, arc.feed);
    block(out, words);
    return true;
  }

  void thread(std::string& out, const ThreadWords& thread) override {
    std::string words;
    append_feed_mode(words, FeedWord{.is_per_revolution = true});
    append(words, row_.thread);
    motion_ = row_.thread_motion;
    append_coordinates(words, thread);
    append(words, "F");
    append_number(words, thread.lead, range_of(target_.feed_per_revolution, units_).decimals,
                  look());
    if (thread.start) {
      append(words, "Q");
      append_number(words, *thread.start, row_.thread_angle_decimals);
    }
    block(out, words);
  }

  void dwell(std::string& out, std::int64_t counts) override {
    std::string words(row_.dwell);
    append_number(words, counts, target_.dwell.decimals - row_.dwell_shift);
    block(out, words);
  }

  Result<void> spindle(std::string& out, const interpreter::Spindle& spindle) override {
    if (spindle.state == SpindleState::Off || spindle.state == SpindleState::Oriented) {
      block(out, code('M', spindle.state == SpindleState::Off ? 5 : 19));
      return {};
    }
    std::string words;
    const bool is_surface = spindle.surface_speed.has_value();
    const bool has_limit_word = row_.speed_limit == "D";
    if (is_surface != is_surface_ || (is_surface && has_limit_word))
      append(words, is_surface ? "G96" : "G97");
    is_surface_ = is_surface;
    if (is_surface && has_limit_word) {
      if (spindle.max_revolutions) append(words, fmt::format("D{:g}", *spindle.max_revolutions));
    } else if (is_surface) {
      if (auto limited = limit(out, spindle); !limited) return limited;
    }
    append_speed(words, spindle);
    append(words, code('M', spindle.state == SpindleState::Clockwise ? 3 : 4));
    block(out, words);
    return {};
  }

  Result<void> coolant(std::string& out, bool flood, bool mist) override {
    if ((has_flood_ && !flood) || (has_mist_ && !mist)) {
      if (flood || mist) {
        return fail(Errc::Unsupported, "{} coolant alone is switched off: {} switches off both",
                    flood ? "mist" : "flood", target_.name);
      }
      block(out, code('M', 9));
    } else {
      if (flood && !has_flood_ && mist && !has_mist_) {
        return fail(Errc::Unsupported,
                    "flood and mist coolant are switched on at once: {} "
                    "switches on one after the other",
                    target_.name);
      }
      if (flood && !has_flood_) block(out, code('M', 8));
      if (mist && !has_mist_) block(out, code('M', 7));
      if (!flood && !mist) block(out, code('M', 9));
    }
    has_flood_ = flood;
    has_mist_ = mist;
    return {};
  }

  void tool(std::string& out, const interpreter::ToolChange& tool) override {
    if (row_.tool == ToolCall::Change) {
      block(out, fmt::format("T{} {}", tool.number, code('M', 6)));
      has_length_pending_ = tool.number != 0 && !row_.length_call.empty();
      tool_ = tool.number;
      return;
    }
    block(out, fmt::format("T{:02}{:02}{}", tool.number, tool.offset.value_or(tool.number),
                           row_.tool == ToolCall::TurretWithM6 ? " M6" : ""));
  }

  void machine_function(std::string& out, int number) override { block(out, code('M', number)); }

  void stop(std::string& out, interpreter::StopKind kind) override {
    block(out, code('M', kind == interpreter::StopKind::Optional ? 1 : 0));
  }

  void comment(std::string& out, std::string_view text) override {
    const bool would_act = !row_.has_program_number && is_active_comment(text);
    block(out, fmt::format("({}{})", would_act ? "* " : "",
                           row_.has_capitals ? in_capitals(text) : std::string(text)));
  }

  void end(std::string& out) override {
    block(out, row_.end);
    if (row_.has_tape_marks) block(out, "%");
  }

 private:
  void block(std::string& out, std::string_view words) {
    out += words;
    out += '\n';
    count_block();
  }
  static void append(std::string& words, std::string_view word) {
    if (!words.empty()) words += ' ';
    words += word;
  }
  std::string code(char address, int number) const {
    return fmt::format(fmt::runtime(row_.g_format), address, number);
  }
  NumberLook look() const { return {.has_point = row_.has_points}; }

  void append_motion(std::string& words, int motion) {
    if (motion_ == motion) return;
    motion_ = motion;
    append(words, code('G', motion));
  }
  /// The side and its radius, in the first move that has them.
  void append_compensation(std::string& words, const KeptCompensation::State& state) {
    const bool is_off = state.side == interpreter::CompensationSide::Off;
    if (side_ == state.side && (is_off || radius_number_ == state.number)) return;
    side_ = state.side;
    radius_number_ = state.number;
    append(words, code('G', 40 + static_cast<int>(state.side)));
    if (!is_off) append(words, fmt::format("D{}", state.number));
  }
  void append_feed_mode(std::string& words, const std::optional<FeedWord>& feed) {
    if (!feed || is_per_revolution_ == feed->is_per_revolution) return;
    is_per_revolution_ = feed->is_per_revolution;
    append(words, feed->is_per_revolution ? row_.per_revolution : row_.per_minute);
  }
  void append_feed(std::string& words, const std::optional<FeedWord>& feed) const {
    if (!feed) return;
    append(words, "F");
    const auto& ranges = feed->is_per_revolution ? target_.feed_per_revolution : target_.feed;
    append_number(words, feed->counts, range_of(ranges, units_).decimals, look());
  }
  void append_coordinates(std::string& words, const MoveWords& move) const {
    for (const Axis axis : interpreter::kAllAxes) {
      const auto i = static_cast<std::size_t>(axis);
      if (!move.named.test(i)) continue;
      append(words, std::string(1, letter(axis)));
      append_number(words, move.at[i], range_of(target_.coordinate, units_).decimals, look());
    }
  }
  std::string take_length_call() {
    has_length_pending_ = false;
    std::string call(row_.length_call);
    return call.ends_with('H') ? call + std::to_string(tool_) : call;
  }
  void straight(std::string& out, int motion, const MoveWords& move) {
    std::string words;
    append_feed_mode(words, move.feed);
    append_motion(words, motion);
    append_compensation(words, move.compensation);
    if (has_length_pending_ && move.named.test(static_cast<std::size_t>(Axis::Z)))
      append(words, take_length_call());
    append_coordinates(words, move);
    append_feed(words, move.feed);
    block(out, words);
  }

  /// Of the revolutions at a constant surface speed, in a block before.
  Result<void> limit(std::string& out, const interpreter::Spindle& spindle) {
    const double most = spindle.max_revolutions.value_or(0);
    if (most == limit_) return {};
    if (most == 0) {
      return fail(Errc::Unsupported, "the spindle's limit of {:g} rpm ends: {} keeps it", limit_,
                  target_.name);
    }
    limit_ = most;
    block(out, fmt::format("{}{:g}", row_.speed_limit, most));
    return {};
  }
  void append_speed(std::string& words, const interpreter::Spindle& spindle) {
    const double value = spindle.surface_speed
                             ? spindle.surface_speed->mm() / mm_per_surface_unit(units_)
                             : spindle.revolutions_per_minute;
    if (value == 0 && !has_speed_) return;  // the operator chose it
    has_speed_ = true;
    append(words, "S");
    append_number(words, counts_of(value, target_.speed.decimals), target_.speed.decimals);
  }

  const Target& target_;
  const WordRow& row_;
  Units units_ = Units::Millimeter;
  std::optional<bool> is_per_revolution_;
  int motion_ = -1;
  Plane plane_ = Plane::XY;
  bool has_length_pending_ = false;
  int tool_ = 0;
  interpreter::CompensationSide side_ = interpreter::CompensationSide::Off;
  int radius_number_ = 0;
  bool is_surface_ = false, has_speed_ = false;
  double limit_ = 0;
  bool has_flood_ = false, has_mist_ = false;
};

}  // namespace

std::unique_ptr<ProgramWriter> make_word_writer(const Target& target) {
  const auto row = std::ranges::find(kRows, target.name, &WordRow::target);
  invariant(row != kRows.end(), "every target of words has a row of them");
  return std::make_unique<WordWriter>(target, *row);
}

}  // namespace dripline::post
