#include <algorithm>
#include <utility>

#include "clients/tools/program_editing/program_edit.hpp"
#include "clients/tools/program_editing/tnc155/cut_program.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/block_end.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/plain_reader.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/ranges.hpp"

namespace dripline::program_editing {

using namespace interpreter;
using namespace interpreter::tnc155;
using namespace tnc_conversion;

namespace {

/// Edits one text; blocks are addressed and numbered as the control does.
class Editor {
 public:
  explicit Editor(std::string_view text) : program_(text), blocks_(program_.blocks()) {}

  Result<EditedProgram> edit(std::span<const BlockChange> changes) {
    if (auto checked = program_.check(); !checked) return fail(checked.error());
    auto steps = plan_edit(program_.numbers(), changes);
    if (!steps) return fail(steps.error());
    steps_ = std::move(*steps);
    if (auto framed = check_frame(); !framed) return fail(framed.error());
    if (auto numbered = assign_numbers(); !numbered) return fail(numbered.error());
    return write();
  }

 private:
  using Kind = EditStep::Kind;

  bool is_last_block(const TextBlock& block) const {
    const std::string_view text(block.begin, block.end);
    if (&block == blocks_.data()) return false;
    return text.find(program_.form() == Form::Plain ? "END PGM" : "%") != std::string_view::npos &&
           &block == &blocks_.back();
  }

  /// The first and the last block name the program: they stay where they are.
  Result<void> check_frame() const {
    for (const EditStep& step : steps_) {
      if (step.kind == Kind::Keep) continue;
      const TextBlock& block = blocks_[step.block];
      const bool is_first = program_.has_head() && step.block == 0;
      if (step.kind == Kind::Drop && (is_first || is_last_block(block))) {
        return fail(Errc::Syntax, "block {} \"{}\" begins or ends the program: it stays",
                    block.number, block.text());
      }
      if (step.kind == Kind::Enter && is_last_block(block)) {
        return fail(Errc::Syntax, "{}: nothing may follow the last block, {} \"{}\"",
                    error_row(ErrorCode::MemoryExceeded).text, block.number, block.text());
      }
    }
    return {};
  }

  /// Consecutive numbers stay so, as in the control's memory; others stay as they are, and what is
  /// put in has the number of what it replaces, or finds one between its neighbors.
  Result<void> assign_numbers() {
    numbers_.assign(steps_.size(), kNoNumber);
    if (!program_.is_numbered()) return {};
    if (program_.form() == Form::Plain && program_.is_consecutive()) return count_on();
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
        const auto after = fill_gap(i, before);
        if (!after) return fail(after.error());
        i = *after - 1;
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
      if (number > kMaxBlockNumber) {
        return fail(Errc::LimitExceeded, "{}: block numbers end at {}",
                    error_row(ErrorCode::MemoryExceeded).text, kMaxBlockNumber);
      }
      numbers_[i] = number++;
    }
    return {};
  }

  /// Numbers the blocks put in from step `first` on; gives the step after them.
  Result<std::size_t> fill_gap(std::size_t first, std::int64_t before) {
    std::size_t after = first;
    while (after < steps_.size() && steps_[after].kind == Kind::Enter) ++after;
    const auto count = static_cast<std::int64_t>(after - first);
    const std::int64_t next = next_number(after);
    const std::int64_t gap = (next - before) / (count + 1);
    if (gap < 1) {
      return fail(Errc::LimitExceeded,
                  "{} blocks do not fit between block numbers {} and {}: renumber first", count,
                  before, next);
    }
    const std::int64_t step = std::min<std::int64_t>(gap, kUsualIncrement);
    for (std::size_t i = first; i < after; ++i) numbers_[i] = before += step;
    return after;
  }

  /// The first number from a step on that stays, or that what is put in there takes over.
  std::int64_t next_number(std::size_t from) const {
    for (std::size_t i = from; i < steps_.size(); ++i) {
      const bool is_replaced = steps_[i].kind == Kind::Drop && i + 1 < steps_.size() &&
                               steps_[i + 1].kind == Kind::Enter;
      const std::int64_t number = blocks_[steps_[i].block].number;
      if ((steps_[i].kind == Kind::Keep || is_replaced) && number >= 0) return number;
    }
    return kMaxBlockNumber + 1;
  }

  Result<EditedProgram> write() {
    EditedProgram edited;
    edited.text.assign(static_cast<const char*>(program_.text().data()), blocks_.front().begin);
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
        edited.changes.push_back(
            {'+', block.substr(0, block.size() - program_.layout().line_end.size())});
      }
    }
    if (program_.is_line_end_added() && steps_.back().kind == Kind::Keep) edited.text.pop_back();
    return edited;
  }

  void keep(const TextBlock& block, std::int64_t number, EditedProgram& edited) const {
    close_line(edited.text);
    const bool has_digits = is_decimal(*block.begin);
    const char* at = block.begin;
    if (program_.form() == Form::Plain && has_digits && number >= 0 && number != block.number) {
      while (is_decimal(*at)) ++at;
      edited.text += std::to_string(number);
      ++edited.renumbered;
    }
    edited.text.append(at, block.after);
  }

  void close_line(std::string& text) const {
    if (!text.empty() && text.back() != '\n') text += program_.layout().line_end;
  }

  /// Reads what was typed as the control does, and writes it in the control's layout.
  Result<void> enter(std::string_view typed, std::int64_t number, std::string& out) const {
    const std::string line = std::string(typed) + "\n";
    const char* begin = skip_blanks(line.data(), line.data() + line.size());
    const char* end = line.data() + typed.size();
    if (program_.form() == Form::Iso) {
      while (end != begin && (is_blank_or_control(end[-1]) || end[-1] == '*')) --end;
    }
    return program_.form() == Form::Plain ? enter_plain({begin, end}, number, out)
                                          : enter_iso({begin, end}, number, out);
  }

  Result<void> enter_plain(std::string_view typed, std::int64_t number, std::string& out) const {
    Fault fault;
    Block block;
    if (!read_plain_block(typed.data(), typed.data() + typed.size(), program_.state(), block,
                          fault)) {
      return refused(typed, fault);
    }
    if (block.kind == BlockKind::Begin || block.kind == BlockKind::End) return frame(typed);
    block.number = static_cast<std::int32_t>(number);
    write_plain_block(block, program_.state().program.units, program_.layout(), out);
    return {};
  }

  /// An N that was typed stays: numbers of ISO blocks are the programmer's.
  Result<void> enter_iso(std::string_view typed, std::int64_t number, std::string& out) const {
    Fault fault;
    IsoBlock block;
    const std::string text = std::string(typed) + "\n";
    if (!read_iso_block(text.data(), text.data() + typed.size(), program_.state().program, block,
                        fault)) {
      return refused(typed, fault);
    }
    if (block.program != IsoBlock::kNone && block.has(IsoGroup::Unit)) return frame(typed);
    if (block.number == IsoBlock::kNone) block.number = static_cast<std::int32_t>(number);
    write_iso_block(block, program_.layout(), out);
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

  CutProgram program_;
  std::span<const TextBlock> blocks_;  ///< its
  std::vector<EditStep> steps_;
  std::vector<std::int64_t> numbers_;  ///< by step: the number in the result
};

}  // namespace

/// What is put in elsewhere gets a number there.
Result<std::string> text_of_blocks(std::string_view text, std::int64_t first, std::int64_t last) {
  const CutProgram program(text);
  if (auto checked = program.check(); !checked) return fail(checked.error());
  const auto range = find_blocks(program.numbers(), first, last);
  if (!range) return fail(range.error());
  std::string found;
  for (std::size_t i = range->first; i <= range->second; ++i) {
    const std::string block = program.blocks()[i].text();
    std::string_view words = block;
    if (program.form() == Form::Iso && words.starts_with('N')) words.remove_prefix(1);
    const bool is_numbered = !words.empty() && is_decimal(words.front());
    while (is_numbered && !words.empty() && is_decimal(words.front())) words.remove_prefix(1);
    found.append(is_numbered ? words : std::string_view(block)).append("\n");
  }
  return found;
}

Result<EditedProgram> edit_program(std::string_view text, std::span<const BlockChange> changes) {
  return Editor(text).edit(changes);
}

}  // namespace dripline::program_editing
