#include "server/ports/programs/start_finder.hpp"

#include <algorithm>
#include <string>

#include "server/ports/block_ledger.hpp"

namespace dripline::ports {
namespace {

constexpr std::uint64_t kPiece = 256 * 1024;
constexpr std::size_t kHead = 24;

/// Looks at the text of a program, byte for byte, until the wanted place has come.
class Finder {
 public:
  explicit Finder(const machines::StartPoint& from) : from_(from) {}

  bool look(char c) {
    if (from_.byte && place_.byte + at_ == *from_.byte) return here();
    if (c != '\n') {
      if (head_.size() < kHead) head_ += c;
      ++at_;
      return false;
    }
    return end_block();
  }
  /// After the last byte.
  bool look_at_end() { return end_block(); }
  const ProgramPlace& place() const { return place_; }

 private:
  bool here() {
    place_.byte += at_;
    return true;
  }
  /// The block that ends is the wanted one, or the next begins.
  bool end_block() {
    if (from_.line && place_.line == *from_.line) return true;
    if (from_.sequence && sequence_number(head_) == static_cast<std::int64_t>(*from_.sequence)) {
      return true;
    }
    place_.byte += at_ + 1;
    ++place_.line;
    at_ = 0;
    head_.clear();
    return false;
  }

  const machines::StartPoint from_;
  ProgramPlace place_;  ///< where the block begins
  std::uint64_t at_ = 0;
  std::string head_;
};

std::string wanted(const machines::StartPoint& from) {
  if (from.byte) return fmt::format("byte {}", *from.byte);
  if (from.line) return fmt::format("line {}", *from.line);
  return fmt::format("block N{}", from.sequence.value_or(0));
}

}  // namespace

Result<ProgramPlace> find_start(storage::ProgramStore& store, const storage::Run& run,
                                const machines::StartPoint& from) {
  if (from.tool || from.skipped) {
    return fail(Errc::Unsupported, "over a serial line a run begins at a block, a line or a byte");
  }
  if (!from.byte && !from.line && !from.sequence) return ProgramPlace{};
  Finder finder(from);
  bool ends_in_block = false;
  for (std::uint64_t offset = 0; offset < run.size;) {
    const auto bytes = store.read_content(run.content, offset, kPiece);
    if (!bytes) return fail(bytes.error());
    if (bytes->empty()) return fail(Errc::Corrupt, "content {} is short", run.content.hex());
    for (const std::byte byte : *bytes) {
      if (finder.look(static_cast<char>(byte))) return finder.place();
    }
    ends_in_block = bytes->back() != std::byte{'\n'};
    offset += bytes->size();
  }
  if (ends_in_block && !from.byte && finder.look_at_end()) return finder.place();
  return fail(Errc::NotFound, "program '{}' has no {}; it has {} bytes", run.program, wanted(from),
              run.size);
}

}  // namespace dripline::ports
