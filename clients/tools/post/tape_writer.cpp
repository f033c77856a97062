#include <fmt/format.h>

#include "clients/tools/post/program_writer.hpp"
#include "gateway/interpreter/core/geometry/plane_axes.hpp"

namespace dripline::post {
namespace {

using interpreter::Axis;
using interpreter::SpindleState;

/// Tapes of the Tektronix 1704. Every move rests at its end (G00, G20, G30): its path is then the
/// programmed one, whatever direction follows.
class TapeWriter final : public ProgramWriter {
 public:
  explicit TapeWriter(const Target& target) : target_(target) {}

  void head(std::string& out, const ProgramHead&) override {
    block(out, "%");
    block(out, "G90");
  }
  void rapid(std::string& out, const MoveWords& move) override { straight(out, "G50", move); }
  void line(std::string& out, const MoveWords& move) override { straight(out, "G00", move); }

  bool arc(std::string& out, const ArcWords& arc) override {
    const auto axes = interpreter::axes_of(arc.plane);
    std::string words = arc.turn == interpreter::Turn::Clockwise ? "G20" : "G30";
    words += coordinates(arc);
    words += fmt::format("{}{}{}{}", center_letter(axes.first), arc.absolute_center[0],
                         center_letter(axes.second), arc.absolute_center[1]);
    block(out, words + feed(arc));
    return true;
  }

  void dwell(std::string& out, std::int64_t counts) override {
    block(out, fmt::format("G04F{}", counts));
    has_lost_feed_ = true;
  }

  Result<void> spindle(std::string& out, const interpreter::Spindle& spindle) override {
    block(out, spindle.state == SpindleState::Off         ? "M05"
               : spindle.state == SpindleState::Clockwise ? "M03"
                                                          : "M04");
    return {};
  }
  Result<void> coolant(std::string& out, bool flood, bool mist) override {
    if (flood && mist && !has_flood_ && !has_mist_)
      return fail(Errc::Unsupported, "flood and mist coolant are switched on at once");
    if ((has_flood_ && !flood && mist) || (has_mist_ && !mist && flood))
      return fail(Errc::Unsupported, "one of two coolants is switched off: {} switches off both",
                  target_.name);
    block(out, flood && !has_flood_ ? "M08" : mist && !has_mist_ ? "M07" : "M09");
    has_flood_ = flood;
    has_mist_ = mist;
    return {};
  }
  void tool(std::string&, const interpreter::ToolChange&) override {}  // max_tool is 0
  void machine_function(std::string& out, int code) override {
    block(out, fmt::format("M{:02}", code));
  }
  void stop(std::string& out, interpreter::StopKind kind) override {
    block(out, kind == interpreter::StopKind::Optional ? "M01" : "M00");
  }
  void end(std::string& out) override { block(out, "M30"); }
  bool has_lost_feed() const override { return has_lost_feed_; }

 private:
  static char center_letter(Axis axis) { return "IJK"[static_cast<std::size_t>(axis)]; }
  void block(std::string& out, std::string_view words) {
    out += words;
    out += '\n';
    count_block();
    has_lost_feed_ = false;
  }
  static std::string coordinates(const MoveWords& move) {
    std::string words;
    for (const Axis axis : {Axis::X, Axis::Y, Axis::Z}) {
      const auto i = static_cast<std::size_t>(axis);
      if (move.named.test(i)) words += fmt::format("{}{}", letter(axis), move.at[i]);
    }
    return words;
  }
  static std::string feed(const MoveWords& move) {
    return move.feed ? fmt::format("F{}", move.feed->counts) : std::string();
  }
  void straight(std::string& out, std::string_view code, const MoveWords& move) {
    block(out, std::string(code) + coordinates(move) + feed(move));
  }

  const Target& target_;
  bool has_flood_ = false, has_mist_ = false, has_lost_feed_ = false;
};

}  // namespace

std::unique_ptr<ProgramWriter> make_tape_writer(const Target& target) {
  return std::make_unique<TapeWriter>(target);
}

std::unique_ptr<ProgramWriter> make_writer(const Target& target, const interpreter::Setup& setup) {
  switch (target.form) {
    case Form::Words:
      return make_word_writer(target);
    case Form::PlainLanguage:
      return make_plain_language_writer(target, setup);
    case Form::Events:
      return make_event_writer(target);
    case Form::Tape:
      break;
  }
  return make_tape_writer(target);
}

}  // namespace dripline::post
