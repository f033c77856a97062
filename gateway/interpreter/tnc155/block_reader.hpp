#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "gateway/interpreter/language/line_reader.hpp"
#include "gateway/interpreter/language/line_window.hpp"
#include "gateway/interpreter/tnc155/block.hpp"
#include "gateway/interpreter/tnc155/errors.hpp"
#include "gateway/interpreter/tnc155/iso_modes.hpp"

namespace dripline::interpreter::tnc155 {

enum class Form : std::uint8_t { Unknown, Plain, Iso };

/// Which form a program's first bytes are in; Unknown when they fit neither.
Form detect_form(std::string_view head);

/// What the reader must know of the text it is in: per program, so a call keeps the caller's.
struct ProgramForm {
  Form form = Form::Unknown;        ///< found out from the first block that is read
  Units units = Units::Millimetre;  ///< set by BEGIN PGM and %
  friend bool operator==(const ProgramForm&, const ProgramForm&) = default;
};

/// All that reading depends on: part of the run's state.
struct ReadingState {
  ProgramForm program;
  IsoModes iso;
  /// The path function a `*` block of plain language repeats.
  std::optional<BlockKind> last_path;
  friend bool operator==(const ReadingState&, const ReadingState&) = default;
};

struct ReaderOptions {
  bool iso_continuation = true;  ///< an ISO line without number goes on with the block before it
};

enum class ReadState : std::uint8_t {
  Ready,
  End,     ///< the program has no more blocks
  NotYet,  ///< the rest of this block is on its way; ask again later
  Failed,  ///< the source will never give it; see reason()
  Wrong,   ///< the text is no block of this control; see fault(). The place stays before it
};

/// Reads a program block by block out of a source's windows, whatever the chunking. A block of
/// plain language is a line and the lines without a number behind it; an ISO block ends at its `*`
/// or like one of plain language. Memory: one block. No allocation except for faults. The source
/// must outlive the reader; other uses of the source need a `forget_window()` before the next call.
class BlockReader {
 public:
  static constexpr std::size_t kLongestBlock = 2048;

  explicit BlockReader(ProgramSource& source, ReaderOptions options = {});

  /// The next block. `state` changes only when it is Ready.
  ReadState next(ReadingState& state, BlockParts& parts);

  /// Where the next block begins.
  const TextPlace& place() const { return place_; }
  /// Where the block read last begins.
  const TextPlace& block_place() const { return block_place_; }
  /// Its text, continuation lines included; valid until the next call on the reader or the source.
  std::string_view text() const { return {text_, text_end_}; }
  /// Goes on from there: the beginning of a block.
  void seek(const TextPlace& place) { place_ = place; }
  ProgramLookup find(std::string_view name);
  void forget_window() { window_.forget(); }

  const Fault& fault() const { return fault_; }
  const std::string& reason() const { return window_.failure(); }

 private:
  ReadState load(Form form);
  bool read(ReadingState& state, BlockParts& parts);

  ProgramSource* source_;
  ReaderOptions options_;
  language::LineWindow window_;
  TextPlace place_;
  TextPlace block_place_;
  const char* text_ = nullptr;
  const char* text_end_ = nullptr;
  std::uint64_t consumed_ = 0;  ///< bytes from place_ to behind the block
  std::uint64_t lines_ = 0;     ///< line ends among them
  Fault fault_;
};

}  // namespace dripline::interpreter::tnc155
