#include "gateway/interpreter/core/event_words.hpp"

namespace dripline::interpreter {

std::string_view word_of(Units units) {
  return units == Units::Inch ? "in" : "mm";
}
std::string_view word_of(Turn turn) {
  return turn == Turn::Clockwise ? "cw" : "ccw";
}
std::string_view word_of(ProbeUntil until) {
  return until == ProbeUntil::Contact ? "contact" : "release";
}

std::string_view word_of(SpindleState state) {
  switch (state) {
    case SpindleState::Clockwise:
      return "cw";
    case SpindleState::Counterclockwise:
      return "ccw";
    case SpindleState::Oriented:
      return "oriented";
    case SpindleState::Off:
      break;
  }
  return "off";
}

std::string_view word_of(StopKind kind) {
  switch (kind) {
    case StopKind::Optional:
      return "optional";
    case StopKind::ToolChange:
      return "tool_change";
    case StopKind::Operator:
      return "operator";
    case StopKind::Program:
      break;
  }
  return "program";
}

std::string_view word_of(OutputDevice device) {
  switch (device) {
    case OutputDevice::Port1:
      return "port1";
    case OutputDevice::Port2:
      return "port2";
    case OutputDevice::Screen:
      return "screen";
    case OutputDevice::Printer:
      return "printer";
    case OutputDevice::File:
      break;
  }
  return "file";
}

std::string_view word_of(Feed::Per per) {
  switch (per) {
    case Feed::Per::Revolution:
      return "rev";
    case Feed::Per::Move:
      return "move";
    case Feed::Per::Minute:
      break;
  }
  return "min";
}

std::string_view word_of(Plane plane) {
  switch (plane) {
    case Plane::ZX:
      return "ZX";
    case Plane::YZ:
      return "YZ";
    case Plane::XY:
      break;
  }
  return "XY";
}

}  // namespace dripline::interpreter
