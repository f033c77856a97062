#include "gateway/app/run/run_texts.hpp"

#include <fmt/format.h>
#include <array>
#include <map>

#include "gateway/interpreter/core/event.hpp"
#include "protocol/base/utf8.hpp"

namespace dripline::gateway {
namespace {

std::map<char, double> axes_of(const interpreter::Position& position) {
  std::map<char, double> axes;
  for (const interpreter::Axis axis : interpreter::kAllAxes) {
    if (position.has(axis)) axes[interpreter::letter(axis)] = position.raw(axis);
  }
  return axes;
}

}  // namespace

dds::ProbeText probe_text(const interpreter::Probe& probe) {
  dds::ProbeText text;
  text.to = axes_of(probe.to);
  text.until = interpreter::word_of(probe.until);
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
  constexpr std::array<std::string_view, 4> kTexts{"program stop", "optional stop", "tool change",
                                                   "operator stop"};
  return kTexts[static_cast<std::size_t>(kind)];
}

std::string work_system_text(const interpreter::ActiveModes& modes) {
  if (modes.work_system == 0) return {};
  std::string text = fmt::format("G{}", modes.work_system / 10);
  if (modes.work_system % 10 != 0) text += fmt::format(".{}", modes.work_system % 10);
  if (modes.work_page != 0) text += fmt::format(" P{}", modes.work_page);
  return text;
}

std::string valid_text(std::string_view bytes, std::size_t max_bytes) {
  static constexpr std::string_view kReplacement = "\xEF\xBF\xBD";
  std::string text;
  while (!bytes.empty()) {
    const std::size_t length = utf8_length(bytes);
    const std::string_view piece = length == 0 ? kReplacement : bytes.substr(0, length);
    if (text.size() + piece.size() > max_bytes) break;
    text.append(piece);
    bytes.remove_prefix(length == 0 ? 1 : length);
  }
  return text;
}

}  // namespace dripline::gateway
