#include <fmt/format.h>
#include <cmath>

#include "clients/tools/post/adaptation.hpp"
#include "gateway/interpreter/core/path_feed.hpp"

/// What a program does besides moving.
namespace dripline::post {
namespace {

using interpreter::EventGate;
using interpreter::SpindleState;

/// Some controls report that again, and others do not.
bool is_off_already(const interpreter::Spindle& event, SpindleState state) {
  return event.state == SpindleState::Off && state == SpindleState::Off;
}
bool is_off_already(const interpreter::Coolant& event, bool has_coolant) {
  return !event.flood && !event.mist && !has_coolant;
}

/// M02 and M30 are ends, whatever a control reports besides.
bool is_end_code(int code) {
  return code == 2 || code == 30;
}

/// They mean the same nearly everywhere, and something else at a control that hands them on.
bool is_common_code(int code) {
  return code == 19 || code == 98 || code == 99;
}

/// The speed of a spindle that is oriented means nothing, and not all controls report it.
interpreter::Spindle without_speed(interpreter::Spindle event) {
  event.revolutions_per_minute = 0;
  event.surface_speed.reset();
  event.max_revolutions.reset();
  return event;
}

}  // namespace

/// A lead is rounded by a ten-thousandth of it at most: a screw has to fit.
void Adaptation::on_thread(const interpreter::Thread& event) {
  if (!is_open() || !check_target(event.origin, event.to)) return;
  const double lead = event.lead.mm();
  if (!target().has_threads)
    return refuse(event.origin, fmt::format("thread of lead {:g} mm: {} has no code for it here",
                                            lead, target().name));
  if (event.arc || event.lead_change.mm() != 0)
    return refuse(event.origin,
                  fmt::format("thread of lead {:g} mm {}: {} is written with straight "
                              "threads of one lead",
                              lead, event.arc ? "on an arc" : "that changes", target().name));
  if (is_short(event.to)) return refuse(event.origin, "thread shorter than a step of the target");
  constexpr double kLeadTolerance = 1e-4;
  const auto& range = range_of(target().feed_per_revolution, grid_.units());
  const double unit = mm_per_unit(grid_.units());
  const double word = lead_word(grid_, at_, event.to, event.lead).mm() / unit;
  const double nearest = value_of(counts_of(word, range.decimals), range.decimals);
  if (!(nearest > 0) || nearest > range.max ||
      !(std::fabs(nearest - word) <= kLeadTolerance * word)) {
    return refuse(event.origin,
                  fmt::format("thread of lead {:g} {}: {} takes {} decimals up to {:g}", word,
                              unit_name(grid_.units()), target().name, range.decimals, range.max));
  }
  if (std::fabs(nearest - word) > 1e-9 * word) ++counts_.rounded_leads;
  interpreter::Thread adapted = event;
  adapted.lead = lead_of_path(grid_, at_, event.to, Length::mm(nearest * unit));
  if (event.start_angle)
    adapted.start_angle = Angle::degrees(value_of(counts_of(event.start_angle->degrees(), 3), 3));
  adapted.to = of_target(target(), event.to, start_);
  EventGate::on_thread(adapted);
  at_ = event.to;
}

void Adaptation::on_dwell(const interpreter::Dwell& event) {
  if (!is_open()) return;
  if (event.revolutions) {
    return refuse(event.origin, fmt::format("dwell of {:g} revolutions: dwells are written in "
                                            "seconds",
                                            *event.revolutions));
  }
  const auto seconds =
      rounded(event.origin, "dwell", event.seconds, target().dwell, "s", counts_.rounded_dwells);
  if (!seconds) return;
  interpreter::Dwell adapted = event;
  adapted.seconds = *seconds;
  EventGate::on_dwell(adapted);
}

void Adaptation::on_spindle(const interpreter::Spindle& event) {
  if (!is_open() || is_off_already(event, spindle_.state)) return;
  interpreter::Spindle adapted =
      event.state == SpindleState::Oriented ? without_speed(event) : event;
  if (event.state == SpindleState::Oriented && !target().has_oriented_spindle)
    return refuse(event.origin, fmt::format("oriented spindle: {} has none", target().name));
  if (is_turning(event.state) && event.surface_speed) {
    if (!target().has_surface_speed) {
      return refuse(event.origin,
                    fmt::format("constant surface speed of {:g} m/min: {} has revolutions alone",
                                event.surface_speed->mm() / 1000, target().name));
    }
    const bool is_inch = grid_.units() == interpreter::Units::Inch;
    const double unit = mm_per_surface_unit(grid_.units());
    const auto value = rounded(event.origin, "surface speed", event.surface_speed->mm() / unit,
                               {target().speed.decimals, 9999}, is_inch ? "ft/min" : "m/min",
                               counts_.rounded_speeds);
    if (!value) return;
    adapted.surface_speed = Length::mm(*value * unit);
  } else if (is_turning(event.state)) {
    const auto value = rounded(event.origin, "spindle speed", event.revolutions_per_minute,
                               target().speed, "rpm", counts_.rounded_speeds);
    if (!value) return;
    adapted.revolutions_per_minute = *value;
  }
  EventGate::on_spindle(adapted);
  spindle_ = adapted;
}

void Adaptation::on_coolant(const interpreter::Coolant& event) {
  if (event.mist && !target().has_mist)
    return refuse(event.origin, fmt::format("mist coolant: {} has none", target().name));
  if (is_off_already(event, has_coolant_)) return;
  EventGate::on_coolant(event);
  has_coolant_ = event.flood || event.mist;
}

void Adaptation::on_tool(const interpreter::ToolChange& event) {
  if (event.is_preselection || !is_open()) return;
  if (event.is_in_spindle) {
    return refuse(event.origin,
                  fmt::format("tool {} is to be in the spindle already: {} has no word for that",
                              event.number, target().name));
  }
  tool_ = event.number;
  if (target().max_tool == 0 || event.number < target().min_tool ||
      event.number > target().max_tool) {
    return refuse(
        event.origin,
        target().max_tool == 0
            ? fmt::format("tool {}: {} has no tool numbers", event.number, target().name)
            : fmt::format("tool {}: {} has tools {} {}", event.number, target().name,
                          target().min_tool == 0 ? "up to" : "from 1 to", target().max_tool));
  }
  interpreter::Spindle spindle = spindle_;
  spindle.origin = event.origin;
  const bool restarts = target().stops_spindle_at_tool_change && is_turning(spindle.state);
  if (restarts) {
    ++counts_.spindle_restarts;
    interpreter::Spindle off;
    off.origin = event.origin;
    EventGate::on_spindle(off);
  }
  has_waited_ = true;  // a target with an operator waits for the tool
  EventGate::on_tool(event);
  if (restarts) EventGate::on_spindle(spindle);
}

void Adaptation::on_miscellaneous(const interpreter::Miscellaneous& event) {
  if (!is_open() || is_end_code(event.code)) return;
  if (target().max_m == 0) {
    return refuse(event.origin, fmt::format("M{}: {} has no M functions of the machine", event.code,
                                            target().name));
  }
  if (event.code < target().min_m || event.code > target().max_m || is_common_code(event.code)) {
    return refuse(event.origin,
                  fmt::format("M{}: M functions of the machine are {} to {} at {}, but for 19, 98 "
                              "and 99",
                              event.code, target().min_m, target().max_m, target().name));
  }
  if (event.e || event.p || event.q) {
    return refuse(event.origin,
                  fmt::format("M{} with E, P or Q: these are not written", event.code));
  }
  EventGate::on_miscellaneous(event);
}

void Adaptation::on_pin(const interpreter::PinChange& event) {
  refuse(event.origin, fmt::format("output {} of axis {}: outputs are not written", event.output,
                                   letter(event.axis)));
}

void Adaptation::on_probe(const interpreter::Probe& event) {
  refuse(event.origin, "probing move: where it ends is known at the machine alone");
}

void Adaptation::on_output(const interpreter::Output& event) {
  refuse(event.origin, fmt::format("output \"{}\": outputs are not written", event.text));
}

void Adaptation::on_open(const interpreter::Open& event) {
  refuse(event.origin, "an output is opened: outputs are not written");
}

void Adaptation::on_close(const interpreter::Close& event) {
  refuse(event.origin, "an output is closed: outputs are not written");
}

void Adaptation::on_message(const interpreter::Message& event) {
  ++counts_.messages;
  if (options_.passes_messages) EventGate::on_message(event);
}

void Adaptation::on_prompt(const interpreter::Prompt&) {
  ++counts_.prompts;
}

void Adaptation::on_stop(const interpreter::Stop& event) {
  if (!is_open()) return;
  using interpreter::StopKind;
  if (event.kind == StopKind::ToolChange) {
    ++counts_.tool_change_stops;
    return;
  }
  if (event.kind == StopKind::Operator) {
    if (!target().has_operator_axis)
      return refuse(event.origin, "a wait for the operator at an axis: it is not written");
    if (has_waited_) return;
    has_waited_ = true;
  }
  if (event.kind == StopKind::Optional && !target().has_optional_stop)
    return refuse(event.origin, fmt::format("optional stop: {} has none", target().name));
  EventGate::on_stop(event);
}

void Adaptation::on_override_inhibit(const interpreter::OverrideInhibit& event) {
  const bool inhibits = event.feed_override || event.spindle_override || event.single_block ||
                        event.is_tapping || event.hold != interpreter::FeedHoldInhibit::AtOnce;
  if (!inhibits) return;
  refuse(event.origin, event.is_tapping
                           ? "tapping: the overrides and feed hold that it inhibits cannot be "
                             "written"
                           : "inhibited overrides or feed hold: they cannot be written");
}

void TargetView::on_rapid(const interpreter::Rapid& event) {
  interpreter::Rapid seen = event;
  seen.to = of_target(target_, event.to, start_);
  has_waited_ = has_waited_ && seen.to.same_point(at_);
  at_ = seen.to;
  EventFilter::on_rapid(seen);
}

void TargetView::on_line(const interpreter::Line& event) {
  interpreter::Line seen = event;
  seen.to = of_target(target_, event.to, start_);
  has_waited_ = has_waited_ && seen.to.same_point(at_);
  at_ = seen.to;
  EventFilter::on_line(seen);
}

void TargetView::on_arc(const interpreter::Arc& event) {
  has_waited_ = false;
  interpreter::Arc seen = event;
  seen.to = of_target(target_, event.to, start_);
  if (target_.feeds_along_circle) seen.feed = interpreter::circle_feed_of(event.feed, seen, at_);
  at_ = seen.to;
  EventFilter::on_arc(seen);
}

void TargetView::on_thread(const interpreter::Thread& event) {
  interpreter::Thread seen = event;
  seen.to = at_ = of_target(target_, event.to, start_);
  EventFilter::on_thread(seen);
}

void TargetView::on_spindle(const interpreter::Spindle& event) {
  if (is_off_already(event, spindle_)) return;
  EventFilter::on_spindle(event.state == SpindleState::Oriented ? without_speed(event) : event);
  spindle_ = event.state;
}

void TargetView::on_coolant(const interpreter::Coolant& event) {
  if (is_off_already(event, has_coolant_)) return;
  EventFilter::on_coolant(event);
  has_coolant_ = event.flood || event.mist;
}

void TargetView::on_tool(const interpreter::ToolChange& event) {
  has_waited_ = true;
  EventFilter::on_tool(event);
}

void TargetView::on_stop(const interpreter::Stop& event) {
  using interpreter::StopKind;
  if (event.kind == StopKind::ToolChange) return;
  if (event.kind == StopKind::Operator) {
    if (has_waited_) return;
    has_waited_ = true;
  }
  EventFilter::on_stop(event);
}

void TargetView::on_miscellaneous(const interpreter::Miscellaneous& event) {
  if (!is_end_code(event.code)) EventFilter::on_miscellaneous(event);
}

}  // namespace dripline::post
