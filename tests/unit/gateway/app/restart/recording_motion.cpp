#include "tests/unit/gateway/app/restart/recording_motion.hpp"

#include <fmt/format.h>

namespace dripline::gateway {

using interpreter::Origin;

namespace {

std::string axes_text(const interpreter::Position& position) {
  std::string text;
  for (const interpreter::Axis axis : interpreter::kAllAxes) {
    if (!position.has(axis)) continue;
    text += fmt::format(" {}{:.17g}", interpreter::letter(axis), position.raw(axis) + 0.0);
  }
  return text;
}

std::string feed_text(const Feed& feed) {
  return feed.per() == Feed::Per::Move
             ? fmt::format(" F{:.17g}/move", feed.moves_per_minute())
             : fmt::format(" F{:.17g}/{}", feed.length().mm(), static_cast<int>(feed.per()));
}

}  // namespace

void PathWriter::write(const Origin& origin, const std::string& what) {
  write_(fmt::format("{} {}", origin.block, what));
}

void PathWriter::on_rapid(const interpreter::Rapid& event) {
  write(event.origin, "rapid" + axes_text(event.to));
  out().on_rapid(event);
}
void PathWriter::on_line(const interpreter::Line& event) {
  write(event.origin, "line" + axes_text(event.to) + feed_text(event.feed));
  out().on_line(event);
}
void PathWriter::on_arc(const interpreter::Arc& event) {
  write(event.origin,
        fmt::format("arc{} center {:.17g} {:.17g} sweep {:.17g} plane {} turn {}{}",
                    axes_text(event.to), event.center_first.mm(), event.center_second.mm(),
                    event.sweep.degrees(), static_cast<int>(event.plane),
                    static_cast<int>(event.turn), feed_text(event.feed)));
  out().on_arc(event);
}
void PathWriter::on_thread(const interpreter::Thread& event) {
  write(event.origin, fmt::format("thread{} lead {:.17g}", axes_text(event.to), event.lead.mm()));
  out().on_thread(event);
}
void PathWriter::on_dwell(const interpreter::Dwell& event) {
  write(event.origin, fmt::format("dwell {} {}", event.seconds, event.revolutions.value_or(0)));
  out().on_dwell(event);
}
void PathWriter::on_spindle(const interpreter::Spindle& event) {
  write(event.origin,
        fmt::format("spindle {} {}", static_cast<int>(event.state), event.revolutions_per_minute));
  out().on_spindle(event);
}
void PathWriter::on_coolant(const interpreter::Coolant& event) {
  write(event.origin, fmt::format("coolant {} {}", event.flood, event.mist));
  out().on_coolant(event);
}
void PathWriter::on_tool(const interpreter::ToolChange& event) {
  write(event.origin, fmt::format("tool {} {}", event.number, event.is_preselection));
  out().on_tool(event);
}
void PathWriter::on_miscellaneous(const interpreter::Miscellaneous& event) {
  write(event.origin, fmt::format("M{}", event.code));
  out().on_miscellaneous(event);
}
void PathWriter::on_pin(const interpreter::PinChange& event) {
  write(event.origin, fmt::format("pin {} {}", event.output, event.state));
  out().on_pin(event);
}
void PathWriter::on_output(const interpreter::Output& event) {
  write(event.origin, "output " + std::string(event.text));
  out().on_output(event);
}
void PathWriter::on_stop(const interpreter::Stop& event) {
  write(event.origin, fmt::format("stop {}", static_cast<int>(event.kind)));
  out().on_stop(event);
}
void PathWriter::on_alarm(const interpreter::Alarm& event) {
  write(event.origin, "alarm " + std::string(event.diagnostic.id));
  out().on_alarm(event);
}
void PathWriter::on_end(const interpreter::End& event) {
  write(event.origin, "program end");
  out().on_end(event);
}
void PathWriter::on_block_end(const Origin& origin) {
  write(origin, "end");
  out().on_block_end(origin);
}
void PathWriter::probe(const interpreter::Probe& probe) {
  write(probe.origin, "probe" + axes_text(probe.to));
}

}  // namespace dripline::gateway
