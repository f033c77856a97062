#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gateway/line/text_source.hpp"
#include "storage/programs/program_store.hpp"

namespace dripline::ports {

/// A text that is sent as one, put together from pieces of stored programs and added words.
/// Immutable; any thread.
class ProgramStream {
 public:
  /// One program as it is.
  static ProgramStream of(const Digest& content, std::uint64_t size);
  /// Several, for a control that separates them by their O lines. Blank lines and lines of `%`
  /// around each are left out: the line's own start and end characters stand around the whole. Each
  /// begins with its O line, comments in front of it follow it; without one it gets the number of
  /// its name. Errors: those of the store, Syntax (nothing to send in it; no number), each with the
  /// program's name.
  static Result<ProgramStream> of(storage::ProgramStore& store,
                                  const std::vector<storage::Revision>& revisions);

  std::uint64_t size() const { return size_; }
  /// At most `length` bytes from `offset`; fewer do not mean the end. Errors: those of the store.
  Result<std::string> read(storage::ProgramStore& store, std::uint64_t offset,
                           std::uint64_t length) const;
  /// The same without the database (ProgramStore::near_content); empty: not so.
  std::string near(storage::ProgramStore& store, std::uint64_t offset, std::uint64_t length) const;

 private:
  struct Piece {
    Digest content;  ///< of `size` bytes from `first`, where there is no text
    std::uint64_t first = 0, size = 0;
    std::string text;
  };
  /// The piece at `offset`, which becomes the offset in it. Null: after the end.
  const Piece* piece_at(std::uint64_t& offset) const;
  void add(const Digest& content, std::uint64_t first, std::uint64_t size);
  void add(std::string text);
  Result<void> add(storage::ProgramStore& store, const storage::Revision& revision);

  std::vector<Piece> pieces_;
  std::uint64_t size_ = 0;
};

/// The same for a line; the store must outlive it.
std::shared_ptr<line::TextSource> source_of(ProgramStream stream, storage::ProgramStore& store);

}  // namespace dripline::ports
