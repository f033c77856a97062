#include "gateway/app/serial/serial_start.hpp"

#include <charconv>
#include <utility>

namespace dripline::gateway {
namespace {

constexpr std::uint64_t kPiece = 32 * 1024;
constexpr int kPiecesAtOnce = 32;

/// "N120", "L7", "B4096" or "T3".
Result<line::WantedPlace> parse_place(std::string_view text) {
  line::WantedPlace wanted;
  if (text.empty()) return wanted;
  std::uint64_t number = 0;
  const char* end = text.data() + text.size();
  const auto read = std::from_chars(text.data() + 1, end, number);
  if (read.ec != std::errc{} || read.ptr != end)
    return fail(Errc::Syntax, "a start at '{}': expected N120, L7, B4096 or T3", text);
  switch (text.front()) {
    case 'N':
      wanted.sequence = number;
      return wanted;
    case 'L':
      wanted.line = number;
      return wanted;
    case 'B':
      wanted.byte = number;
      return wanted;
    case 'T':
      wanted.tool = number;
      return wanted;
    default:
      return fail(Errc::Unsupported,
                  "over a serial line a run begins at a block, a line, a byte or a tool");
  }
}

}  // namespace

Result<SerialStart> SerialStart::make(const StartArgument& argument, Program program) {
  if (argument.pass || argument.memory != StartMemory::Ask) {
    return fail(Errc::Unsupported,
                "pass and memory: the control at the end of a line has its own memory");
  }
  const auto wanted = parse_place(argument.place);
  if (!wanted) return fail(wanted.error());
  return SerialStart(*wanted, argument.head, std::move(program));
}

SerialStart::State SerialStart::fail_with(std::string fault) {
  fault_ = std::move(fault);
  return state_ = State::Failed;
}

SerialStart::State SerialStart::work(line::TextSource& text) {
  if (state_ == State::Ready || state_ == State::Failed) return state_;
  state_ = State::Working;
  for (int piece = 0; piece < kPiecesAtOnce && state_ == State::Working; ++piece) {
    if (at_ >= program_.size) return scan_ ? scan_end() : find_end(finder_.look_at_end());
    const auto read = text.read(at_, kPiece);
    if (!read) return fail_with(read.error().what);
    if (read->empty()) return state_ = State::NeedsText;
    at_ += read->size();
    if (!take(*read)) return state_;
  }
  return state_;
}

/// False: this pass is over.
bool SerialStart::take(std::string_view piece) {
  if (scan_) {
    if (scan_->take(piece)) return true;
    scan_end();
    return false;
  }
  if (!finder_.look(piece)) return true;
  find_end(true);
  return false;
}

SerialStart::State SerialStart::find_end(bool is_found) {
  if (!is_found) {
    return fail_with(
        fmt::format("the program has no {}; it has {} bytes", to_text(wanted_), program_.size));
  }
  place_ = finder_.place();
  if (place_.byte == 0 || choice_ == line::HeadChoice::Set) return state_ = State::Ready;
  scan_.emplace(program_.control, place_);
  at_ = 0;
  return state_;
}

SerialStart::State SerialStart::scan_end() {
  scan_->end();
  auto head = scan_->head(choice_);
  if (!head) return fail_with(head.error().what);
  head_ = *std::move(head);
  return state_ = State::Ready;
}

}  // namespace dripline::gateway
