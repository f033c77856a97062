#include "tests/differential/rs274ngc/peer.hpp"

#include <fmt/core.h>
#include <sys/wait.h>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <memory>
#include <string_view>

namespace dripline::differential {
namespace fs = std::filesystem;

namespace {

constexpr const char* kPeer = "/usr/bin/rs274";
/// Seconds; some contours of lathe cycles keep it busy for ever.
constexpr int kTimeLimit = 20;
constexpr int kTimedOut = 124;       ///< exit status of `timeout`
constexpr int kEndedBySignal = 128;  ///< exit statuses above: by this signal
constexpr std::size_t kMaxMoves = 200'000;
constexpr double kInch = 25.4;

/// Numbers of a call's arguments, in order.
std::vector<double> arguments(std::string_view text) {
  std::vector<double> values;
  std::size_t at = text.find('(');
  while (at != std::string_view::npos && at + 1 < text.size()) {
    ++at;
    while (at < text.size() && text[at] == ' ') ++at;
    double value = 0;
    std::from_chars(text.data() + at, text.data() + text.size(), value);
    values.push_back(value);
    at = text.find_first_of(", ", at + 1);
  }
  return values;
}

/// The call's name; a sequence number of six digits touches it.
std::string_view name_before(std::string_view line, std::size_t open) {
  std::string_view name = line.substr(0, open);
  name.remove_prefix(name.rfind(' ') + 1);
  const std::size_t letters = name.find_first_not_of("0123456789", 1);
  const bool is_numbered = name.size() > 1 && name[0] == 'N' && letters > 1;
  if (is_numbered && letters != std::string_view::npos) name.remove_prefix(letters);
  return name;
}

/// Follows the calls that the peer prints.
class CallReader {
 public:
  void read(std::string_view line) {
    const std::size_t open = line.find('(');
    if (open == std::string_view::npos) return;
    const std::string_view name = name_before(line, open);
    const std::vector<double> values = arguments(line.substr(open));
    if (name == "USE_LENGTH_UNITS") {
      mm_ = line.find("INCHES") != std::string_view::npos ? kInch
            : line.find("_CM") != std::string_view::npos  ? 10
                                                          : 1;
    } else if (name == "SELECT_PLANE") {
      plane_ = line.find("_XZ") != std::string_view::npos   ? 1
               : line.find("_YZ") != std::string_view::npos ? 2
                                                            : 0;
    } else if (name == "SET_G5X_OFFSET") {
      take(values, 1, g5x_);
    } else if (name == "SET_G92_OFFSET") {
      take(values, 0, g92_);
    } else if (name == "SET_XY_ROTATION") {
      rotation_ = values.at(0);
    } else if (name == "STRAIGHT_TRAVERSE" || name == "STRAIGHT_FEED") {
      straight(name == "STRAIGHT_TRAVERSE" ? Move::Kind::Rapid : Move::Kind::Feed, values);
    } else if (name == "RIGID_TAP") {
      tap(values);
    } else if (name == "USE_TOOL_LENGTH_OFFSET") {
      change_length(values);
    } else if (name == "ARC_FEED") {
      arc(values);
    }
  }
  std::vector<Move> moves;

 private:
  using Point = std::array<double, 6>;

  void take(const std::vector<double>& values, std::size_t first, Point& point) const {
    for (std::size_t i = 0; i < 6 && first + i < values.size(); ++i) {
      point[i] = values[first + i] * (i < 3 ? mm_ : 1);
    }
  }
  Point machine(Point point) const {
    for (std::size_t i = 0; i < 6; ++i) point[i] += g92_[i];
    const double radians = rotation_ * (3.14159265358979323846 / 180);
    const double x = point[0] * std::cos(radians) - point[1] * std::sin(radians);
    point[1] = point[0] * std::sin(radians) + point[1] * std::cos(radians);
    point[0] = x;
    for (std::size_t i = 0; i < 6; ++i) point[i] += g5x_[i];
    return point;
  }
  void straight(Move::Kind kind, const std::vector<double>& values) {
    Move move;
    move.kind = kind;
    take(values, 0, at_);
    move.to = machine(at_);
    // G53 to where the axes are after a change of length: nothing moves.
    const bool is_standstill = is_length_changed_ && is_near(move.to, tip_, 1e-7);
    if (!is_standstill) moves.push_back(move);
    arrive(move.to);
  }
  void arrive(const Point& to) {
    tip_ = to;
    is_length_changed_ = false;
  }
  void change_length(const std::vector<double>& values) {
    const Point before = length_;
    take(values, 0, length_);
    for (std::size_t i = 0; i < 6; ++i) tip_[i] += before[i] - length_[i];
    is_length_changed_ = true;
  }
  /// G33.1: in, and out again to where it began.
  void tap(const std::vector<double>& values) {
    Move in, out;
    in.kind = out.kind = Move::Kind::Feed;
    out.to = machine(at_);
    Point bottom = at_;
    take({values.begin(), values.begin() + 3}, 0, bottom);
    in.to = machine(bottom);
    moves.push_back(in);
    moves.push_back(out);
  }
  /// first end, second end, first center, second center, circles, end along the third, A, B, C
  void arc(const std::vector<double>& values) {
    constexpr std::array<std::array<std::size_t, 3>, 3> kAxes{{{0, 1, 2}, {2, 0, 1}, {1, 2, 0}}};
    const auto [first, second, third] = kAxes[static_cast<std::size_t>(plane_)];
    Move move;
    move.kind = Move::Kind::Arc;
    move.plane = plane_;
    at_[first] = values.at(0) * mm_;
    at_[second] = values.at(1) * mm_;
    at_[third] = values.at(5) * mm_;
    for (std::size_t i = 3; i < 6; ++i) at_[i] = values.at(i + 3);
    Point center = at_;
    center[first] = values.at(2) * mm_;
    center[second] = values.at(3) * mm_;
    const Point turned = machine(center);
    move.center = {turned[first], turned[second]};
    move.circles = static_cast<int>(values.at(4));
    move.to = machine(at_);
    moves.push_back(move);
    arrive(move.to);
  }

  double mm_ = 1;
  int plane_ = 0;
  double rotation_ = 0;
  Point g5x_{}, g92_{}, at_{}, tip_{}, length_{};
  bool is_length_changed_ = false;
};

}  // namespace

bool has_peer() {
  return fs::exists(kPeer);
}

std::string tool_table() {
  return "T1 P1 Z1.5 D0.25 ;\nT2 P2 Z2.25 D0.125 ;\nT3 P3 Z0.5 D0.5 ;\nT4 P4 Z3 D0.0625 ;\n"
         "T5 P5 Z1 D0 ;\n";
}

/// It keeps its tools in a file in HOME: each folder has its own.
Behavior run_peer(const fs::path& program, const fs::path& tools) {
  const std::string folder = program.parent_path().string();
  const std::string command = fmt::format(
      "cd '{0}' && HOME='{0}' LD_PRELOAD='{1}' timeout {5} '{2}' -g -t '{3}' '{4}' 2>complaint",
      folder, FULL_PRECISION, kPeer, tools.string(), program.string(), kTimeLimit);
  Behavior behavior;
  CallReader calls;
  FILE* output = popen(command.c_str(), "r");
  if (output == nullptr) return behavior;
  std::array<char, 1024> line{};
  while (fgets(line.data(), line.size(), output) != nullptr) {
    std::string_view text(line.data());
    while (!text.empty() && text.back() == '\n') text.remove_suffix(1);
    if (calls.moves.size() < kMaxMoves) calls.read(text);
  }
  const int status = pclose(output);
  behavior.is_accepted = WIFEXITED(status) && WEXITSTATUS(status) == 0;
  // A shell reports a signal that ended its command as 128 and more.
  behavior.is_hung = !WIFEXITED(status) || WEXITSTATUS(status) == kTimedOut ||
                     WEXITSTATUS(status) > kEndedBySignal;
  behavior.moves = std::move(calls.moves);
  std::ifstream complaint(program.parent_path() / "complaint");
  while (std::getline(complaint, behavior.complaint) && behavior.complaint == "executing") {
  }
  drop_standing_moves(behavior);
  return behavior;
}

}  // namespace dripline::differential
