#include "gateway/interpreter/dialects/centurion/start/start_notes.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "gateway/interpreter/dialects/centurion/run.hpp"

namespace dripline::interpreter::centurion {
namespace {

/// Whether the cell outlives a program (retained_memory.cpp).
bool is_kept(int cell) {
  return cell < kUserParameters || cell >= kFirstDataParameter;
}

void append(std::string& text, const std::string& part) {
  if (!text.empty()) text += ", ";
  text += part;
}

}  // namespace

void StartNotes::read_cell(int cell) {
  Use& use = uses[static_cast<std::size_t>(cell)];
  if (use == Use::None) use = Use::Read;
}

void StartNotes::set_cell(int cell) {
  Use& use = uses[static_cast<std::size_t>(cell)];
  if (use == Use::None) use = Use::Set;
  if (use == Use::Read && is_kept(cell)) use = Use::Lost;
}

void StartNotes::withhold(std::uint16_t code, bool state, std::uint64_t line) {
  std::erase_if(withheld, [code](const Withheld& each) { return each.code == code; });
  if (withheld.size() == kMaxWithheld) withheld.erase(withheld.begin());
  withheld.push_back({code, state, line});
}

void note_table_set(Run& run, int parameter) {
  const ModalState& state = run.state;
  const bool is_in_use =
      (state.moved_axes | state.searched_axes) != 0 || !(state.floating_zero == Point{});
  if (is_in_use) run.start.note_read(parameter);
  run.start.note_set(parameter);
}

std::string lost_memory_text(const Run& run) {
  constexpr std::size_t kMaxNames = 8;
  std::string text;
  std::size_t lost = 0;
  const auto& uses = run.start.uses;
  for (std::size_t cell = 0; cell < uses.size(); ++cell) {
    if (uses[cell] != StartNotes::Use::Lost || ++lost > kMaxNames) continue;
    const int number = static_cast<int>(cell);
    const bool is_byte = number >= kParameterCount;
    append(text,
           is_byte ? fmt::format("PB{}", number - kParameterCount) : fmt::format("P{}", number));
  }
  if (lost > kMaxNames) text += fmt::format(" and {} more", lost - kMaxNames);
  return text;
}

std::string withheld_text(const StartNotes& notes) {
  std::string text;
  for (const auto& [code, state, line] : notes.withheld) {
    const bool is_of_x = code >= StartNotes::kOutputOfX;
    if (code < StartNotes::kOutputOfZ) {
      append(text, fmt::format("M{:02} (line {})", code, line));
    } else {
      const int first = is_of_x ? StartNotes::kOutputOfX : StartNotes::kOutputOfZ;
      append(text, fmt::format("output {} of {} {} (line {})", code - first, is_of_x ? 'X' : 'Z',
                               state ? "on" : "off", line));
    }
  }
  return text;
}

std::string open_flow_text(const Run& run) {
  const ModalState& state = run.state;
  std::string text;
  for (const CallFrame& frame : state.calls)
    append(text, fmt::format("the program called before line {}", frame.back.line));
  for (const GosubFrame& frame : state.gosubs)
    append(text, fmt::format("the subroutine called before line {}", frame.back.line));
  for (const LoopFrame& frame : state.loops)
    append(text, fmt::format("the WHILE of line {}", frame.head.line));
  return text;
}

}  // namespace dripline::interpreter::centurion
