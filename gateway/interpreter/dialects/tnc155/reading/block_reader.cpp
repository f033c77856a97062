#include "gateway/interpreter/dialects/tnc155/reading/block_reader.hpp"

#include <fmt/format.h>
#include <string_view>
#include <utility>

#include <algorithm>

#include "gateway/interpreter/dialects/tnc155/itnc/itnc_end.hpp"
#include "gateway/interpreter/dialects/tnc155/itnc/itnc_reader.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/block_end.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/plain_reader.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/word_check.hpp"

namespace dripline::interpreter::tnc155 {
namespace {

using WindowState = language::LineWindow::State;

/// LF, and CR without LF after it.
std::uint64_t line_ends_in(const char* at, const char* end) {
  std::uint64_t lines = 0;
  for (; at != end; ++at) {
    lines += *at == '\n' || (*at == '\r' && (at + 1 == end || at[1] != '\n')) ? 1 : 0;
  }
  return lines;
}

/// Block skip: a slash before the words, or before the number. Not of blocks that a reader refuses
/// with it: what their absence means is not known.
bool is_skipped(const char* at, const char* end) {
  const auto skip = [&] {
    while (at != end && (is_decimal(*at) || *at == ' ' || *at == '\t')) ++at;
  };
  skip();
  if (at == end || *at != '/') return false;
  ++at;
  skip();
  const std::string_view words(at, end);
  return !words.starts_with("LBL") && !words.starts_with("BEGIN") && !words.starts_with("END");
}

/// The end of the first line that is not blank.
struct FirstLineEnd {
  const char* operator()(const char* at, const char* limit) const {
    const char* begin = skip_blanks(at, limit);
    while (begin != limit && *begin != '\n' && *begin != '\r') ++begin;
    return begin;
  }
};

}  // namespace

BlockReader::BlockReader(ProgramSource& source, ReaderOptions options)
    : source_(&source), options_(options), window_(source, kLongestBlock) {}

ReadState BlockReader::next(ReadingState& state, BlockParts& parts) {
  if (!std::exchange(is_peeked_, false)) {
    if (const ReadState loaded = load(state); loaded != ReadState::Ready) return loaded;
  }
  if (!read(state, parts)) return complain();
  move_on();
  return ReadState::Ready;
}

ReadState BlockReader::peek(const ReadingState& state, std::string_view& next) {
  ReadingState tried;  // the form is all that loading looks at, and may find out
  tried.program.form = state.program.form;
  const ReadState loaded = load(tried);
  is_peeked_ = loaded == ReadState::Ready;
  next = is_peeked_ ? text() : std::string_view();
  return loaded;
}

bool BlockReader::read_peeked(ReadingState state, BlockParts& parts) {
  const TextPlace before = block_place_;
  const bool is_read = read(state, parts);
  block_place_ = before;
  return is_read;
}

ReadState BlockReader::load(ReadingState& state) {
  WindowState loaded = WindowState::Ready;
  if (options_.is_itnc) [[unlikely]]
    return load_later(state);
  switch (state.program.form) {
    case Form::Plain:
      loaded = window_.load(place_.program, place_.offset, PlainEnd{&is_one_line_});
      break;
    case Form::Iso:
      loaded = window_.load(place_.program, place_.offset,
                            IsoEnd{options_.iso_continuation, &is_one_line_});
      break;
    case Form::Unknown:
      return find_form(state);
  }
  return loaded == WindowState::Ready ? show(state.program.form) : complain_of(loaded);
}

ReadState BlockReader::complain_of(WindowState loaded) {
  switch (loaded) {
    case WindowState::NotYet:
      return ReadState::NotYet;
    case WindowState::EndOfText:
      return ReadState::End;
    case WindowState::TooLong:
      fault_ = {ErrorCode::BlockTooLong, 0, fmt::format("over {} characters", kLongestBlock)};
      fault_line_ = place_.line;
      return ReadState::Wrong;
    default:
      return ReadState::Failed;
  }
}

ReadState BlockReader::find_form(ReadingState& state) {
  const WindowState loaded = window_.load(place_.program, place_.offset, FirstLineEnd{});
  if (loaded != WindowState::Ready) return complain_of(loaded);
  if (skip_blanks(window_.begin(), window_.end()) == window_.end()) return ReadState::End;
  const Form form = detect_form({window_.begin(), window_.end()});
  if (form == Form::Unknown) {
    fault_ = {ErrorCode::BlockFormatIncorrect, 1, "neither plain language nor ISO"};
    fault_line_ = place_.line;
    return ReadState::Wrong;
  }
  state.program.form = form;
  return load(state);
}

/// The block without the blanks around it. A star in front belongs to plain language.
ReadState BlockReader::show(Form form) {
  text_end_ = window_.end();
  text_ = form == Form::Iso ? IsoEnd::skip(window_.begin(), text_end_)
                            : skip_blanks(window_.begin(), text_end_);
  return text_ == text_end_ ? ReadState::End : ReadState::Ready;
}

ReadState BlockReader::load_later(ReadingState& state) {
  state.program.form = Form::Plain;
  for (;;) {
    const WindowState loaded = window_.load(place_.program, place_.offset, ItncEnd{&is_one_line_});
    if (loaded != WindowState::Ready) return complain_of(loaded);
    text_end_ = window_.end();
    text_ = ItncEnd::skip(window_.begin(), text_end_);
    if (text_ == text_end_) return ReadState::End;
    if (!skips_ || !is_skipped(text_, text_end_)) return ReadState::Ready;
    pass_over();
  }
}

/// The block loaded is none of the program's; the one read last stays so.
void BlockReader::pass_over() {
  const TextPlace last = block_place_;
  find_place();
  move_on();
  block_place_ = last;
}

bool BlockReader::read_later(ReadingState& state, BlockParts& parts) {
  if (!read_itnc_block(text_, text_end_, state, parts, fault_)) return false;
  note_plain_block(parts.blocks[0], state);
  return true;
}

void BlockReader::find_place() {
  block_place_ = place_;
  block_place_.offset = window_.offset() + static_cast<std::uint64_t>(text_ - window_.begin());
  if (text_ == window_.begin()) return;
  block_place_.line += line_ends_in(window_.begin(), text_);
}

ReadState BlockReader::pass(ReadingState& state, std::string_view& passed) {
  is_peeked_ = false;
  if (const ReadState loaded = load(state); loaded != ReadState::Ready) return loaded;
  find_place();
  passed = text();
  move_on();
  return ReadState::Ready;
}

ReadState BlockReader::next_words(ReadingState& state) {
  if (const ReadState loaded = load(state); loaded != ReadState::Ready) return loaded;
  find_place();
  if (!read_iso_block(text_, text_end_, state.program, iso_, fault_)) return complain();
  const ControlVersion& version = options_.version;
  if (!version.takes_all_blocks() && !check_version(version, iso_, fault_)) return complain();
  if (place_.offset == 0 && iso_.program != IsoBlock::kNone && iso_.has(IsoGroup::Unit)) {
    state.program.units = iso_.code(IsoGroup::Unit) == 70 ? Units::Inch : Units::Millimeter;
    state.program.number = iso_.program;
  }
  move_on();
  return ReadState::Ready;
}

bool BlockReader::skip_wrong() {
  if (fault_.code == ErrorCode::BlockTooLong) return false;
  move_on();
  return true;
}

bool BlockReader::read(ReadingState& state, BlockParts& parts) {
  find_place();
  if (state.program.form == Form::Iso) {
    return read_iso_block(text_, text_end_, state.program, iso_, fault_) &&
           resolve_words(state, parts);
  }
  Block& block = parts.blocks[0];
  if (options_.is_itnc) [[unlikely]]
    return read_later(state, parts);
  if (!read_plain_block(text_, text_end_, state, block, fault_)) return false;
  const ControlVersion& version = options_.version;
  if (!version.takes_all_blocks() && !check_version(version, block, fault_)) return false;
  parts.count = 1;
  note_plain_block(block, state);
  return true;
}

/// What an ISO block does; for a version that does not take all blocks `state` is tried out first.
bool BlockReader::resolve_words(ReadingState& state, BlockParts& parts) {
  const bool is_first = place_.offset == 0;
  const ControlVersion& version = options_.version;
  if (version.takes_all_blocks()) [[likely]]
    return resolve(iso_, is_first, state, parts, fault_);
  if (!check_version(version, iso_, fault_)) return false;
  ReadingState tried = state;
  if (!resolve(iso_, is_first, tried, parts, fault_)) return false;
  for (const Block& part : parts) {
    if (!check_version(version, part, fault_)) return false;
  }
  state = tried;
  return true;
}

/// The fault's place: its line, and the column within that.
ReadState BlockReader::complain() {
  fault_line_ = block_place_.line;
  // What the words of an ISO block say together is wrong with the whole block.
  const std::uint32_t column = fault_.column = std::max(fault_.column, 1u);
  for (std::uint32_t i = 0; i + 1 < column; ++i) {
    if (text_[i] != '\n' && (text_[i] != '\r' || text_[i + 1] == '\n')) continue;
    ++fault_line_;
    fault_.column = column - i - 1;
  }
  return ReadState::Wrong;
}

void BlockReader::move_on() {
  const char* after = text_end_;
  if (window_.is_terminated()) ++after;
  place_ = block_place_;
  place_.offset += static_cast<std::uint64_t>(after - text_);
  if (is_one_line_) {
    place_.line += *text_end_ == '*' ? 0 : 1;
  } else {
    place_.line += line_ends_in(text_, after);
  }
}

ProgramLookup BlockReader::find(std::string_view name) {
  const std::string kept(name);  // it may lie in the window
  drop_window();
  return source_->find(kept);
}

}  // namespace dripline::interpreter::tnc155
