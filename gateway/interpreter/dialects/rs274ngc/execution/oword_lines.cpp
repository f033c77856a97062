#include <array>

#include "gateway/interpreter/dialects/rs274ngc/execution/flow.hpp"
#include "gateway/interpreter/dialects/rs274ngc/reading/words.hpp"

/// Flow: which function executes the O word of a line.
namespace dripline::interpreter::rs274ngc {

Flow::Handler Flow::handler_of(Oword word) {
  struct Row {
    Oword word;
    Handler handler;
  };
  static constexpr std::array kRows{
      Row{Oword::Sub, &Flow::begin_sub},      Row{Oword::EndSub, &Flow::end_sub},
      Row{Oword::Return, &Flow::leave_sub},   Row{Oword::Call, &Flow::call},
      Row{Oword::If, &Flow::begin_if},        Row{Oword::ElseIf, &Flow::next_branch},
      Row{Oword::Else, &Flow::next_branch},   Row{Oword::EndIf, &Flow::end_if},
      Row{Oword::While, &Flow::begin_while},  Row{Oword::EndWhile, &Flow::end_loop},
      Row{Oword::Do, &Flow::begin_do},        Row{Oword::Repeat, &Flow::begin_repeat},
      Row{Oword::EndRepeat, &Flow::end_loop}, Row{Oword::Break, &Flow::leave_loop},
      Row{Oword::Continue, &Flow::leave_loop}};
  for (const Row& row : kRows) {
    if (row.word == word) return row.handler;
  }
  return nullptr;
}

/// A label that is computed may be another one at each pass.
bool Flow::read_head(const char* at, OwordHead& head, Handler& handler) {
  KnownHead& known = heads_[run_.here.offset % kKnownHeads];
  if (known.after != 0 && known.offset == run_.here.offset && known.program == run_.here.program) {
    head = {known.word, known.label, run_.line_begin + known.after};
    handler = known.handler;
    return true;
  }
  if (!read_oword(run_, at, head)) return false;
  handler = handler_of(head.word);
  const char label = *skip_blanks(at + 1);
  if (label == '#' || label == '[') return true;
  known = {.offset = run_.here.offset,
           .program = run_.here.program,
           .after = static_cast<std::uint32_t>(head.after - run_.line_begin),
           .label = head.label,
           .word = head.word,
           .handler = handler};
  return true;
}

bool Flow::execute(const char* at) {
  OwordHead head;
  Handler handler = nullptr;
  if (!read_head(at, head, handler)) return false;
  if (head.word == Oword::Alone) return end_of_oword(run_, head.after);
  if (handler == nullptr) return refuse(ErrorCode::OwordUnknown, head);
  return (this->*handler)(head);
}

}  // namespace dripline::interpreter::rs274ngc
