#include "clients/tools/conversational/post.hpp"

#include <fmt/format.h>

#include "clients/tools/conversational/impl/posting.hpp"
#include "clients/tools/conversational/sequence.hpp"

namespace dripline::conversational {

BlockText& BlockText::code(std::string_view text) {
  if (text.empty()) return *this;
  if (!text_.empty() && text.front() != ',') text_ += ' ';
  text_ += text;
  return *this;
}

BlockText& BlockText::word(std::string_view letters, const Entry& value) {
  return value ? code(std::string(letters) + number_text(*value)) : *this;
}

void Posting::block(const BlockText& block) {
  if (block.text().empty()) return;
  text_ += block.text();
  text_ += '\n';
}

void Posting::parameter(int number, const Entry& value) {
  if (value) parameter(number, number_text(*value));
}

void Posting::parameter(int number, std::string_view expression) {
  block(fmt::format("P{} = {}", number, expression));
}

void Posting::clearances(const Entry& start_x, const Entry& start_z) {
  parameter(140, start_z);
  parameter(139, start_x);
}

std::string_view code_of(Compensation compensation) {
  if (compensation == Compensation::Off) return "G40";
  return compensation == Compensation::Left ? "G41" : "G42";
}

Result<std::string> post(const Events& events, const PostOptions& options) {
  if (auto checked = check_sequence(events); !checked) return fail(checked.error());
  Posting out(options);
  for (const Event& event : events) {
    std::visit(
        [&](const auto& record) {
          using Record = std::decay_t<decltype(record)>;
          constexpr bool kIsGeometry = std::is_same_v<Record, Line> || std::is_same_v<Record, Arc>;
          if (!kIsGeometry) out.set_motion("");
          post(out, record);
        },
        event);
  }
  return out.take();
}

namespace {

std::string comment(const std::string& text) {
  return text.empty() ? "" : "(" + text + ")";
}

std::string_view code_of(Restart restart) {
  if (restart == Restart::None) return "";
  return restart == Restart::Clockwise ? "M3" : "M4";
}

}  // namespace

void post(Posting& out, const ProgramSetup& event) {
  BlockText head(fmt::format("O{:04}", event.program.value_or(0)));
  out.block(head.code(comment(event.name)));
  BlockText modes(event.units == UnitSystem::English ? "G20" : "G21");
  out.block(modes.code(event.dimensions == Dimensions::Absolute ? "G93" : "G91"));
  out.parameter(156, event.material_length);
  out.parameter(157, event.material_diameter);
}

void post(Posting& out, const ToolSelection& event) {
  const int tool = event.tool.value_or(0);
  if (event.is_change) {
    out.block("G40 G501 G550 G569 G80 M5 M9");
    out.parameter(268, static_cast<double>(tool));
    out.block(BlockText("M6").code(comment(event.description)));
  }
  out.block(fmt::format("T{:02}{:02}", tool, tool));
  BlockText feed(event.feed_mode == FeedMode::PerRevolution ? "G99" : "G98");
  out.block(feed.word("F", event.feed));
  if (event.maximum_speed) out.block(BlockText("G50").word("S", event.maximum_speed));
  BlockText spindle(event.spindle_mode == SpindleMode::SurfaceSpeed ? "G96" : "G97");
  out.block(spindle.word("S", event.speed));
  out.block(code_of(event.restart));
  if (event.has_coolant) out.block("M8");
}

void post(Posting& out, const Miscellaneous& event) {
  out.block(BlockText(posted(kFeedModes, event.feed_mode)).word("F", event.feed));
  if (event.maximum_speed) out.block(BlockText("G50").word("S", event.maximum_speed));
  out.block(BlockText(posted(kSpindleModes, event.spindle_mode)).word("S", event.speed));
  out.block(posted(kGears, event.gear));
  out.block(posted(kSpindles, event.spindle));
  out.block(posted(kCoolants, event.coolant));
  out.block(posted(kCompensations, event.compensation));
  out.block(posted(kStops, event.stop));
  out.block(posted(kRetracts, event.retract));
  out.block(posted(kCuttingModes, event.cutting_mode));
  out.block(posted(kProgramModes, event.program_mode));
  out.block(posted(kWorkCoordinates, event.work_coordinate));
  out.block(posted(kOptionalFunctions, event.option));
  out.block(event.text);
}

void post(Posting& out, const ProgramCall& event) {
  BlockText block(fmt::format("CALL {}", event.program.value_or(0)));
  if (event.repeats) block.word("L", *event.repeats);
  out.block(block);
}

void post(Posting& out, const Scaling& event) {
  if (!event.is_on) return out.block("G550");
  BlockText block("G551");
  block.word("I", event.center_x).word("K", event.center_z);
  out.block(block.word("X", event.x_factor).word("Z", event.z_factor));
}

void post(Posting& out, const Rotation& event) {
  if (!event.is_on) return out.block("G569");
  out.block(BlockText("G568").word("X", event.x).word("Z", event.z).word("AA", event.angle));
}

void post(Posting& out, const Mirror& event) {
  if (!event.is_on) return out.block("G501");
  out.block(BlockText("G511").word("X", event.x).word("Z", event.z));
}

void post(Posting& out, const FloatingZero& event) {
  out.block(BlockText("G50").word("X", event.x).word("Z", event.z));
}

void post(Posting& out, const EndOfProgram& event) {
  if (event.stops_spindle) out.block("M5");
  if (event.stops_coolant) out.block("M9");
  if (event.x || event.z) out.block(BlockText("G53 G0").word("X", event.x).word("Z", event.z));
}

}  // namespace dripline::conversational
