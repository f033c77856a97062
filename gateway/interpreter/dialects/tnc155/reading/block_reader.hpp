#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "gateway/interpreter/core/language/line_reader.hpp"
#include "gateway/interpreter/core/language/line_window.hpp"
#include "gateway/interpreter/dialects/tnc155/errors.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/block_parts.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/control_version.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/iso_block.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/reading_state.hpp"

namespace dripline::interpreter::tnc155 {

/// The form of a program by its first bytes; Unknown when they fit neither.
Form detect_form(std::string_view head);

struct ReaderOptions {
  bool iso_continuation = true;  ///< an ISO line without a number continues the block before it
  ControlVersion version = {};   ///< blocks that need a feature it lacks are Wrong
  bool is_itnc = false;          ///< plain language of later controls (itnc/)
};

enum class ReadState : std::uint8_t {
  Ready,
  End,     ///< the program has no more blocks
  NotYet,  ///< the rest of this block has not arrived; ask again later
  Failed,  ///< the source will never provide it; see reason()
  Wrong,   ///< the text is not a block of this control; see fault(). The place stays before it
};

/// Reads a program block by block out of a source's windows, whatever the chunking. A block of
/// plain language is a line and the lines without a number after it; an ISO block ends at its `*`
/// or like one of plain language. Memory: one block. No allocation except for faults. The source
/// must outlive the reader; other uses of the source need a `drop_window()` before the next call.
class BlockReader {
 public:
  static constexpr std::size_t kLongestBlock = 4096;

  explicit BlockReader(ProgramSource& source, ReaderOptions options = {});

  /// The next block. `state` changes only when it is Ready, but for the form, which the program's
  /// first line decides.
  ReadState next(ReadingState& state, BlockParts& parts);

  /// The text of the next block, without consuming it; the `text` of the block read last is
  /// invalid afterwards.
  ReadState peek(const ReadingState& state, std::string_view& next);
  /// The parts of that block, with the modal state after the block before it. Call it after a
  /// `peek` that was Ready. False: the block cannot be read; reading it in its turn reports the
  /// fault.
  bool read_peeked(ReadingState state, BlockParts& parts);

  /// Skips the next block without reading its words: `passed` is its text, valid until the next
  /// call on the reader or the source. Of `state` only the form changes.
  ReadState pass(ReadingState& state, std::string_view& passed);

  /// Reads only the words of the next block of an ISO program: see `iso_block`. Of `state` only the
  /// program changes, and only by its % block.
  ReadState next_words(ReadingState& state);

  /// Skips the block that was Wrong. False: its end is not known.
  bool skip_wrong();

  /// Blocks with a slash are passed over from the next one on that is loaded. Of later controls.
  void set_block_skip(bool skips) { skips_ = skips; }

  /// Where the next block begins.
  const TextPlace& place() const { return place_; }
  /// Where the block read last begins.
  const TextPlace& block_place() const { return block_place_; }
  /// Its text, continuation lines included; valid until the next call on the reader or the source.
  std::string_view text() const { return {text_, text_end_}; }
  /// Continues from there: the beginning of a block.
  void seek(const TextPlace& place) {
    place_ = place;
    is_peeked_ = false;
  }
  ProgramLookup find(std::string_view name);
  void drop_window() {
    window_.invalidate();
    is_peeked_ = false;
  }

  const Fault& fault() const { return fault_; }
  /// The line of the text the fault is in; its column is relative to that line.
  std::uint64_t fault_line() const { return fault_line_; }
  /// The words of the block read last, where it was an ISO block.
  const IsoBlock& iso_block() const { return iso_; }
  const std::string& reason() const { return window_.failure(); }

 private:
  ReadState load(ReadingState& state);
  [[gnu::noinline]] ReadState load_later(ReadingState& state);
  void pass_over();
  [[gnu::noinline]] bool read_later(ReadingState& state, BlockParts& parts);
  ReadState find_form(ReadingState& state);
  ReadState show(Form form);
  void find_place();
  bool read(ReadingState& state, BlockParts& parts);
  bool resolve_words(ReadingState& state, BlockParts& parts);
  ReadState complain();
  ReadState complain_of(language::LineWindow::State loaded);
  void move_on();

  ProgramSource* source_;
  ReaderOptions options_;
  language::LineWindow window_;
  bool skips_ = false;
  bool is_peeked_ = false;  ///< the block at place_ is in the window already
  TextPlace place_;
  TextPlace block_place_;
  const char* text_ = nullptr;
  const char* text_end_ = nullptr;
  bool is_one_line_ = false;  ///< no line end within the text, and the source's after it
  Fault fault_;
  std::uint64_t fault_line_ = 0;
  IsoBlock iso_;
};

}  // namespace dripline::interpreter::tnc155
