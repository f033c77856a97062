#include <fmt/format.h>

#include "clients/tools/conversational/impl/posting.hpp"

namespace dripline::conversational {
namespace {

/// To a cycle's start point; turning names Z first, facing X, in the order of the screens.
BlockText rapid_to(Work work, const Entry& x, const Entry& z) {
  BlockText block("G0");
  return work == Work::Turning ? block.word("Z", z).word("X", x) : block.word("X", x).word("Z", z);
}

/// `G71 P9807 Q9907`.
BlockText pattern_cycle(std::string_view code, int pattern) {
  return BlockText(fmt::format("{} P98{:02} Q99{:02}", code, pattern, pattern));
}

/// The label every pattern begins with, and its compensation.
void begin_pattern(Posting& out, int pattern, Compensation compensation) {
  out.block(fmt::format("N98{:02}", pattern));
  out.block(code_of(compensation));
  out.pattern = pattern;
}

BlockText start_of(const Entry& x, const Entry& z) {
  return BlockText("G0").word("X", x).word("Z", z);
}

/// The distance of the nose from the root of a sharp thread, into P124, as the manual prints it:
/// non-movement blocks move it, as a tool of type 0, around a vertex at the origin.
void post_printed_truncation(Posting& out) {
  out.parameter(92, "P262");
  out.parameter(262, 0.0);
  out.block("G65 G42 G0 XC0 ZC0 R2 AB[90-P108/2]");
  out.block("G65 X0 Z0");
  out.block("G65 G40 R2 AB[90+P108/2]");
  out.parameter(124, "P209*2 - P261");
  out.parameter(262, "P92");
}

/// The remaining height, and the diameter to cut to.
void post_crest(Posting& out, const MultipleThread& event) {
  out.parameter(91, event.crest_x);
  out.parameter(101, event.lead);
  out.parameter(108, event.nose_angle);
  if (out.options().has_printed_crest_formula) {
    post_printed_truncation(out);
  } else {
    out.parameter(124, "P261/SIN[P108/2] - P261");
  }
  out.parameter(106, "P101/[2*TAN[P108/2]] - P124");
  out.parameter(124, "P91-2*P106");
  out.block("IF P139 < P91 THEN P124 = P91+2*P106");
}

std::string_view code_of(ReturnPoint point) {
  return point == ReturnPoint::Clearance ? "G39" : "G38";
}

std::string_view code_of(Drilling kind) {
  constexpr std::string_view kCodes[] = {"G81", "G82", "G83", "G85", "G89"};
  return kCodes[static_cast<std::size_t>(kind)];
}

}  // namespace

void post(Posting& out, const RoughCycle& event) {
  const int pattern = event.pattern.value_or(0);
  out.block(rapid_to(event.work, event.start_x, event.start_z));
  out.clearances(event.start_x, event.start_z);
  out.parameter(117, event.relief == Relief::Degrees45 ? 1.0 : 0.0);
  BlockText block = pattern_cycle(event.work == Work::Turning ? "G71" : "G72", pattern);
  block.word("U", event.x_finish_stock).word("W", event.z_finish_stock);
  block.word("I", event.x_rough_stock).word("K", event.z_rough_stock);
  block.word("R", event.clearance).word("V", event.first_depth).word("D", event.cut_increment);
  out.block(block);
  begin_pattern(out, pattern, event.compensation);
}

void post(Posting& out, const PatternRepeat& event) {
  const int pattern = event.pattern.value_or(0);
  out.block(rapid_to(Work::Facing, event.start_x, event.start_z));
  out.clearances(event.start_x, event.start_z);
  BlockText block = pattern_cycle("G73", pattern);
  block.word("U", event.x_finish_stock).word("W", event.z_finish_stock);
  block.word("I", event.x_rough_stock).word("K", event.z_rough_stock);
  if (event.passes) block.word("D", *event.passes);
  out.block(block);
  begin_pattern(out, pattern, event.compensation);
}

void post(Posting& out, const EndCycle&) {
  out.block(fmt::format("N99{:02}", out.pattern.value_or(0)));
  out.pattern.reset();
}

void post(Posting& out, const FinishCycle& event) {
  out.block(BlockText().word("F", event.feed));
  out.block(BlockText().word("S", event.speed));
  out.block(rapid_to(Work::Facing, event.start_x, event.start_z));
  out.clearances(event.start_x, event.start_z);
  out.block(pattern_cycle("G70", event.pattern.value_or(0)));
  if (event.work == Work::Turning) {
    out.block(BlockText("G0").word("X", event.start_x));
    out.block(BlockText().word("Z", event.start_z));
  } else {
    out.block(BlockText("G0").word("Z", event.start_z));
    out.block(BlockText().word("X", event.start_x));
  }
}

void post(Posting& out, const SingleCut& event) {
  const bool is_turning = event.work == Work::Turning;
  out.block(rapid_to(Work::Facing, event.start_x, event.start_z));
  out.clearances(event.start_x, event.start_z);
  out.block(BlockText().word("S", event.speed));
  BlockText block(code_of(event.compensation));
  block.code(is_turning ? "G90" : "G94").word(is_turning ? "I" : "K", event.taper);
  block.word("X", event.x).word("U", event.u).word("Z", event.z).word("W", event.w);
  out.block(block.word("F", event.feed));
}

void post(Posting& out, const MultipleThread& event) {
  const bool is_crest = event.entry == ThreadEntry::Crest;
  out.parameter(103, event.chamfer_length);
  out.parameter(104, event.chamfer_angle);
  out.parameter(130, event.minimum_cut);
  if (event.finish_passes) out.parameter(131, *event.finish_passes);
  out.block(start_of(event.start_x, event.start_z));
  out.clearances(event.start_x, event.start_z);
  if (is_crest) post_crest(out, event);
  BlockText block("G76");
  is_crest ? block.code("X[P124]") : block.word("X", event.root_x);
  block.word("Z", event.z).word("I", event.taper).word("Q", event.start_angle);
  block.word("F", event.lead);
  is_crest ? block.code("K[P106]") : block.word("K", event.height);
  block.word("A", event.nose_angle).word("D", event.first_cut);
  if (event.method) block.word("P", *event.method);
  out.block(block);
}

void post(Posting& out, const SingleThread& event) {
  out.block(start_of(event.start_x, event.start_z));
  out.clearances(event.start_x, event.start_z);
  out.parameter(103, event.chamfer_length);
  out.parameter(104, event.chamfer_angle);
  BlockText block("G40 G92");
  block.word("I", event.taper).word("X", event.x).word("U", event.u);
  block.word("Z", event.z).word("W", event.w).word("Q", event.start_angle);
  out.block(block.word("F", event.lead));
}

void post(Posting& out, const DrillCycle& event) {
  BlockText block(code_of(event.kind));
  block.word("P", event.dwell);
  block.word("Q", event.increment).word("E", event.peck_clearance).word("V", event.first_depth);
  block.word("R", event.clearance).word("Z", event.z).word("F", event.feed);
  out.block(block.code(code_of(event.return_point)));
}

void post(Posting& out, const TapCycle& event) {
  BlockText spindle("G97 G99");
  out.block(spindle.code(event.hand == Hand::Right ? "M3" : "M4").word("S", event.speed));
  BlockText block("G84");
  block.code(fmt::format("F[1/{}]", number_text(event.threads_per_unit.value_or(1))));
  block.word("R", event.clearance).word("Z", event.z);
  out.block(block.code(code_of(event.return_point)));
}

void post(Posting& out, const GrooveCycle& event) {
  const bool is_face = event.work == Work::Facing;
  BlockText block(is_face ? "G74" : "G75");
  block.word("Q", event.increment).word("U", event.peck_up).word("E", event.peck_clearance);
  block.word("V", event.first_depth).word("X", event.x);
  block.word(is_face ? "I" : "K", event.step).word("D", event.relief);
  block.word("A", event.x_finish_stock).word("C", event.z_finish_stock);
  block.word("R", event.clearance).word("Z", event.z).word("F", event.feed);
  out.block(block.code(code_of(event.return_point)));
}

}  // namespace dripline::conversational
