#include "tests/unit/clients/tools/tnc_conversion/rewriting.hpp"

#include <fmt/format.h>

#include "clients/tools/tnc_conversion/program_text.hpp"
#include "gateway/interpreter/core/program_source.hpp"

namespace dripline::tnc_conversion {

using namespace interpreter;
using namespace interpreter::tnc155;

namespace {

constexpr TextLayout kLayout{.line_end = "\n"};

/// Gives never more than it is asked for, or `window` bytes.
class WindowedSource final : public ProgramSource {
 public:
  WindowedSource(std::string_view text, std::size_t window) : text_(text), window_(window) {}
  TextWindow fetch(ProgramIndex, std::uint64_t offset, std::size_t min_bytes) override {
    const std::size_t size = std::max(window_, min_bytes);
    shown_ = std::string(text_.substr(std::min<std::size_t>(offset, text_.size()), size));
    return {TextWindow::State::Ready, shown_, offset + shown_.size() >= text_.size(), {}};
  }
  ProgramLookup find(std::string_view) override {
    return {ProgramLookup::State::NotFound, kMainProgram};
  }

 private:
  std::string_view text_;
  std::size_t window_;
  std::string shown_;
};

template <class Add>
std::string walk(ProgramSource& source, ReadingState state, Add add) {
  BlockReader reader(source);
  BlockParts parts;
  std::string text;
  while (true) {
    const ReadState read = reader.next(state, parts);
    if (read == ReadState::End) return text;
    if (read == ReadState::Wrong) {
      return text + fmt::format("{}:{} {}", reader.fault_line(), reader.fault().column,
                                reader.fault().text());
    }
    if (read != ReadState::Ready) return text + "no text: " + reader.reason();
    add(reader, state, parts, text);
  }
}

void add_rewritten(const BlockReader& reader, const ReadingState& state, const BlockParts& parts,
                   std::string& text) {
  if (state.program.form == Form::Iso) {
    write_iso_block(reader.iso_block(), kLayout, text);
  } else {
    write_plain_block(parts.blocks[0], state.program.units, kLayout, text);
  }
}

}  // namespace

std::string rewritten(std::string_view text, Form form) {
  MemorySource source(text);
  ReadingState state;
  state.program.form = form;
  return walk(source, state, add_rewritten);
}

std::string rewritten_in_windows(std::string_view text, std::size_t window) {
  WindowedSource source(text, window);
  return walk(source, {}, add_rewritten);
}

std::string parts_of(std::string_view text, ReadingState state) {
  MemorySource source(text);
  return walk(
      source, state,
      [](const BlockReader&, const ReadingState& now, const BlockParts& parts, std::string& out) {
        for (Block part : parts) {
          part.number = Block::kNone;
          write_plain_block(part, now.program.units, kLayout, out);
        }
      });
}

}  // namespace dripline::tnc_conversion
