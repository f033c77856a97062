#include <fmt/format.h>
#include <bitset>
#include <cmath>

#include "clients/tools/post/program_writer.hpp"
#include "gateway/interpreter/core/geometry/plane_axes.hpp"

namespace dripline::post {
namespace {

using interpreter::Axis;
using interpreter::SpindleState;

constexpr NumberLook kSigned{.has_plus = true, .point = ','};
constexpr NumberLook kPlain{.point = ','};
constexpr int kAngleDecimals = 3;

/// Plain language of the HEIDENHAIN TNC 151/155. The tool axis is Z.
class PlainLanguageWriter final : public ProgramWriter {
 public:
  PlainLanguageWriter(const Target& target, const interpreter::Setup& setup) : target_(target) {
    for (const auto& tool : setup.tools) {
      if (tool.number >= 0 && static_cast<std::size_t>(tool.number) < known_tools_.size())
        known_tools_.set(static_cast<std::size_t>(tool.number));
    }
  }

  void head(std::string& out, const ProgramHead& head) override {
    units_ = head.units;
    name_ =
        fmt::format("{} {}", head.number, head.units == interpreter::Units::Inch ? "INCH" : "MM");
    block(out, "BEGIN PGM " + name_);
    block(out, "TOOL CALL Z");  // circles lie in XY, whether a tool is called or not
  }

  void rapid(std::string& out, const MoveWords& move) override {
    block(out, "L" + coordinates(move) + " R0 FMAX");
  }
  void line(std::string& out, const MoveWords& move) override {
    block(out, "L" + coordinates(move) + " R0" + feed(move));
  }

  bool arc(std::string& out, const ArcWords& arc) override {
    const auto axes = interpreter::axes_of(arc.plane);
    if (!has_center_ || center_ != arc.absolute_center) {
      std::string words = "CC ";
      words += letter(axes.first);
      append_number(words, arc.absolute_center[0], decimals(), kSigned);
      words += ' ';
      words += letter(axes.second);
      append_number(words, arc.absolute_center[1], decimals(), kSigned);
      block(out, words);
      center_ = arc.absolute_center;
      has_center_ = true;
    }
    const bool is_ccw = arc.turn == interpreter::Turn::Counterclockwise;
    const std::string_view direction = is_ccw ? " DR+" : " DR-";
    if (!arc.is_helix) {
      block(out, "C" + coordinates(arc) + std::string(direction) + " R0" + feed(arc));
      return true;
    }
    MoveWords depth = arc;
    depth.named.reset(static_cast<std::size_t>(axes.first));
    depth.named.reset(static_cast<std::size_t>(axes.second));
    std::string words = "CP IPA";
    append_number(words, counts_of(is_ccw ? arc.sweep : -arc.sweep, kAngleDecimals), kAngleDecimals,
                  kSigned);
    block(out, words + coordinates(depth) + std::string(direction) + " R0" + feed(arc));
    return false;
  }

  void dwell(std::string& out, std::int64_t counts) override {
    block(out, "CYCL DEF 9.0 DWELL TIME");
    std::string words = "CYCL DEF 9.1 DWELL ";
    append_number(words, counts, target_.dwell.decimals, kPlain);
    block(out, words);
  }

  Result<void> spindle(std::string& out, const interpreter::Spindle& spindle) override {
    if (spindle.state == SpindleState::Off) {
      machine_function(out, 5);
      state_ = spindle.state;
      return {};
    }
    const auto speed = counts_of(spindle.revolutions_per_minute, target_.speed.decimals);
    const bool is_new_speed = speed != speed_;
    if (is_new_speed && state_ != SpindleState::Off && state_ != spindle.state) {
      return fail(Errc::Unsupported,
                  "the running spindle gets another direction and another speed "
                  "at once: {} sets one after the other",
                  target_.name);
    }
    if (is_new_speed) {
      std::string words = "TOOL CALL S";
      append_number(words, speed, target_.speed.decimals, kPlain);
      block(out, words);
      speed_ = speed;
    }
    if (state_ != spindle.state)
      machine_function(out, spindle.state == SpindleState::Clockwise ? 3 : 4);
    state_ = spindle.state;
    return {};
  }

  Result<void> coolant(std::string& out, bool flood, bool /*mist*/) override {
    machine_function(out, flood ? 8 : 9);
    return {};
  }

  void tool(std::string& out, const interpreter::ToolChange& tool) override {
    const auto number = static_cast<std::size_t>(tool.number);
    if (number != 0 && number < known_tools_.size() && !known_tools_.test(number)) {
      block(out, fmt::format("TOOL DEF {} L+0 R+0", number));
      known_tools_.set(number);
    }
    block(out, fmt::format("TOOL CALL {} Z", number));
  }

  void machine_function(std::string& out, int code) override {
    block(out, fmt::format("L M{}", code));
  }
  void stop(std::string& out, interpreter::StopKind) override { block(out, "STOP"); }

  void end(std::string& out) override {
    block(out, "L M30");
    block(out, "END PGM " + name_);
  }

 private:
  int decimals() const { return range_of(target_.coordinate, units_).decimals; }

  void block(std::string& out, const std::string& words) {
    out += fmt::format("{} {}\r\n", blocks(), words);
    count_block();
  }
  std::string coordinates(const MoveWords& move) const {
    std::string words;
    for (const Axis axis : interpreter::kAllAxes) {
      const auto i = static_cast<std::size_t>(axis);
      if (!move.named.test(i)) continue;
      words += ' ';
      words += letter(axis);
      append_number(words, move.at[i], decimals(), kSigned);
    }
    return words;
  }
  std::string feed(const MoveWords& move) const {
    if (!move.feed) return {};
    std::string words = " F";
    // F of a program in inches is in tenths of an inch a minute.
    const int decimals =
        range_of(target_.feed, units_).decimals - (units_ == interpreter::Units::Inch ? 1 : 0);
    append_number(words, move.feed->counts, decimals, kPlain);
    return words;
  }

  const Target& target_;
  interpreter::Units units_ = interpreter::Units::Millimeter;
  std::string name_;
  std::bitset<255> known_tools_;
  std::array<std::int64_t, 2> center_{};
  bool has_center_ = false;
  SpindleState state_ = SpindleState::Off;
  std::int64_t speed_ = 0;
};

}  // namespace

std::unique_ptr<ProgramWriter> make_plain_language_writer(const Target& target,
                                                          const interpreter::Setup& setup) {
  return std::make_unique<PlainLanguageWriter>(target, setup);
}

}  // namespace dripline::post
