#include "gateway/line/heads/head_scan.hpp"

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

namespace dripline::line {

std::string head_in_one_line(std::string text) {
  while (text.ends_with('\n')) text.pop_back();
  std::string shown;
  for (const char c : text) c == '\n' ? shown += " / " : shown += c;
  return shown;
}

bool HeadScan::take(std::string_view piece) {
  for (const char c : piece) {
    if (is_decided_ || !take(c)) return false;
  }
  return true;
}

bool HeadScan::take(char c) {
  // A run may begin inside a block: its first words are not sent.
  if (at_ == place_.byte && at_ > 0 && !block_.empty()) scan_.skip(std::exchange(block_, {}));
  ++at_;
  if (c != '\n') {
    if (block_.size() < kMaxScannedBlock) block_ += c;
    return true;
  }
  return end_block();
}

bool HeadScan::end_block() {
  const std::string block = std::exchange(block_, {});
  if (at_ > place_.byte) {
    is_decided_ = !scan_.look(block);
  } else {
    scan_.skip(block);
  }
  return !is_decided_;
}

void HeadScan::end() {
  if (is_decided_) return;
  if (end_block()) scan_.end();
}

Result<std::string> HeadScan::head(HeadChoice choice) const {
  if (choice == HeadChoice::Set) return std::string();
  const auto words = scan_.relied_on();
  if (words.empty()) return std::string();
  std::vector<ModalWord> lost;
  std::ranges::copy_if(words, std::back_inserter(lost),
                       [](const ModalWord& word) { return !word.can_be_sent; });
  if (!lost.empty()) {
    return fail(Errc::Conflict,
                "line {} and what follows rely on {}; of these {} cannot be sent again by itself: "
                "begin at an earlier block, or give --modes-set when all of it is in force at the "
                "control",
                place_.line, words_text(words), words_text(lost));
  }
  if (choice == HeadChoice::Send) return head_text(words);
  return fail(Errc::Conflict,
              "line {} and what follows rely on {}, which would not be sent: --send-head sends "
              "'{}' first, --modes-set confirms that all of it is in force at the control",
              place_.line, words_text(words), head_in_one_line(head_text(words)));
}

}  // namespace dripline::line
