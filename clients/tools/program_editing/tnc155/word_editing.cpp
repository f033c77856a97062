#include <algorithm>
#include <map>
#include <optional>

#include "clients/tools/program_editing/program_edit.hpp"
#include "clients/tools/program_editing/tnc155/block_words.hpp"
#include "clients/tools/program_editing/tnc155/cut_program.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/iso_cycles.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/plain_reader.hpp"

namespace dripline::program_editing {

using namespace interpreter;
using namespace interpreter::tnc155;
using namespace tnc_conversion;

namespace {

/// Writes blocks as the control does, without number and end.
class BlockRewriter {
 public:
  explicit BlockRewriter(const CutProgram& program) : program_(program), state_(program.state()) {}

  /// Of a block [begin, end), after those it was given before; `*end` ends a block. False: `fault`
  /// says why.
  bool rewrite(const char* begin, const char* end, std::string& text, Fault& fault) {
    return program_.form() == Form::Iso ? rewrite_iso(begin, end, text, fault)
                                        : rewrite_plain(begin, end, text, fault);
  }

 private:
  bool rewrite_plain(const char* begin, const char* end, std::string& text, Fault& fault) {
    Block block;
    if (!read_plain_block(begin, end, state_, block, fault)) return false;
    note_plain_block(block, state_);
    block.number = Block::kNone;
    text.clear();
    write_plain_block(block, state_.program.units, program_.layout(), text);
    text.resize(text.size() - program_.layout().line_end.size());
    return true;
  }
  bool rewrite_iso(const char* begin, const char* end, std::string& text, Fault& fault) {
    IsoBlock block;
    if (!read_iso_block(begin, end, state_.program, block, fault)) return false;
    text.clear();
    write_iso_block(block, program_.layout(), text);
    text.resize(text.rfind(" *"));
    return true;
  }

  const CutProgram& program_;
  ReadingState state_;
};

/// Words that determine the kind of a block cannot be changed as words.
bool names_the_block(const BlockWord& word, Form form) {
  if (form == Form::Iso) return word.address == "D" || word.address == "%";
  static constexpr std::string_view kNames[] = {
      "DEF BLK FORM", "BEGIN PGM", "END PGM", "CYCL DEF", "CYCL CALL", "TCH PROBE", "STOP",
      "RND",          "FN",        "LP",      "CC",       "CP",        "CT"};
  return word.begin == 0 && std::ranges::find(kNames, word.address) != std::end(kNames);
}
/// Has to stay where words are taken out.
bool begins_the_block(const BlockWord& word, Form form) {
  if (form == Form::Iso) return word.address == "N" || names_the_block(word, form);
  static constexpr std::string_view kBeginnings[] = {"TOOL DEF", "CALL LBL", "CALL PGM",
                                                     "LBL",      "L",        "C"};
  const bool is_axis_c = word.address == "C" && !word.value.empty();
  return word.begin == 0 && !is_axis_c &&
         (names_the_block(word, form) ||
          std::ranges::find(kBeginnings, word.address) != std::end(kBeginnings));
}

bool is_distance_code(std::string_view address) {
  return address == "G90" || address == "G91";
}

/// One block whose words are changed one after the other.
class WordEditor {
 public:
  WordEditor(const CutProgram& program, std::int64_t number, std::string text)
      : program_(program), form_(program.form()), number_(number), text_(std::move(text)) {}

  const std::string& text() const { return text_; }

  Result<void> change(const WordChange& change) {
    return change.kind == WordChange::Kind::Set ? set(change.word)
                                                : take_out(change.word, change.kind);
  }

 private:
  Result<void> set(const std::string& typed) {
    const auto word = read_typed_word(typed, form_);
    if (!word) return fail(word.error());
    if (auto checked = check_distance(word->address); !checked) return checked;
    const auto words = words_of(text_, form_);
    const BlockWord* old = word_for(words, *word, form_);
    if (old == nullptr) return no_word(word->address);
    if (names_the_block(*old, form_)) {
      return fail(Errc::Syntax,
                  "block {}: {} determines the kind of the block, --replace changes it", number_,
                  old->address);
    }
    if (std::ranges::find(set_, word->address) != set_.end()) {
      return fail(Errc::Conflict, "{} of block {} is given two values", word->address, number_);
    }
    set_.push_back(word->address);
    const bool is_apart = !old->value.empty() && old->value.data() != after(old->address);
    std::string changed = text_;
    changed.replace(old->begin, old->end - old->begin,
                    word->address + (is_apart ? " " : "") + word->value);
    return take(std::move(changed));
  }

  Result<void> take_out(const std::string& typed, WordChange::Kind kind) {
    const auto address = read_typed_address(typed, form_);
    if (!address) return fail(address.error());
    if (auto checked = check_distance(*address); !checked) return checked;
    const auto words = words_of(text_, form_);
    const BlockWord* word = find(words, *address);
    if (word == nullptr) return no_word(*address);
    if (begins_the_block(*word, form_)) {
      return fail(Errc::Syntax, "{} begins block {}, \"{}\": it stays", *address, number_, text_);
    }
    const bool is_shortened = kind == WordChange::Kind::Shorten;
    if (auto checked = check_set(words, *word, is_shortened); !checked) return checked;
    std::string changed = text_;
    // TOOL CALL without a number changes the speed or the axis.
    const std::size_t first = word->address == "TOOL CALL" ? word->address.size() : word->begin;
    changed.erase(first, is_shortened ? std::string::npos : word->end - first);
    drop_idle_distance(changed);
    const std::string before = text_;
    if (auto taken = take(std::move(changed)); !taken) return taken;
    if (text_ != before) return {};
    return fail(Errc::NotFound, "{} of block {} is left out already: \"{}\"", *address, number_,
                text_);
  }

  /// Of several the one with a value: in BLK FORM the coordinate, not the spindle axis.
  static const BlockWord* find(const std::vector<BlockWord>& words, const std::string& address) {
    const BlockWord* found = nullptr;
    for (const BlockWord& word : words) {
      if (word.address != address) continue;
      if (!word.value.empty()) return &word;
      if (found == nullptr) found = &word;
    }
    return found;
  }

  Result<void> check_distance(const std::string& address) const {
    if (form_ != Form::Iso || !is_distance_code(address)) return {};
    return fail(Errc::Syntax, "block {}: {} is for the words after it, --replace changes both",
                number_, address);
  }

  Result<void> check_set(const std::vector<BlockWord>& words, const BlockWord& from,
                         bool is_shortened) const {
    for (const BlockWord& word : words) {
      const bool goes = &word == &from || (is_shortened && word.begin > from.begin);
      if (goes && std::ranges::find(set_, word.address) != set_.end()) {
        return fail(Errc::Conflict, "{} of block {} is given a value and left out", word.address,
                    number_);
      }
    }
    return {};
  }

  /// A G90 or G91 whose words are gone, in front of the other one.
  void drop_idle_distance(std::string& text) const {
    if (form_ != Form::Iso) return;
    const auto words = words_of(text, form_);
    for (std::size_t i = 1; i < words.size(); ++i) {
      if (!is_distance_code(words[i - 1].address) || !is_distance_code(words[i].address)) continue;
      text.erase(words[i - 1].begin, words[i].begin - words[i - 1].begin);
      return;
    }
  }

  /// The words of an ISO cycle are read as they come: only here is it known whether they are all
  /// there.
  bool is_cycle_whole(const char* begin, const char* end, Fault& fault) const {
    IsoBlock block;
    const ProgramForm& form = program_.state().program;
    if (form_ != Form::Iso || !read_iso_block(begin, end, form, block, fault)) return true;
    BlockParts parts;
    return !block.has(IsoGroup::Cycle) || add_cycle(block, 0, form.units, parts, fault);
  }

  /// The control reads the block and writes it.
  Result<void> take(std::string changed) {
    const auto last = changed.find_last_not_of(' ');
    changed.resize(last == std::string::npos ? 0 : last + 1);
    const std::size_t size = changed.size();
    const std::string line = changed + "\n";
    Fault fault;
    std::string written;
    const char* end = line.data() + size;
    if (!BlockRewriter(program_).rewrite(line.data(), end, written, fault) ||
        !is_cycle_whole(line.data(), end, fault)) {
      return fail(Errc::Syntax, "block {}: \"{}\", column {}: {}", number_, changed,
                  std::max(fault.column, 1u), fault.text());
    }
    text_ = std::move(written);
    return {};
  }

  tl::unexpected<Error> no_word(const std::string& address) const {
    return fail(Errc::NotFound, "block {} has no word {}: \"{}\"", number_, address, text_);
  }
  static const char* after(std::string_view text) { return text.data() + text.size(); }

  const CutProgram& program_;
  Form form_;
  std::int64_t number_;
  std::string text_;
  std::vector<std::string> set_;  ///< addresses that were given a value
};

/// Editors of the blocks that are changed, by their place.
Result<std::map<std::size_t, std::optional<WordEditor>>> editors_of(
    const CutProgram& program, std::span<const WordChange> changes) {
  const auto numbers = program.numbers();
  std::map<std::size_t, std::optional<WordEditor>> editors;
  for (const WordChange& change : changes) {
    const auto place = find_block(numbers, change.block);
    if (!place) return fail(place.error());
    editors[*place];
  }
  BlockRewriter rewriter(program);
  for (std::size_t i = 0; i <= editors.rbegin()->first; ++i) {
    const TextBlock& block = program.blocks()[i];
    std::string text;
    Fault fault;
    const bool is_read = rewriter.rewrite(block.begin, block.stop, text, fault);
    const auto editor = editors.find(i);
    if (editor == editors.end()) continue;
    if (!is_read) {
      return fail(Errc::Syntax, "block {} \"{}\" cannot be read, --replace repairs it: {}",
                  block.number, block.text(), fault.text());
    }
    editor->second.emplace(program, block.number, std::move(text));
  }
  return editors;
}

/// Line of the text that `to` is in, where `from` is in line `line`.
std::uint64_t line_of(const char* from, const char* to, std::uint64_t line) {
  for (; from != to; ++from) {
    line += *from == '\n' || (*from == '\r' && from[1] != '\n') ? 1 : 0;
  }
  return line;
}

}  // namespace

Result<std::vector<BlockChange>> change_words(std::string_view text,
                                              std::span<const WordChange> changes) {
  if (changes.empty()) return std::vector<BlockChange>{};
  const CutProgram program(text);
  if (auto checked = program.check(); !checked) return fail(checked.error());
  auto editors = editors_of(program, changes);
  if (!editors) return fail(editors.error());
  const auto numbers = program.numbers();
  for (const auto kind :
       {WordChange::Kind::Set, WordChange::Kind::LeaveOut, WordChange::Kind::Shorten}) {
    for (const WordChange& change : changes) {
      if (change.kind != kind) continue;
      auto& editor = (*editors)[*find_block(numbers, change.block)];
      if (auto done = editor->change(change); !done) return fail(done.error());
    }
  }
  std::vector<BlockChange> replacements;
  for (const auto& [place, editor] : *editors) {
    replacements.push_back(
        {BlockChange::Kind::Replace, numbers[place], numbers[place], editor->text()});
  }
  return replacements;
}

Result<WordSearch> search_words(std::string_view text, std::span<const std::string> addresses) {
  const CutProgram program(text);
  if (auto checked = program.check(); !checked) return fail(checked.error());
  std::vector<std::string> wanted;
  for (const auto& typed : addresses) {
    auto address = read_typed_address(typed, program.form());
    if (!address) return fail(address.error());
    wanted.push_back(*std::move(address));
  }
  WordSearch search;
  BlockRewriter rewriter(program);
  std::uint64_t line = 1;
  const char* at = program.text().data();
  for (const TextBlock& block : program.blocks()) {
    line = line_of(at, block.begin, line);
    at = block.begin;
    std::string written;
    Fault fault;
    if (!rewriter.rewrite(block.begin, block.stop, written, fault)) {
      search.unread.push_back({{block.number, line, block.text()}, fault.text()});
      continue;
    }
    const bool is_found =
        std::ranges::any_of(words_of(written, program.form()), [&](const BlockWord& word) {
          return std::ranges::any_of(
              wanted, [&](const auto& address) { return is_found_by(word, address); });
        });
    if (is_found) search.found.push_back({block.number, line, block.text()});
  }
  return search;
}

}  // namespace dripline::program_editing
