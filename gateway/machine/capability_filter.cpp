#include "gateway/machine/capability_filter.hpp"

#include <fmt/format.h>

namespace dripline::machine {

void CapabilityFilter::refuse(const interpreter::Origin& origin, std::string_view what) {
  out().on_alarm(
      {origin, {"MCH0008", fmt::format("this machine cannot {}", what), origin.line, 1}});
}

bool CapabilityFilter::has_feed(const interpreter::Origin& origin, Feed feed) {
  if (feed.per() != Feed::Per::Revolution || capabilities_.spindle_feedback) return true;
  refuse(origin, "feed per revolution");
  return false;
}

bool CapabilityFilter::takes_length(const interpreter::Origin& origin) {
  if (capabilities_.tool_lengths) return true;
  const interpreter::ActiveModes modes = modes_();
  const bool is_plain = modes.is_length_plain;
  if (is_plain && modes.tool_length_x == Length{} && modes.tool_length_y == Length{} &&
      modes.tool_length_z == Length{})
    return true;
  refuse(origin,
         fmt::format("take the length of a tool into account: X {:.3f}, Y {:.3f}, Z {:.3f} mm"
                     "{} is in force. Lengths must be 0 here, and each tool needs a datum "
                     "of its own",
                     modes.tool_length_x.mm(), modes.tool_length_y.mm(), modes.tool_length_z.mm(),
                     is_plain ? "" : ", tilted or of other axes,"));
  return false;
}

void CapabilityFilter::on_rapid(const interpreter::Rapid& rapid) {
  if (takes_length(rapid.origin)) out().on_rapid(rapid);
}

void CapabilityFilter::on_line(const interpreter::Line& line) {
  if (has_feed(line.origin, line.feed) && takes_length(line.origin)) out().on_line(line);
}

void CapabilityFilter::on_arc(const interpreter::Arc& arc) {
  if (!capabilities_.arcs) return refuse(arc.origin, "move on arcs");
  if (has_feed(arc.origin, arc.feed) && takes_length(arc.origin)) out().on_arc(arc);
}

void CapabilityFilter::on_thread(const interpreter::Thread& thread) {
  if (!capabilities_.threads) return refuse(thread.origin, "cut threads");
  if (takes_length(thread.origin)) out().on_thread(thread);
}

void CapabilityFilter::on_dwell(const interpreter::Dwell& dwell) {
  if (dwell.revolutions && !capabilities_.spindle_feedback)
    return refuse(dwell.origin, "dwell per revolution");
  out().on_dwell(dwell);
}

}  // namespace dripline::machine
