#include "gateway/machine/capability_filter.hpp"

#include <fmt/format.h>

namespace dripline::machine {

using interpreter::Origin;

void CapabilityFilter::refuse(const Origin& origin, std::string_view what) {
  out().on_alarm(
      {origin, {"MCH0008", fmt::format("this machine cannot {}", what), origin.line, 1}});
}

bool CapabilityFilter::has_feed(const Origin& origin, Feed feed) {
  if (feed.per() != Feed::Per::Revolution || capabilities_.spindle_feedback) return true;
  refuse(origin, "feed per revolution");
  return false;
}

/// The positions of events leave a tool's length out, so a machine that takes none into account
/// would move deeper by it.
bool CapabilityFilter::is_without_length(const Origin& origin) {
  if (capabilities_.tool_lengths && !capabilities_.adds_lengths) return true;
  const interpreter::ActiveModes modes = now_().modes;
  const bool has_none = modes.tool_length_x == Length{} && modes.tool_length_y == Length{} &&
                        modes.tool_length_z == Length{};
  if (modes.is_length_plain && has_none) return true;
  refuse(origin,
         fmt::format("take the length of a tool into account{}: X {:.3f}, Y {:.3f}, Z {:.3f} mm"
                     "{} is in force. Lengths must be 0 here, and each tool needs a datum "
                     "of its own",
                     capabilities_.adds_lengths ? " with this control" : "",
                     modes.tool_length_x.mm(), modes.tool_length_y.mm(), modes.tool_length_z.mm(),
                     modes.is_length_plain ? "" : ", tilted or of other axes,"));
  return false;
}

bool CapabilityFilter::is_certain(const Origin& origin, const interpreter::ActiveModes& modes) {
  const bool is_along_other = modes.length_axis > interpreter::Axis::Z;
  if (modes.is_length_certain && !(is_along_other && modes.tool_length_z != Length{})) return true;
  refuse(
      origin,
      "take the length of a tool into account that is tilted or of other axes than X, Y and Z, "
      "or of an axis whose coordinates are in doubt by machine coordinates (G28, G30, G53, M91)");
  return false;
}

bool CapabilityFilter::note_block(const Origin& origin) {
  if (!adds_lengths()) return is_without_length(origin);
  const Now now = now_();
  lengths_.note(now.modes, now.block);
  return true;
}

bool CapabilityFilter::takes_motion(const Origin& origin, const interpreter::Position& to,
                                    bool is_arc) {
  if (!adds_lengths()) return is_without_length(origin);
  const Now now = now_();
  if (!is_certain(origin, now.modes)) return false;
  lengths_.note(now.modes, now.block);
  if (const auto fault = lengths_.take({to, origin.block, is_arc})) {
    refuse(origin, *fault);
    return false;
  }
  rule_.set(lengths_.lengths());
  return true;
}

bool CapabilityFilter::takes_probe(const interpreter::Probe& probe) {
  if (probe.arc && !capabilities_.arc_probing) {
    refuse(probe.origin, "probe on an arc");
    return false;
  }
  if (probe.is_rapid && !capabilities_.rapid_probing) {
    refuse(probe.origin, "probe at rapid traverse");
    return false;
  }
  return takes_motion(probe.origin, probe.to, probe.arc.has_value());
}

void CapabilityFilter::on_rapid(const interpreter::Rapid& rapid) {
  if (takes_motion(rapid.origin, rapid.to)) out().on_rapid(rapid);
}

void CapabilityFilter::on_line(const interpreter::Line& line) {
  if (has_feed(line.origin, line.feed) && takes_motion(line.origin, line.to)) out().on_line(line);
}

void CapabilityFilter::on_arc(const interpreter::Arc& arc) {
  if (!capabilities_.arcs) return refuse(arc.origin, "move on arcs");
  if (has_feed(arc.origin, arc.feed) && takes_motion(arc.origin, arc.to, true)) out().on_arc(arc);
}

void CapabilityFilter::on_thread(const interpreter::Thread& thread) {
  if (!capabilities_.threads) return refuse(thread.origin, "cut threads");
  if (takes_motion(thread.origin, thread.to)) out().on_thread(thread);
}

void CapabilityFilter::on_dwell(const interpreter::Dwell& dwell) {
  if (dwell.revolutions && !capabilities_.spindle_feedback)
    return refuse(dwell.origin, "dwell per revolution");
  out().on_dwell(dwell);
}

/// A position that was shifted shows when its block is done.
void CapabilityFilter::on_block_end(const Origin& origin) {
  if (adds_lengths()) {
    const Now now = now_();
    lengths_.note(now.modes, now.block);
    rule_.set(lengths_.shift());
  }
  out().on_block_end(origin);
}

}  // namespace dripline::machine
