#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gateway/machine/grbl/board_info.hpp"

namespace dripline::machine::grbl {

/// Why an event cannot become lines: an alarm in its place.
struct Refusal {
  std::string_view id;  ///< static storage
  std::string text;
};

/// A piece of motion as the board gets it.
struct MotionText {
  std::vector<std::string> lines;  ///< G-code without N words and line ends
  double seconds = 0;              ///< at 100 % override, without acceleration
  Coordinates end{};               ///< where it ends
};

/// Makes G-code lines of a program's events: machine coordinates in millimetres, absolute, feed per
/// minute, arcs by their center as increments (the modes of `preamble`). Pure.
///
/// Every line moves the axes by at least one step, or there is none: a board plans nothing for a
/// line without motion, and what it has executed could not be counted.
class LineWriter {
 public:
  explicit LineWriter(BoardInfo board) : board_(std::move(board)) {}

  const BoardInfo& board() const { return board_; }
  /// The axes are at `at`; no feed is in force.
  void begin(const Coordinates& at);
  /// A probe has moved the axes there.
  void move_to(const Coordinates& at) { at_ = at; }
  const Coordinates& at() const { return at_; }

  std::optional<Refusal> rapid(const interpreter::Rapid& event, MotionText& text);
  std::optional<Refusal> line(const interpreter::Line& event, MotionText& text);
  std::optional<Refusal> arc(const interpreter::Arc& event, MotionText& text);
  /// The line of a probe move, which is an error neither without nor with a contact.
  std::optional<Refusal> probe(const interpreter::Probe& event, MotionText& text);

  // Those below are not motion.
  std::optional<Refusal> spindle(const interpreter::Spindle& event, std::string& line) const;
  std::optional<Refusal> coolant(const interpreter::Coolant& event,
                                 std::vector<std::string>& lines);
  static std::string dwell(double seconds);

  /// The modes that all lines rely on, two lines.
  std::vector<std::string> preamble() const;
  /// The words of the preamble that `$G` must name.
  std::vector<std::string> preamble_words() const;

  /// Bytes that the sender adds at most: "N99999" and the line's end.
  static constexpr std::size_t kAdded = 7;

 private:
  std::optional<Refusal> target_of(const interpreter::Position& to, Coordinates& target) const;
  std::optional<Refusal> check_travel(const Coordinates& target) const;
  std::optional<Refusal> straight(std::string_view code, const Coordinates& to,
                                  std::optional<double> feed, MotionText& text);
  std::optional<Refusal> feed_of(Feed feed, double program_length, double board_length,
                                 double& per_minute) const;
  std::optional<Refusal> append(std::string line, MotionText& text) const;
  std::string axis_words(const Coordinates& to) const;
  std::string number(double value) const;
  std::int64_t step(std::size_t axis, double value) const;
  bool is_same_step(const Coordinates& a, const Coordinates& b) const;
  std::optional<Refusal> arc_line(const interpreter::Arc& event, const Coordinates& end,
                                  double feed, MotionText& text);
  double seconds_of(const Coordinates& from, const Coordinates& to,
                    std::optional<double> feed) const;

  BoardInfo board_;
  Coordinates at_{};
  std::string feed_;  ///< as written last
  bool flood_ = false, mist_ = false;
};

}  // namespace dripline::machine::grbl
