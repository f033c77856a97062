#include "gateway/app/run_texts.hpp"

#include <map>

namespace dripline::gateway {
namespace {

std::map<char, double> axes_of(const interpreter::Position& position) {
  std::map<char, double> axes;
  for (const interpreter::Axis axis : interpreter::kAllAxes) {
    if (position.has(axis)) axes[interpreter::letter(axis)] = position.raw(axis);
  }
  return axes;
}

/// Bytes of the UTF-8 sequence at the front of `text`, 0 when it is none.
std::size_t sequence_length(std::string_view text) {
  const auto at = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = at(0);
  const std::size_t length = lead < 0x80                    ? 1
                             : lead >= 0xC2 && lead <= 0xDF ? 2
                             : lead >= 0xE0 && lead <= 0xEF ? 3
                             : lead >= 0xF0 && lead <= 0xF4 ? 4
                                                            : 0;
  if (length == 0 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((at(i) & 0xC0) != 0x80) return 0;
  }
  if (lead == 0xE0 && at(1) < 0xA0) return 0;  // overlong
  if (lead == 0xED && at(1) > 0x9F) return 0;  // surrogate
  if (lead == 0xF0 && at(1) < 0x90) return 0;  // overlong
  if (lead == 0xF4 && at(1) > 0x8F) return 0;  // beyond U+10FFFF
  return length;
}

}  // namespace

dds::ProbeText probe_text(const interpreter::Probe& probe) {
  dds::ProbeText text;
  text.to = axes_of(probe.to);
  text.until = probe.until == interpreter::ProbeUntil::Contact ? "contact" : "release";
  if (probe.result) {
    text.tripped = probe.result->tripped;
    text.at = axes_of(probe.result->at);
  }
  return text;
}

dds::AlarmText diagnostic_text(const interpreter::Diagnostic& diagnostic) {
  return {std::string(diagnostic.id), valid_text(diagnostic.text, kMaxReason)};
}

std::string_view to_text(interpreter::StopKind kind) {
  switch (kind) {
    case interpreter::StopKind::Program:
      return "program stop";
    case interpreter::StopKind::Optional:
      return "optional stop";
    case interpreter::StopKind::ToolChange:
      return "tool change";
    case interpreter::StopKind::Operator:
      return "operator stop";
  }
  return "stop";
}

std::string valid_text(std::string_view bytes, std::size_t max_bytes) {
  static constexpr std::string_view kReplacement = "\xEF\xBF\xBD";
  std::string text;
  while (!bytes.empty()) {
    const std::size_t length = sequence_length(bytes);
    const std::string_view piece = length == 0 ? kReplacement : bytes.substr(0, length);
    if (text.size() + piece.size() > max_bytes) break;
    text.append(piece);
    bytes.remove_prefix(length == 0 ? 1 : length);
  }
  return text;
}

std::string_view to_text(interpreter::OutputDevice device) {
  switch (device) {
    case interpreter::OutputDevice::File:
      return "file";
    case interpreter::OutputDevice::Port1:
      return "port1";
    case interpreter::OutputDevice::Port2:
      return "port2";
    case interpreter::OutputDevice::Screen:
      return "screen";
    case interpreter::OutputDevice::Printer:
      return "printer";
  }
  return "file";
}

}  // namespace dripline::gateway
