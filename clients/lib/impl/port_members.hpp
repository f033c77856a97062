#pragma once

#include "clients/lib/api_types.hpp"
#include "clients/lib/impl/server_members.hpp"

/// The part of api_members.hpp, which ends the macros, about serial ports and their transfers.
namespace dripline::client {

template <class V>
void members(V& v, Is<Transfer> auto& x) {
  DRIPLINE_MEMBERS(id, programs, size, sent, state, reason);
  v.later("at_most", x.at_most);
  v.later("began", x.began);
  v.later("ended", x.ended);
}

template <class V>
void members(V& v, Is<Port::Line> auto& x) {
  DRIPLINE_MEMBERS(phase, stopped, stopping, waiting_for, without_limit);
}

template <class V>
void members(V& v, Is<Port::Request> auto& x) {
  DRIPLINE_MEMBERS(since, program, answer);
}

template <class V>
void members(V& v, Is<Port> auto& x) {
  DRIPLINE_MEMBERS(name, machine, address);
  v("template", x.line_template);
  DRIPLINE_MEMBERS(settings, rules, enabled, effective, open, fault, line, run, transfer, sent,
                   received, waiting_since);
  v.later("request", x.request);
  v.later("reception", x.reception);
  v.later("sends_at_once", x.sends_at_once);
}

template <class V>
void members(V& v, Is<Traffic> auto& x) {
  DRIPLINE_MEMBERS(port, time, what, bytes, text);
}

template <class V>
void members(V& v, Is<PortTest> auto& x) {
  DRIPLINE_MEMBERS(passed, findings);
}

template <class V>
void members(V& v, Is<RuleVerdict> auto& x) {
  DRIPLINE_MEMBERS(rule, action, argument, why);
}

template <class V>
void members(V& v, Is<PortTemplate> auto& x) {
  DRIPLINE_MEMBERS(name, title, control, settings);
}

template <class V>
void members(V& v, Is<PortSetting> auto& x) {
  DRIPLINE_MEMBERS(key, type, text);
  v("default", x.preset);
}

template <class V>
void members(V& v, Is<PortTemplates> auto& x) {
  DRIPLINE_MEMBERS(templates, settings);
}

}  // namespace dripline::client
