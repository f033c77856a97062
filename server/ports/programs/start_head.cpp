#include "server/ports/programs/start_head.hpp"

#include <algorithm>

#include "server/ports/programs/modal_scan.hpp"

namespace dripline::ports {
namespace {

constexpr std::uint64_t kPiece = 256 * 1024;
constexpr std::size_t kMaxBlock = 4096;  ///< the rest of a longer block is not searched

/// Gives a program's blocks to a scan, as its bytes come.
class BlockCutter {
 public:
  BlockCutter(ModalScan& scan, const ProgramPlace& place) : scan_(scan), place_(place) {}

  /// False: no more is needed.
  bool take(char c) {
    if (at_ == place_.byte && at_ > 0) end_skipped();
    ++at_;
    if (c != '\n') {
      if (block_.size() < kMaxBlock) block_ += c;
      return true;
    }
    return end_block();
  }
  bool end_block() {
    const std::string block = std::exchange(block_, {});
    if (at_ > place_.byte) return scan_.look(block);
    scan_.skip(block);
    return true;
  }

 private:
  /// A run may begin inside a block: its first words are not sent.
  void end_skipped() {
    if (block_.empty()) return;
    scan_.skip(std::exchange(block_, {}));
  }

  ModalScan& scan_;
  const ProgramPlace place_;
  std::uint64_t at_ = 0;
  std::string block_;
};

Result<void> scan_program(storage::ProgramStore& store, const storage::Run& run,
                          const ProgramPlace& place, ModalScan& scan) {
  BlockCutter cutter(scan, place);
  for (std::uint64_t offset = 0; offset < run.size;) {
    const auto bytes = store.read_content(run.content, offset, kPiece);
    if (!bytes) return fail(bytes.error());
    if (bytes->empty()) return fail(Errc::Corrupt, "content {} is short", run.content.hex());
    for (const std::byte byte : *bytes) {
      if (!cutter.take(static_cast<char>(byte))) return {};
    }
    offset += bytes->size();
  }
  if (cutter.end_block()) scan.end();
  return {};
}

std::string one_line(std::string text) {
  while (text.ends_with('\n')) text.pop_back();
  std::string shown;
  for (const char c : text) c == '\n' ? shown += " / " : shown += c;
  return shown;
}

}  // namespace

Result<std::string> start_head(storage::ProgramStore& store, const storage::Run& run,
                               const ProgramPlace& place, machines::StartHead choice) {
  if (place.byte == 0 || choice == machines::StartHead::Set) return std::string();
  ModalScan scan(run.control);
  if (auto scanned = scan_program(store, run, place, scan); !scanned) return fail(scanned.error());
  const auto words = scan.relied_on();
  if (words.empty()) return std::string();
  std::vector<ModalWord> lost;
  std::ranges::copy_if(words, std::back_inserter(lost),
                       [](const ModalWord& word) { return !word.can_be_sent; });
  if (!lost.empty()) {
    return fail(Errc::Conflict,
                "line {} and what follows rely on {}; of these {} cannot be sent again by itself: "
                "begin at an earlier block, or give --modes-set when all of it is in force at the "
                "control",
                place.line, words_text(words), words_text(lost));
  }
  if (choice == machines::StartHead::Send) return head_text(words);
  return fail(Errc::Conflict,
              "line {} and what follows rely on {}, which would not be sent: --send-head sends "
              "'{}' first, --modes-set confirms that all of it is in force at the control",
              place.line, words_text(words), one_line(head_text(words)));
}

}  // namespace dripline::ports
