#include <algorithm>
#include <utility>

#include "gateway/interpreter/tnc155/block_end.hpp"
#include "gateway/interpreter/tnc155/block_reader.hpp"
#include "gateway/interpreter/tnc155/plain_reader.hpp"
#include "gateway/interpreter/tnc155/program_keeping.hpp"
#include "gateway/interpreter/tnc155/ranges.hpp"
#include "gateway/interpreter/tnc155/text_layout.hpp"
#include "gateway/interpreter/tnc155/text_search.hpp"

namespace dripline::interpreter::tnc155 {
namespace {

/// A block as it stands in the text.
struct TextBlock {
  const char* begin = nullptr;
  const char* end = nullptr;     ///< without what ends it
  const char* behind = nullptr;  ///< where the next block begins
  std::int64_t number = kNoNumber;
  std::string text() const {
    std::string text;
    for (const char* at = begin; at != end; ++at) text += *at == '\n' || *at == '\r' ? ' ' : *at;
    return text;
  }
};

/// Cuts the text, which ends with a line end, as the readers do, but without reading what the
/// blocks say: one that is wrong can be mended.
std::vector<TextBlock> cut(std::string_view text, Form form) {
  const char* limit = text.data() + text.size();
  const auto skip = [&](const char* at) {
    return form == Form::Iso ? IsoEnd::skip(at, limit) : skip_blanks(at, limit);
  };
  bool is_one_line = false;
  std::vector<TextBlock> blocks;
  for (const char* at = skip(text.data()); at != limit;) {
    TextBlock block;
    block.begin = at;
    block.end = form == Form::Iso ? IsoEnd{true, &is_one_line}(at, limit)
                                  : PlainEnd{&is_one_line}(at, limit);
    block.behind = block.end == limit ? limit : skip(block.end + 1);
    while (block.end != at && is_blank_or_control(block.end[-1])) --block.end;
    blocks.push_back(block);
    at = block.behind;
  }
  return blocks;
}

/// Edits one text; blocks are addressed and numbered as the control does.
class Editor {
 public:
  explicit Editor(std::string_view text)
      : is_line_end_added_(!text.ends_with('\n')),
        text_(std::string(text) + (is_line_end_added_ ? "\n" : "")),
        form_(detect_form(text)),
        blocks_(cut(text_, form_)) {
    layout_.line_end = line_end_of(text);
    const bool has_comma = text.find(',') != std::string_view::npos;
    if (!has_comma && text.find('.') != std::string_view::npos) layout_.decimal_sign = '.';
    take_numbers();
    state_.program.form = form_;
    if (!blocks_.empty()) read_head_block();
  }

  Result<EditedProgram> edit(std::span<const BlockChange> changes) {
    if (form_ == Form::Unknown || blocks_.empty()) {
      return fail(Errc::Syntax, "line 1: neither plain language nor ISO of a TNC");
    }
    std::vector<std::int64_t> numbers;
    for (const TextBlock& block : blocks_) numbers.push_back(block.number);
    auto steps = plan_edit(numbers, changes);
    if (!steps) return fail(steps.error());
    steps_ = std::move(*steps);
    if (auto framed = check_frame(); !framed) return fail(framed.error());
    if (auto numbered = assign_numbers(); !numbered) return fail(numbered.error());
    return write();
  }

 private:
  using Kind = EditStep::Kind;

  /// Plain language counts on where a number is missing; an ISO block without N has none.
  void take_numbers() {
    std::int64_t before = -1;
    for (TextBlock& block : blocks_) {
      const std::int64_t own = read_head({block.begin, block.end}).number;
      is_numbered_ |= own >= 0;
      if (form_ == Form::Iso) {
        block.number = *block.begin == '%' ? 0 : own;
        continue;
      }
      block.number = own >= 0 ? own : before + 1;
      is_consecutive_ &= before < 0 || block.number == before + 1;
      before = block.number;
    }
  }

  void read_head_block() {
    Fault fault;
    const TextBlock& head = blocks_.front();
    if (form_ == Form::Plain) {
      Block block;
      has_head_ = read_plain_block(head.begin, head.end, state_, block, fault) &&
                  block.kind == BlockKind::Begin;
      if (has_head_) note_plain_block(block, state_);
      return;
    }
    IsoBlock block;
    has_head_ = read_iso_block(head.begin, head.end, state_.program, block, fault) &&
                block.program != IsoBlock::kNone && block.has(IsoGroup::Unit);
    if (has_head_ && block.code(IsoGroup::Unit) == 70) state_.program.units = Units::Inch;
  }

  bool is_last_block(const TextBlock& block) const {
    const std::string_view text(block.begin, block.end);
    if (&block == blocks_.data()) return false;
    return text.find(form_ == Form::Plain ? "END PGM" : "%") != std::string_view::npos &&
           &block == &blocks_.back();
  }

  /// The first and the last block name the program: they stay where they are.
  Result<void> check_frame() const {
    for (const EditStep& step : steps_) {
      if (step.kind == Kind::Keep) continue;
      const TextBlock& block = blocks_[step.block];
      const bool is_first = has_head_ && step.block == 0;
      if (step.kind == Kind::Drop && (is_first || is_last_block(block))) {
        return fail(Errc::Syntax, "block {} \"{}\" begins or ends the program: it stays",
                    block.number, block.text());
      }
      if (step.kind == Kind::Enter && is_last_block(block)) {
        return fail(Errc::Syntax, "{}: nothing stands behind the last block, {} \"{}\"",
                    error_row(ErrorCode::MemoryExceeded).text, block.number, block.text());
      }
    }
    return {};
  }

  /// Consecutive numbers stay so, as in the control's memory; others stay as they are, and what is
  /// put in has the number of what it replaces, or finds one between its neighbours.
  Result<void> assign_numbers() {
    numbers_.assign(steps_.size(), kNoNumber);
    if (!is_numbered_) return {};
    if (form_ == Form::Plain && is_consecutive_) return count_on();
    std::int64_t before = 0, freed = kNoNumber;
    for (std::size_t i = 0; i < steps_.size();) {
      const std::int64_t own = blocks_[steps_[i].block].number;
      if (steps_[i].kind == Kind::Drop) {
        freed = own;
      } else if (steps_[i].kind == Kind::Keep) {
        numbers_[i] = own;
        freed = kNoNumber;
      } else if (freed > before) {
        numbers_[i] = std::exchange(freed, kNoNumber);
      } else {
        const auto behind = fill_gap(i, before);
        if (!behind) return fail(behind.error());
        i = *behind - 1;
      }
      before = std::max(before, numbers_[i]);
      ++i;
    }
    return {};
  }

  Result<void> count_on() {
    std::int64_t number = blocks_.front().number;
    for (std::size_t i = 0; i < steps_.size(); ++i) {
      if (steps_[i].kind == Kind::Drop) continue;
      if (number > kMostBlockNumber) {
        return fail(Errc::LimitExceeded, "{}: block numbers end at {}",
                    error_row(ErrorCode::MemoryExceeded).text, kMostBlockNumber);
      }
      numbers_[i] = number++;
    }
    return {};
  }

  /// Numbers the blocks put in from step `first` on; gives the step behind them.
  Result<std::size_t> fill_gap(std::size_t first, std::int64_t before) {
    std::size_t behind = first;
    while (behind < steps_.size() && steps_[behind].kind == Kind::Enter) ++behind;
    const auto count = static_cast<std::int64_t>(behind - first);
    const std::int64_t next = next_number(behind);
    const std::int64_t gap = (next - before) / (count + 1);
    if (gap < 1) {
      return fail(Errc::LimitExceeded,
                  "{} blocks do not find numbers between {} and {}: renumber first", count, before,
                  next);
    }
    const std::int64_t step = std::min<std::int64_t>(gap, kUsualIncrement);
    for (std::size_t i = first; i < behind; ++i) numbers_[i] = before += step;
    return behind;
  }

  /// The first number from a step on that stays, or that what is put in there takes over.
  std::int64_t next_number(std::size_t from) const {
    for (std::size_t i = from; i < steps_.size(); ++i) {
      const bool is_replaced = steps_[i].kind == Kind::Drop && i + 1 < steps_.size() &&
                               steps_[i + 1].kind == Kind::Enter;
      const std::int64_t number = blocks_[steps_[i].block].number;
      if ((steps_[i].kind == Kind::Keep || is_replaced) && number >= 0) return number;
    }
    return kMostBlockNumber + 1;
  }

  Result<EditedProgram> write() {
    EditedProgram edited;
    edited.text.assign(static_cast<const char*>(text_.data()), blocks_.front().begin);
    for (std::size_t i = 0; i < steps_.size(); ++i) {
      const EditStep& step = steps_[i];
      if (step.kind == Kind::Drop) {
        edited.changes.push_back({'-', blocks_[step.block].text()});
      } else if (step.kind == Kind::Keep) {
        keep(blocks_[step.block], numbers_[i], edited);
      } else {
        std::string block;
        if (auto entered = enter(step.entered, numbers_[i], block); !entered) {
          return fail(entered.error());
        }
        close_line(edited.text);
        edited.text += block;
        edited.changes.push_back({'+', block.substr(0, block.size() - layout_.line_end.size())});
      }
    }
    if (is_line_end_added_ && steps_.back().kind == Kind::Keep) edited.text.pop_back();
    return edited;
  }

  void keep(const TextBlock& block, std::int64_t number, EditedProgram& edited) const {
    close_line(edited.text);
    const bool has_digits = is_decimal(*block.begin);
    const char* at = block.begin;
    if (form_ == Form::Plain && has_digits && number >= 0 && number != block.number) {
      while (is_decimal(*at)) ++at;
      edited.text += std::to_string(number);
      ++edited.renumbered;
    }
    edited.text.append(at, block.behind);
  }

  void close_line(std::string& text) const {
    if (!text.empty() && text.back() != '\n') text += layout_.line_end;
  }

  /// Reads what was typed as the control does, and writes it in the control's layout.
  Result<void> enter(std::string_view typed, std::int64_t number, std::string& out) const {
    const std::string line = std::string(typed) + "\n";
    const char* begin = skip_blanks(line.data(), line.data() + line.size());
    const char* end = line.data() + typed.size();
    if (form_ == Form::Iso) {
      while (end != begin && (is_blank_or_control(end[-1]) || end[-1] == '*')) --end;
    }
    return form_ == Form::Plain ? enter_plain({begin, end}, number, out)
                                : enter_iso({begin, end}, number, out);
  }

  Result<void> enter_plain(std::string_view typed, std::int64_t number, std::string& out) const {
    Fault fault;
    Block block;
    if (!read_plain_block(typed.data(), typed.data() + typed.size(), state_, block, fault)) {
      return refused(typed, fault);
    }
    if (block.kind == BlockKind::Begin || block.kind == BlockKind::End) return frame(typed);
    block.number = static_cast<std::int32_t>(number);
    write_plain_block(block, state_.program.units, layout_, out);
    return {};
  }

  /// An N that was typed stays: numbers of ISO blocks are the programmer's.
  Result<void> enter_iso(std::string_view typed, std::int64_t number, std::string& out) const {
    Fault fault;
    IsoBlock block;
    const std::string text = std::string(typed) + "\n";
    if (!read_iso_block(text.data(), text.data() + typed.size(), state_.program, block, fault)) {
      return refused(typed, fault);
    }
    if (block.program != IsoBlock::kNone && block.has(IsoGroup::Unit)) return frame(typed);
    if (block.number == IsoBlock::kNone) block.number = static_cast<std::int32_t>(number);
    write_iso_block(block, layout_, out);
    return {};
  }

  static tl::unexpected<Error> refused(std::string_view typed, const Fault& fault) {
    return fail(Errc::Syntax, "\"{}\", column {}: {}", typed, std::max(fault.column, 1u),
                fault.text());
  }
  static tl::unexpected<Error> frame(std::string_view typed) {
    return fail(Errc::Syntax, "\"{}\": a program begins and ends once", typed);
  }

  static constexpr std::int64_t kUsualIncrement = 10;

  bool is_line_end_added_;
  std::string text_;  ///< ends with a line end
  Form form_;
  std::vector<TextBlock> blocks_;
  TextLayout layout_;
  ReadingState state_;
  bool has_head_ = false;
  bool is_numbered_ = false;
  bool is_consecutive_ = true;
  std::vector<EditStep> steps_;
  std::vector<std::int64_t> numbers_;  ///< by step: the number in the result
};

}  // namespace

Result<EditedProgram> edit_program(std::string_view text, std::span<const BlockChange> changes) {
  return Editor(text).edit(changes);
}

}  // namespace dripline::interpreter::tnc155
