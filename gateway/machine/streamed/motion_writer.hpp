#pragma once

#include <vector>

#include "gateway/interpreter/core/shown_length.hpp"
#include "gateway/machine/streamed/text_rules.hpp"

namespace dripline::machine::streamed {

struct ArcPath;

/// An axis that would leave its travel between two points of the machine; nothing: none does, or no
/// travel is known.
std::optional<Refusal> check_travel(const TextRules& rules, const Coordinates& from,
                                    const Coordinates& to,
                                    const interpreter::LengthDisplay& display);

/// A piece of motion as the device gets it.
struct MotionText {
  std::vector<std::string> lines;  ///< G-code without line ends
  double seconds = 0;              ///< at 100 % override, without acceleration
  double length = 0;               ///< of the path, all axes
  Coordinates end{};               ///< where it ends
};

/// Makes G-code lines of a program's motion: machine coordinates in millimeters, absolute, feed per
/// minute, arcs by their center as increments (G21 G90 G94 G91.1, and G8 on a lathe). Pure.
///
/// Every line moves the axes by at least one step, or there is none: a device plans nothing for a
/// line without motion, and what it has executed could not be observed.
class MotionWriter {
 public:
  explicit MotionWriter(const TextRules& rules) : rules_(rules) {}

  const TextRules& rules() const { return rules_; }
  /// The axes are at `at`; no feed is in force.
  void begin(const Coordinates& at);
  /// How refusals show lengths: as the program's control does.
  void show_as(const interpreter::LengthDisplay& display) { display_ = display; }
  const interpreter::LengthDisplay& display() const { return display_; }
  /// A probe has moved the axes there.
  void move_to(const Coordinates& at) { at_ = at; }
  const Coordinates& at() const { return at_; }

  std::optional<Refusal> rapid(const interpreter::Rapid& event, MotionText& text);
  std::optional<Refusal> line(const interpreter::Line& event, MotionText& text);
  std::optional<Refusal> arc(const interpreter::Arc& event, MotionText& text);
  /// The line of a probe move, which is an error neither without nor with a contact.
  std::optional<Refusal> probe(const interpreter::Probe& event, MotionText& text);

  /// The lines of a dwell; none if it has no length.
  std::optional<Refusal> dwell(double seconds, std::vector<std::string>& lines) const;

 private:
  static std::string dwell(double seconds);
  struct PathLength {
    double program = 0;  ///< that a program's feed is for
    double device = 0;   ///< that the device's is for
  };
  struct Motion {
    std::string_view code;
    std::optional<double> feed;
    bool rests = false;
  };
  std::optional<Refusal> target_of(const interpreter::Position& to, Coordinates& target) const;
  bool nears_limit(const ArcPath& path, const std::vector<Coordinates>& extremes) const;
  std::optional<Refusal> straight(const Motion& motion, const Coordinates& to, MotionText& text);
  std::optional<Refusal> straight_line(const Motion& motion, const Coordinates& to,
                                       MotionText& text);
  double pieces_of(double seconds) const;
  PathLength straight_length(const Coordinates& to) const;
  std::optional<Refusal> feed_of(Feed feed, PathLength length, double& per_minute) const;
  std::string feed_words(const Motion& motion, const Coordinates& to);
  std::optional<Refusal> append(std::string line, MotionText& text) const;
  std::string axis_words(const Coordinates& to) const;
  std::string number(double value) const;
  std::int64_t step(std::size_t axis, double value) const;
  bool is_same_step(const Coordinates& a, const Coordinates& b) const;
  std::optional<Refusal> arc_line(const interpreter::Arc& event, const Coordinates& end,
                                  double feed, MotionText& text);
  double seconds_of(const Coordinates& to, std::optional<double> feed) const;
  double least_seconds(const ArcPath& path) const;
  std::string stop_mode(bool rests);
  void append_rest(bool rests, MotionText& text) const;

  TextRules rules_;
  interpreter::LengthDisplay display_;
  Coordinates at_{};
  std::string feed_;           ///< as written last
  bool is_timed_ = false;      ///< G93 is in force
  std::optional<bool> rests_;  ///< the stop mode that was written last
};

}  // namespace dripline::machine::streamed
