#pragma once

#include <array>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace dripline::differential {

/// Ten-thousandths of a unit: what a program says exactly.
using Ticks = std::int64_t;

std::string text_of(Ticks ticks);

/// How the contour of a lathe cycle lies: `along` grows with the cut, `depth` out of the work.
struct Lie {
  bool is_facing = false;
  Ticks along_sign = 1;
  Ticks depth_sign = 1;

  Ticks z(Ticks along, Ticks depth) const {
    return is_facing ? depth_sign * depth : along_sign * along;
  }
  Ticks x(Ticks along, Ticks depth) const {
    return is_facing ? along_sign * along : depth_sign * depth;
  }
  /// A valley is counterclockwise in the frame of the cut.
  const char* arc(bool is_valley) const {
    const bool is_mirrored = (along_sign * depth_sign < 0) != is_facing;
    return is_valley != is_mirrored ? "G3" : "G2";
  }
};

/// One program in the making. The same number draws the same choices, in the order of the calls.
class Maker {
 public:
  explicit Maker(std::uint64_t number) : random_(number * 7919 + 13) {}

  std::string make();

 private:
  // Small choices.
  std::uint64_t below(std::uint64_t limit) { return random_() % limit; }
  Ticks between(Ticks low, Ticks high) {
    return low + static_cast<Ticks>(below(static_cast<std::uint64_t>(high - low + 1)));
  }
  template <std::size_t kSize>
  const char* one_of(const std::array<const char*, kSize>& words) {
    return words[below(kSize)];
  }

  void line(const std::string& words);
  /// The value, written plainly or as something that computes it.
  std::string value(Ticks ticks);
  /// Settings that values asked for come before the line that uses them.
  void line_with_values(const std::string& words);
  void known_position();
  void part();

  // Moves: moving_parts.cpp
  void lines(std::uint64_t count);
  void arcs(std::uint64_t count);
  void radius_arc();
  void other_plane();
  void offsets();
  void lengths();
  void tool_rows();
  void splines();
  void nurbs();
  void compensation();
  /// Of an H or D word; 0 once there is a tool, for the peer begins with one of its own making.
  std::uint64_t tool_or_spindle();
  /// Words of rotary axes, now and then.
  std::string rotary();
  void cycles();
  void polar_cycles();

  // Lathe cycles: turning_parts.cpp
  void turning();
  std::vector<std::string> contour(Ticks along, Ticks depth);
  std::string contour_arc(Ticks run, Ticks rise, Ticks& along, Ticks& depth);

  // O words and expressions: language_parts.cpp
  std::string label();
  void loop();
  void body(std::uint64_t counter, const std::string& loop_label);
  void conditions();
  void subprogram();
  std::string sub_label();
  std::string sub_text(const std::string& o);
  void call_some(const std::string& o);
  void later_subprogram();
  void fanuc_subprogram();
  std::string term(int depth);
  void expressions();

  void small_things();
  void saved_modes();
  /// What shows the state, as places to go to.
  void shown_state();
  /// One thing that is wrong, or looks so.
  void mistake();

  std::mt19937_64 random_;
  std::string text_;
  std::string later_;  ///< after the end of the main program
  std::string settings_;
  Ticks x_ = 0, y_ = 0, z_ = 0;
  Lie turning_;
  int label_ = 100;
  bool has_break_ = false;
};

}  // namespace dripline::differential
