#include <fmt/format.h>
#include <algorithm>

#include "clients/tools/post/program_writer.hpp"

namespace dripline::post {
namespace {

using interpreter::Axis;

constexpr NumberLook kEventLook{.has_point = true};

/// Events of a ProtoTRAK Plus, as that control lists them. A cut is written when it is known
/// whether the next one is connected to it.
class EventWriter final : public ProgramWriter {
 public:
  explicit EventWriter(const Target& target) : target_(target) {}

  void head(std::string& out, const ProgramHead& head) override {
    units_ = head.units;
    const bool is_inch = head.units == interpreter::Units::Inch;
    out += fmt::format("PN{} G{} ;\r\n", head.number, is_inch ? 20 : 21);
  }

  void rapid(std::string& out, const MoveWords& move) override {
    end_chain(out);
    std::string words = event(100);
    append_point(words, "X", "Y", move.at);
    out += fmt::format("{} T{} ;\r\n", words, tool_);
  }
  void line(std::string& out, const MoveWords& move) override { cut(out, 101, move, {}); }

  bool arc(std::string& out, const ArcWords& arc) override {
    std::string center;
    append_word(center, "XC", arc.absolute_center[0]);
    append_word(center, "YC", arc.absolute_center[1]);
    cut(out, arc.turn == interpreter::Turn::Clockwise ? 102 : 103, arc, center);
    return true;
  }

  // What is the operator's, or is refused (OperatorStage).
  void dwell(std::string& /*out*/, std::int64_t /*counts*/) override {}
  Result<void> spindle(std::string& /*out*/, const interpreter::Spindle&) override { return {}; }
  Result<void> coolant(std::string& /*out*/, bool /*flood*/, bool /*mist*/) override { return {}; }
  void machine_function(std::string& /*out*/, int /*code*/) override {}

  void tool(std::string& out, const interpreter::ToolChange& tool) override {
    end_chain(out);
    tool_ = tool.number;
  }
  void stop(std::string& out, interpreter::StopKind) override { end_chain(out); }

  void comment(std::string& out, std::string_view text) override {
    std::string line = fmt::format("({})\r\n", text);
    std::ranges::replace(line, '%', ' ');  // it ends a program, in a comment too
    (cut_.empty() ? out : comments_) += line;
  }

  void end(std::string& out) override {
    end_chain(out);
    out += "%\r\n";
  }

 private:
  std::string event(int code) {
    count_block();
    return fmt::format("N{:03} G{}", blocks() % 1000, code);
  }
  void append_word(std::string& words, std::string_view address, std::int64_t counts) const {
    words += fmt::format(" {}", address);
    append_number(words, counts, range_of(target_.coordinate, units_).decimals, kEventLook);
    words += 'A';
  }
  template <class Places>
  void append_point(std::string& words, std::string_view x, std::string_view y,
                    const Places& at) const {
    append_word(words, x, at[static_cast<std::size_t>(Axis::X)]);
    append_word(words, y, at[static_cast<std::size_t>(Axis::Y)]);
  }

  void cut(std::string& out, int code, const MoveWords& move, std::string_view center) {
    end_cut(out, true);
    if (move.feed) feed_ = move.feed->counts;
    cut_ = event(code);
    append_point(cut_, "XB", "YB", move.from);
    append_point(cut_, "XE", "YE", move.at);
    cut_ += center;
    cut_ += " F";
    const int decimals = range_of(target_.feed, units_).decimals;
    append_number(cut_, feed_, decimals, {.has_point = decimals > 0});
    cut_ += " TC0 D0.";
  }
  /// `is_connected`: the next one continues it.
  void end_cut(std::string& out, bool is_connected) {
    if (cut_.empty()) return;
    out += fmt::format("{} {} T{} ;\r\n{}", cut_, is_connected ? "CR0." : "CR-", tool_, comments_);
    cut_.clear();
    comments_.clear();
  }
  void end_chain(std::string& out) { end_cut(out, false); }

  const Target& target_;
  interpreter::Units units_ = interpreter::Units::Millimeter;
  int tool_ = 1;
  std::int64_t feed_ = 0;
  std::string cut_;       ///< without its connection
  std::string comments_;  ///< after it
};

}  // namespace

std::unique_ptr<ProgramWriter> make_event_writer(const Target& target) {
  return std::make_unique<EventWriter>(target);
}

}  // namespace dripline::post
