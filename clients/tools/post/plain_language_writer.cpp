#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "clients/tools/post/program_writer.hpp"
#include "gateway/interpreter/core/geometry/plane_axes.hpp"
#include "protocol/base/invariant.hpp"

namespace dripline::post {
namespace {

using interpreter::Axis;
using interpreter::SpindleState;

/// What differs between the controls of this language.
struct PlainRow {
  std::string_view target = {};
  char point = '.';
  int angle_decimals = 4;
  bool begins_with_axis = false;  ///< the head names the tool axis, else the first arc without tool
};

constexpr std::array kPlainRows{
    PlainRow{.target = "itnc"},
    PlainRow{.target = "tnc155", .point = ',', .angle_decimals = 3, .begins_with_axis = true},
};

/// By the tools' numbers: the names that are those of one tool.
std::map<int, std::string> tool_names(const interpreter::Setup& setup) {
  std::map<int, std::string> names;
  for (const auto& tool : setup.tools) {
    const auto has_name = [&](const auto& other) { return other.name == tool.name; };
    const bool is_plain = std::ranges::all_of(
        tool.name, [](char c) { return c >= ' ' && c <= '~' && c != '"' && c != '~'; });
    if (!tool.name.empty() && is_plain && std::ranges::count_if(setup.tools, has_name) == 1)
      names[tool.number] = tool.name;
  }
  return names;
}

/// Plain language of HEIDENHAIN controls. The tool axis is Z.
class PlainLanguageWriter final : public ProgramWriter {
 public:
  PlainLanguageWriter(const Target& target, const PlainRow& row, const interpreter::Setup& setup)
      : target_(target),
        row_(row),
        signed_{.has_plus = true, .point = row.point},
        plain_{.point = row.point} {
    if (target.defines_tools) {
      for (const auto& tool : setup.tools) known_tools_.insert(tool.number);
    } else {
      names_ = tool_names(setup);
    }
  }

  void head(std::string& out, const ProgramHead& head) override {
    units_ = head.units;
    radii_ = head.radii;
    name_ =
        fmt::format("{} {}", head.number, head.units == interpreter::Units::Inch ? "INCH" : "MM");
    block(out, "BEGIN PGM " + name_);
    // Circles lie in XY, whether a tool is called or not.
    if (row_.begins_with_axis) name_axis(out);
  }

  void rapid(std::string& out, const MoveWords& move) override {
    block(out, "L" + coordinates(move) + side(move) + " FMAX");
  }
  void line(std::string& out, const MoveWords& move) override {
    block(out, "L" + coordinates(move) + side(move) + feed(move));
  }

  bool arc(std::string& out, const ArcWords& arc) override {
    const auto axes = interpreter::axes_of(arc.plane);
    if (!has_axis_) name_axis(out);
    if (!has_center_ || center_ != arc.absolute_center || center_plane_ != arc.plane) {
      std::string words = "CC ";
      words += letter(axes.first);
      append_number(words, arc.absolute_center[0], decimals(), signed_);
      words += ' ';
      words += letter(axes.second);
      append_number(words, arc.absolute_center[1], decimals(), signed_);
      block(out, words);
      center_ = arc.absolute_center;
      center_plane_ = arc.plane;
      has_center_ = true;
    }
    const bool is_ccw = arc.turn == interpreter::Turn::Counterclockwise;
    const std::string_view direction = is_ccw ? " DR+" : " DR-";
    if (!arc.is_helix) {
      block(out, "C" + coordinates(arc) + std::string(direction) + side(arc) + feed(arc));
      return true;
    }
    MoveWords depth = arc;
    depth.named.reset(static_cast<std::size_t>(axes.first));
    depth.named.reset(static_cast<std::size_t>(axes.second));
    std::string words = "CP IPA";
    append_number(words, counts_of(is_ccw ? arc.sweep : -arc.sweep, row_.angle_decimals),
                  row_.angle_decimals, signed_);
    block(out, words + coordinates(depth) + std::string(direction) + side(arc) + feed(arc));
    return false;
  }

  void dwell(std::string& out, std::int64_t counts) override {
    block(out, "CYCL DEF 9.0 DWELL TIME");
    std::string words = "CYCL DEF 9.1 DWELL ";
    append_number(words, counts, target_.dwell.decimals, plain_);
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
      append_number(words, speed, target_.speed.decimals, plain_);
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
    const bool is_new = target_.defines_tools && tool.number != 0;
    if (is_new && known_tools_.insert(tool.number).second)
      block(out, fmt::format("TOOL DEF {} L+0 R{}", tool.number, radius_text(tool.number)));
    const auto name = names_.find(tool.number);
    block(out, name == names_.end() ? fmt::format("TOOL CALL {} Z", tool.number)
                                    : fmt::format("TOOL CALL \"{}\" Z", name->second));
    has_axis_ = true;
  }

  void machine_function(std::string& out, int code) override {
    block(out, fmt::format("L M{}", code));
  }
  void stop(std::string& out, interpreter::StopKind) override { block(out, "STOP"); }

  /// A line of its own, which is no block. A `~` at its end would take the next line in.
  void comment(std::string& out, std::string_view text) override {
    std::string line(text);
    std::ranges::replace(line, '~', '-');
    out += fmt::format("; {}\r\n", line);
  }

  void end(std::string& out) override {
    block(out, "L M30");
    block(out, "END PGM " + name_);
  }

 private:
  int decimals() const { return range_of(target_.coordinate, units_).decimals; }

  void name_axis(std::string& out) {
    block(out, "TOOL CALL Z");
    has_axis_ = true;
  }
  void block(std::string& out, const std::string& words) {
    out += fmt::format("{} {}\r\n", blocks(), words);
    count_block();
  }
  static std::string side(const MoveWords& move) {
    constexpr std::array kSides{" R0", " RL", " RR"};
    return kSides[static_cast<std::size_t>(move.compensation.side)];
  }
  std::string coordinates(const MoveWords& move) const {
    std::string words;
    for (const Axis axis : interpreter::kAllAxes) {
      const auto i = static_cast<std::size_t>(axis);
      if (!move.named.test(i)) continue;
      words += ' ';
      words += letter(axis);
      append_number(words, move.at[i], decimals(), signed_);
    }
    return words;
  }
  std::string radius_text(int tool) const {
    const auto radius = radii_.find(tool);
    const double mm = radius == radii_.end() ? 0 : radius->second;
    std::string text;
    append_number(text, counts_of(mm / mm_per_unit(units_), decimals()), decimals(), signed_);
    return text;
  }
  std::string feed(const MoveWords& move) const {
    if (!move.feed) return {};
    std::string words = " F";
    // F of a program in inches is in tenths of an inch a minute.
    const int decimals =
        range_of(target_.feed, units_).decimals - (units_ == interpreter::Units::Inch ? 1 : 0);
    append_number(words, move.feed->counts, decimals, plain_);
    return words;
  }

  const Target& target_;
  const PlainRow& row_;
  NumberLook signed_, plain_;
  interpreter::Units units_ = interpreter::Units::Millimeter;
  std::string name_;
  std::map<int, double> radii_;       ///< mm
  std::set<int> known_tools_;         ///< defined, in the setup or above
  std::map<int, std::string> names_;  ///< of the setup's tools
  std::array<std::int64_t, 2> center_{};
  interpreter::Plane center_plane_ = interpreter::Plane::XY;
  bool has_center_ = false, has_axis_ = false;
  SpindleState state_ = SpindleState::Off;
  std::int64_t speed_ = 0;
};

}  // namespace

std::unique_ptr<ProgramWriter> make_plain_language_writer(const Target& target,
                                                          const interpreter::Setup& setup) {
  const auto row = std::ranges::find(kPlainRows, target.name, &PlainRow::target);
  invariant(row != kPlainRows.end(), "every target of plain language has a row of it");
  return std::make_unique<PlainLanguageWriter>(target, *row, setup);
}

}  // namespace dripline::post
