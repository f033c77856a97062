#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dripline::test_support {

/// A board of the Grbl 1.1 class in virtual time: receive buffer, line parser, planner, real-time
/// commands, status reports, alarms, a probe. Bytes go in, bytes come out, time passes by `pass`.
/// Its axes move with constant speed, without ramps. Like the firmware, it takes blocks out of the
/// planner up to 100 ms before the axes have done them.
///
/// It keeps the truth that a test compares with: what the axes did, line by line.
class GrblBoard {
 public:
  using Point = std::array<double, 4>;  ///< X Y Z A
  struct Options {
    std::size_t rx_bytes = 128;
    int planner_blocks = 15;
    bool has_line_numbers = true, reports_buffers = true, reports_work_position = false;
    bool is_grbl_hal = false;
    bool is_locked = false;  ///< homing is required
    bool has_mist = true;
    bool is_zero_at_low_end = false;  ///< the build sets the zero where it homes
    std::size_t axes = 3;
    double steps = 1000, max_rate = 12'000;  ///< per mm; mm/min
    Point start{};
    std::optional<double> surface_z = {};  ///< where the probe meets the part
    double brake_seconds = 0.03;
    double homing_seconds = 8;                 ///< without a report
    double restore_seconds = 4;                ///< after the door: the spindle comes up again
    std::map<int, std::string> settings = {};  ///< replace or add: {32, "1"}; {13, "none"}
  };
  GrblBoard() : GrblBoard(Options{}) {}
  explicit GrblBoard(Options options);

  void receive(std::string_view bytes);
  void pass(double seconds);
  std::string take_output() { return std::exchange(output_, {}); }

  // -- the truth ----------------------------------------------------------------------------------
  struct Done {
    std::uint32_t number = 0;  ///< N
    Point at{};
  };
  std::vector<Done> done;          ///< ends of moves, when the axes have reached them
  std::vector<std::string> lines;  ///< as parsed, without N
  std::string real_time;           ///< real-time bytes other than `?`
  std::vector<std::string> jogs;   ///< lines of jogs that were taken
  bool has_overrun = false;        ///< a character arrived with the receive buffer full
  Point position() const { return at_; }
  double traveled() const { return traveled_; }
  bool is_moving() const {
    return state_ == State::Run || state_ == State::Jog || (is_braking_ && !moves_.empty());
  }
  bool is_spindle_on() const { return spindle_ > 0; }
  int feed_override() const { return feed_override_; }
  int rapid_override() const { return rapid_override_; }
  int spindle_override() const { return spindle_override_; }
  std::size_t longest_line() const { return longest_line_; }
  std::size_t received() const { return received_; }  ///< bytes

  // -- faults -------------------------------------------------------------------------------------
  void say(std::string_view line) { output_ += std::string(line) + "\r\n"; }
  void restart();  ///< power gone and back
  void raise_alarm(int code);
  void press_hold() { on_real_time('!'); }
  void open_door();
  void close_door() { is_door_open_ = false; }
  void enter_check_mode() { state_ = State::Check; }
  bool ignores_reset = false;
  bool ignores_jog_cancel = false;
  bool ignores_overrides = false;
  bool is_mute = false;          ///< answers nothing
  bool is_stuck = false;         ///< reports Run, the axes stand
  bool swallows_lines = false;   ///< lines are lost in transit
  int leaked_blocks = 0;         ///< of the planner, reported as in use
  double drifts = 0;             ///< mm that X is beside what it was sent to
  int refuses_line = 0;          ///< the n-th line from now is answered by error 20
  int names_lines_ahead = 0;     ///< reports a line that has not come to its turn
  bool forgets_axes = false;     ///< reports and contacts have X alone
  double contact_is_off = 0;     ///< mm in X, of what is reported
  bool is_probe_closed = false;  ///< before the probe move
  Point g54{};                   ///< set by another than the gateway

 private:
  enum class State { Idle, Run, Hold, Alarm, Door, Check, Jog };
  struct Move {
    std::uint32_t number = 0;
    Point to{};
    double length = 0, rate = 0;  ///< mm, mm/min
    bool is_rapid = false, ends_line = false, is_probe = false, is_jog = false;
    double left = 0;
  };
  struct Words;

  void on_real_time(char byte);
  void take_override_bytes();
  void soft_reset();
  int jog(const std::string& line);
  void cancel_jog();
  void begin_door();
  void greet();
  void step(double seconds);
  void take_lines();
  bool take_line(const std::string& line);
  int execute(const Words& words);
  int system_command(const std::string& line);
  void move_axes(double seconds);
  void finish_move();
  void end_probe(bool tripped);
  void report();
  std::size_t first_in_planner() const;
  std::size_t planned() const { return moves_.size() - first_in_planner(); }
  std::string words_of(const Point& point) const;
  bool reports_inches() const { return settings_.contains(13) && settings_.at(13) == "1"; }
  void add_line(const Point& to, double rate, bool is_rapid, std::uint32_t number);
  int add_arc(const Words& words, const Point& to, bool is_clockwise);
  Point target_of(const Words& words) const;

  Options options_;
  State state_ = State::Idle;
  std::string rx_, output_;
  std::deque<Move> moves_;    ///< what the axes do, then the planner
  std::deque<Move> waiting_;  ///< moves of the present line that the planner has no room for
  std::optional<std::string> pending_answer_;  ///< of the present line, when it is taken
  double dwell_ = 0, homing_ = 0, restore_left_ = 0;
  bool waits_for_rest_ = false;  ///< the present line needs an empty planner
  Point at_{}, end_{}, from_{};
  double traveled_ = 0;
  int motion_ = 0, plane_ = 17, reports_ = 0;
  bool is_metric_ = true, is_absolute_ = true, is_timed_ = false;
  std::string work_ = "G54";
  double feed_ = 0, spindle_ = 0;
  bool is_braking_ = false, is_door_open_ = false, is_probing_ = false;
  double brake_left_ = 0;
  std::set<int> override_bytes_;  ///< that came since it has looked
  int feed_override_ = 100, rapid_override_ = 100, spindle_override_ = 100;
  std::uint32_t parsed_number_ = 0;
  std::size_t longest_line_ = 0, received_ = 0;
  std::map<int, std::string> settings_;
};

}  // namespace dripline::test_support
