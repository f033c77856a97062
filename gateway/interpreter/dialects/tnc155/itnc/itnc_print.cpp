#include <fmt/core.h>
#include <algorithm>
#include <utility>

#include "gateway/interpreter/dialects/tnc155/itnc/itnc_execution.hpp"
#include "gateway/interpreter/dialects/tnc155/itnc/print_mask.hpp"
#include "protocol/base/decimal.hpp"

/// FN 15: PRINT, values as they are. FN 16: F-PRINT mask / target. The mask is a text of the
/// program store, read whole before anything is put out; the block waits for it.
namespace dripline::interpreter::tnc155::itnc {
namespace {

constexpr std::size_t kLargestMask = 32 * 1024;

bool wait_for_text(Run& run) {
  run.pause = Pause::ForText;
  return false;
}

bool find_mask(Run& run, const std::string& name) {
  if (run.mask) return true;
  const ProgramLookup lookup = run.reader.find(name);
  if (lookup.state == ProgramLookup::State::NotYet) return wait_for_text(run);
  if (lookup.state == ProgramLookup::State::NotFound) {
    return run.fail_as(ErrorCode::ProgramUnavailable,
                       fmt::format("FN 16: the program store has no mask {}", name));
  }
  run.mask.emplace(MaskText{lookup.program, {}, false});
  return true;
}

bool read_mask(Run& run, const std::string& name) {
  if (!find_mask(run, name)) return false;
  MaskText& mask = *run.mask;
  while (!mask.is_whole) {
    const TextWindow window = run.source.fetch(mask.program, mask.text.size(), 1);
    run.reader.drop_window();
    if (window.state == TextWindow::State::NotYet) return wait_for_text(run);
    if (window.state == TextWindow::State::Failed) {
      return run.fail(ErrorCode::TextFailed, fmt::format("mask {}: {}", name, window.reason));
    }
    mask.text += window.text;
    mask.is_whole = window.reaches_end || window.text.empty();
    if (mask.text.size() > kLargestMask) {
      return run.fail(ErrorCode::MemoryExceeded,
                      fmt::format("mask {} has more than {} characters", name, kLargestMask));
    }
  }
  return true;
}

/// What a target is called and where it goes.
struct PrintTarget {
  OutputDevice device = OutputDevice::File;
  std::string file;
};

PrintTarget target_of(const std::string& text) {
  if (text.starts_with("SCREEN:")) return {OutputDevice::Screen, {}};
  if (text.starts_with("RS232:")) return {OutputDevice::Port1, {}};
  if (text.starts_with("RS422:")) return {OutputDevice::Port2, {}};
  return {OutputDevice::File, text.substr(text.find_last_of("\\/:") + 1)};
}

/// As a control has written it: a sign, at most four decimals without zeros at the end, and a
/// comma.
std::string printed_value(double value) {
  std::string text = decimal_text(value, 4);
  std::ranges::replace(text, '.', ',');
  return text.starts_with('-') ? text : "+" + text;
}

/// FN 15, to the file that a control with its printing set to FILE has for it.
void print_values(Run& run) {
  std::string line;
  for (const std::int32_t parameter : run.parts.itnc.ids) {
    if (!line.empty()) line += "  ";
    line += printed_value(run.state.q[static_cast<std::size_t>(parameter)]);
  }
  EventSink& events = run.events();
  events.on_open({run.origin, OutputDevice::File, "%FN15RUN.A"});
  events.on_output({run.origin, OutputDevice::File, line});
  events.on_close({run.origin, OutputDevice::File});
}

}  // namespace

bool print(Run& run, const Block&) {
  if (run.state.start.is_searching) return true;  // the run that was interrupted has put it out
  if (!run.parts.itnc.ids.empty()) {
    print_values(run);
    return true;
  }
  const std::string& name = run.parts.itnc.name;
  if (!read_mask(run, name)) return false;
  std::optional<LocalTime> now;
  if (run.answer) now = std::get<LocalTime>(*run.answer);
  const auto printed = print_mask(run.mask->text, run.state.q, now);
  if (!printed) {
    run.mask.reset();
    return run.fail(ErrorCode::NotSupported,
                    fmt::format("FN 16: {}, {}", name, printed.error().what));
  }
  if (printed->needs_time) return run.ask(TimeQuestion{});
  run.mask.reset();
  const PrintTarget target = target_of(run.parts.itnc.target);
  EventSink& events = run.events();
  if (!target.file.empty()) events.on_open({run.origin, target.device, target.file});
  for (const std::string& line : printed->lines)
    events.on_output({run.origin, target.device, line});
  if (!target.file.empty()) events.on_close({run.origin, target.device});
  return true;
}

}  // namespace dripline::interpreter::tnc155::itnc
