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

void CapabilityFilter::on_line(const interpreter::Line& line) {
  if (has_feed(line.origin, line.feed)) out().on_line(line);
}

void CapabilityFilter::on_arc(const interpreter::Arc& arc) {
  if (!capabilities_.arcs) return refuse(arc.origin, "move on arcs");
  if (has_feed(arc.origin, arc.feed)) out().on_arc(arc);
}

void CapabilityFilter::on_thread(const interpreter::Thread& thread) {
  if (!capabilities_.threads) return refuse(thread.origin, "cut threads");
  out().on_thread(thread);
}

void CapabilityFilter::on_dwell(const interpreter::Dwell& dwell) {
  if (dwell.revolutions && !capabilities_.spindle_feedback)
    return refuse(dwell.origin, "dwell per revolution");
  out().on_dwell(dwell);
}

}  // namespace dripline::machine
