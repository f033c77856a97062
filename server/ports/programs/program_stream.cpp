#include "server/ports/programs/program_stream.hpp"

#include <algorithm>
#include <optional>

#include "gateway/interpreter/dialects/centurion/reading/program_extraction.hpp"
#include "gateway/line/inbound/program_head.hpp"

namespace dripline::ports {
namespace {

constexpr std::string_view kAroundLines = " \t\r\n%";

Result<std::string> text_of(storage::ProgramStore& store, const Digest& content,
                            std::uint64_t offset, std::uint64_t length) {
  const auto bytes = store.read_content(content, offset, length);
  if (!bytes) return fail(bytes.error());
  return std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size());
}

/// Bytes of blank lines and lines of `%` alone at the beginning.
std::size_t lines_in_front(std::string_view text) {
  std::size_t at = 0;
  for (;;) {
    const auto end = text.find('\n', at);
    if (end == std::string_view::npos) return at;
    if (text.substr(at, end - at).find_first_not_of(kAroundLines) != std::string_view::npos) {
      return at;
    }
    at = end + 1;
  }
}

/// The same at the end.
std::size_t lines_after(std::string_view text) {
  const auto last = text.find_last_not_of(kAroundLines);
  if (last == std::string_view::npos) return text.size();
  const auto end = text.find('\n', last);
  return end == std::string_view::npos ? 0 : text.size() - end - 1;
}

/// Made from a program's name. Errors: Syntax (it has no number).
Result<std::string> o_line_of(const std::string& program) {
  const std::string number = line::program_number(program);
  if (!number.empty()) return fmt::format("O{:0>4}\n", number);
  return fail(Errc::Syntax,
              "program '{}' has no O number, in its text or as its name: among several the control "
              "could not separate it; send it alone",
              program);
}

/// The position of the O line of a text; comments may be in front of it.
struct NumberLine {
  std::size_t begin = 0, end = 0;  ///< with its LF
};

std::optional<NumberLine> number_line(std::string_view head) {
  interpreter::centurion::ProgramSplitter splitter;
  for (std::size_t at = 0; at < head.size();) {
    const auto end = std::min(head.find('\n', at), head.size());
    std::string line(head.substr(at, end - at));
    const auto first = line.find_first_not_of(" \t");
    if (first != std::string::npos && line[first] == ':') line[first] = 'O';
    if (splitter.begins_next(line)) return std::nullopt;  // blocks stand in front of it
    const std::size_t next = std::min(end + 1, head.size());
    if (splitter.number() != 0) return NumberLine{.begin = at, .end = next};
    at = next;
  }
  return std::nullopt;
}

}  // namespace

ProgramStream ProgramStream::of(const Digest& content, std::uint64_t size) {
  ProgramStream stream;
  stream.add(content, 0, size);
  return stream;
}

Result<ProgramStream> ProgramStream::of(storage::ProgramStore& store,
                                        const std::vector<storage::Revision>& revisions) {
  ProgramStream stream;
  for (const auto& revision : revisions) {
    if (auto added = stream.add(store, revision); !added) return fail(added.error());
  }
  return stream;
}

void ProgramStream::add(const Digest& content, std::uint64_t first, std::uint64_t size) {
  pieces_.push_back({.content = content, .first = first, .size = size, .text = {}});
  size_ += size;
}

void ProgramStream::add(std::string text) {
  const std::uint64_t size = text.size();
  size_ += size;
  pieces_.push_back({.content = {}, .first = 0, .size = size, .text = std::move(text)});
}

Result<void> ProgramStream::add(storage::ProgramStore& store, const storage::Revision& revision) {
  const auto head = text_of(store, revision.content, 0, line::kProgramHead);
  if (!head) return fail(head.error());
  const std::uint64_t tail_at =
      revision.size - std::min<std::uint64_t>(revision.size, line::kProgramHead);
  const auto tail = text_of(store, revision.content, tail_at, line::kProgramHead);
  if (!tail) return fail(tail.error());
  const std::uint64_t front = lines_in_front(*head);
  const std::uint64_t after = lines_after(*tail);
  if (front + after >= revision.size) {
    return fail(Errc::Syntax, "program '{}' has nothing but blank lines and %", revision.program);
  }
  const std::uint64_t end = revision.size - after;
  const auto line = number_line(*head);
  if (!line) {
    const auto number = o_line_of(revision.program);
    if (!number) return fail(number.error());
    add(*number);
    add(revision.content, front, end - front);
  } else if (line->begin > front && (*head)[line->end - 1] == '\n') {
    // Text in front of its O line would be the end of the program before.
    add(revision.content, line->begin, line->end - line->begin);
    add(revision.content, front, line->begin - front);
    add(revision.content, line->end, end - line->end);
  } else {
    add(revision.content, front, end - front);
  }
  if (after == 0 && !tail->ends_with('\n')) add("\n");
  return {};
}

const ProgramStream::Piece* ProgramStream::piece_at(std::uint64_t& offset) const {
  for (const Piece& piece : pieces_) {
    if (offset < piece.size) return &piece;
    offset -= piece.size;
  }
  return nullptr;
}

Result<std::string> ProgramStream::read(storage::ProgramStore& store, std::uint64_t offset,
                                        std::uint64_t length) const {
  const Piece* const piece = piece_at(offset);
  if (piece == nullptr) return fail(Errc::Corrupt, "the text to be sent is short");
  const std::uint64_t wanted = std::min(length, piece->size - offset);
  if (!piece->text.empty()) return piece->text.substr(offset, wanted);
  auto text = text_of(store, piece->content, piece->first + offset, wanted);
  if (text && text->empty()) {
    return fail(Errc::Corrupt, "content {} is short", piece->content.hex());
  }
  return text;
}

std::string ProgramStream::near(storage::ProgramStore& store, std::uint64_t offset,
                                std::uint64_t length) const {
  const Piece* const piece = piece_at(offset);
  if (piece == nullptr) return {};
  const std::uint64_t wanted = std::min(length, piece->size - offset);
  if (!piece->text.empty()) return piece->text.substr(offset, wanted);
  const auto bytes = store.near_content(piece->content, piece->first + offset, wanted);
  if (!bytes) return {};
  return {reinterpret_cast<const char*>(bytes->data()), bytes->size()};
}

namespace {

class StoredText final : public line::TextSource {
 public:
  StoredText(ProgramStream stream, storage::ProgramStore& store)
      : stream_(std::move(stream)), store_(store) {}
  Result<std::string> read(std::uint64_t offset, std::uint64_t length) override {
    return stream_.read(store_, offset, length);
  }
  std::string near(std::uint64_t offset, std::uint64_t length) override {
    return stream_.near(store_, offset, length);
  }

 private:
  const ProgramStream stream_;
  storage::ProgramStore& store_;
};

}  // namespace

std::shared_ptr<line::TextSource> source_of(ProgramStream stream, storage::ProgramStore& store) {
  return std::make_shared<StoredText>(std::move(stream), store);
}

}  // namespace dripline::ports
