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

}  // namespace dripline::conversational
