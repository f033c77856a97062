#include "clients/tools/program_editing/tnc155/cut_program.hpp"

#include "gateway/interpreter/dialects/tnc155/reading/block_end.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/block_reader.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/plain_reader.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/text_search.hpp"

namespace dripline::program_editing {

using namespace interpreter;
using namespace interpreter::tnc155;
using namespace tnc_conversion;

std::string TextBlock::text() const {
  std::string text;
  for (const char* at = begin; at != end; ++at) text += *at == '\n' || *at == '\r' ? ' ' : *at;
  return text;
}

CutProgram::CutProgram(std::string_view text)
    : is_line_end_added_(!text.ends_with('\n')),
      text_(std::string(text) + (is_line_end_added_ ? "\n" : "")) {
  state_.program.form = detect_form(text);
  layout_.line_end = line_end_of(text);
  const bool has_comma = text.find(',') != std::string_view::npos;
  if (!has_comma && text.find('.') != std::string_view::npos) layout_.decimal_sign = '.';
  cut();
  take_numbers();
  if (!blocks_.empty()) read_head_block();
}

Result<void> CutProgram::check() const {
  if (form() != Form::Unknown && !blocks_.empty()) return {};
  return fail(Errc::Syntax, "line 1: neither plain language nor ISO of a TNC");
}

std::vector<std::int64_t> CutProgram::numbers() const {
  std::vector<std::int64_t> numbers;
  for (const TextBlock& block : blocks_) numbers.push_back(block.number);
  return numbers;
}

void CutProgram::cut() {
  const char* limit = text_.data() + text_.size();
  const auto skip = [&](const char* at) {
    return form() == Form::Iso ? IsoEnd::skip(at, limit) : skip_blanks(at, limit);
  };
  bool is_one_line = false;
  for (const char* at = skip(text_.data()); at != limit;) {
    TextBlock block;
    block.begin = at;
    block.end = form() == Form::Iso ? IsoEnd{true, &is_one_line}(at, limit)
                                    : PlainEnd{&is_one_line}(at, limit);
    block.after = block.end == limit ? limit : skip(block.end + 1);
    block.stop = block.end == limit ? limit - 1 : block.end;  // the text ends with a line end
    while (block.end != at && is_blank_or_control(block.end[-1])) --block.end;
    blocks_.push_back(block);
    at = block.after;
  }
}

/// A plain-language block without a number has the next one; an ISO block without N has none.
void CutProgram::take_numbers() {
  std::int64_t before = -1;
  for (TextBlock& block : blocks_) {
    const std::int64_t own = read_head({block.begin, block.end}, form()).number;
    is_numbered_ |= own >= 0;
    if (form() == Form::Iso) {
      block.number = *block.begin == '%' ? 0 : own;
      continue;
    }
    block.number = own >= 0 ? own : before + 1;
    is_consecutive_ &= before < 0 || block.number == before + 1;
    before = block.number;
  }
}

void CutProgram::read_head_block() {
  Fault fault;
  const TextBlock& head = blocks_.front();
  if (form() == Form::Plain) {
    Block block;
    has_head_ = read_plain_block(head.begin, head.stop, state_, block, fault) &&
                block.kind == BlockKind::Begin;
    if (has_head_) note_plain_block(block, state_);
    return;
  }
  IsoBlock block;
  has_head_ = read_iso_block(head.begin, head.stop, state_.program, block, fault) &&
              block.program != IsoBlock::kNone && block.has(IsoGroup::Unit);
  if (has_head_ && block.code(IsoGroup::Unit) == 70) state_.program.units = Units::Inch;
}

}  // namespace dripline::program_editing
