// The events of a ProtoTRAK and the plain language of a TNC.
#include <algorithm>

#include "gateway/line/heads/modal_scan.hpp"
#include "gateway/line/heads/scan_text.hpp"

namespace dripline::line {

/// ProtoTRAK: what comes before the first event is the header; events carry F, T and TC,
/// and begin where the one before ended.
void ModalScan::skip_event(std::string_view text, const Block& block) {
  const bool is_event = std::ranges::any_of(
      block, [](const Word& word) { return word.letter == 'G' && tenths(word.value) >= 1000; });
  has_events_ = has_events_ || is_event;
  const std::string_view bare = without_blanks(text);
  if (!has_events_) {
    if (block.empty() || bare.starts_with('%')) return;
    const auto before = in_force_.find(ModalGroup::Header);
    set(ModalGroup::Header, before == in_force_.end()
                                ? std::string(bare)
                                : before->second.words + "\n" + std::string(bare));
    return;
  }
  for (const Word& word : block) {
    if (word.letter == 'F') set(ModalGroup::Feed, word.text(), false);
    if (word.letter == 'T' && word.is_number && !word.value.empty()) {
      set(ModalGroup::Tool, word.text(), false);
    }
    if (word.letter == 'C' && &word != block.data() && (&word)[-1].letter == 'T') {
      set(ModalGroup::EventOffset, "T" + word.text(), false);
    }
  }
  if (is_event)
    set(ModalGroup::EventBegin, "the end of the event, where the next one begins", false);
}

/// A TNC's program is one from its first block to its END line: nothing of it is sent again.
void ModalScan::skip_plain_language(std::string_view text) {
  std::string_view bare = without_blanks(text.substr(0, text.find(';')));
  const auto first = bare.find_first_not_of("0123456789 ");
  if (first == std::string_view::npos) return;
  const std::string_view words = bare.substr(first);
  if (words.starts_with("BEGIN PGM") || bare.starts_with('%')) {
    return set(ModalGroup::Header, std::string(words), false);
  }
  if (words.starts_with("TOOL CALL")) return set(ModalGroup::Tool, std::string(words), false);
  if (words.starts_with("CC") || words.starts_with("FN") || words.starts_with("CYCL DEF") ||
      words.starts_with("CALL") || words.starts_with("G")) {
    return name_unknown(words);
  }
  for (std::size_t at = 0; at < words.size();) {
    const auto end = std::min(words.find(' ', at), words.size());
    const std::string_view word = words.substr(at, end - at);
    if (word == "R0" || word == "RL" || word == "RR" || word == "R") {
      set(ModalGroup::Compensation, std::string(word), false);
    }
    if (word.size() > 1 && word[0] == 'F') set(ModalGroup::Feed, std::string(word), false);
    if (word == "M3" || word == "M4" || word == "M5" || word == "M03" || word == "M04") {
      set(ModalGroup::Spindle, std::string(word), false);
    }
    at = end + 1;
  }
}

/// The header is always needed: a program without it is read in other units.
bool ModalScan::look_event(const Block& block) {
  bool is_event = false, has_begin = false;
  for (const Word& word : block) {
    if (word.letter == 'G' && tenths(word.value) >= 1000) is_event = true;
    if (word.letter == 'B' && &word != block.data() && (&word)[-1].letter == 'X') has_begin = true;
    if (word.letter == 'F') drop(ModalGroup::Feed);
    if (word.letter == 'T' && !word.value.empty()) drop(ModalGroup::Tool);
    if (word.letter == 'C' && &word != block.data() && (&word)[-1].letter == 'T') {
      drop(ModalGroup::EventOffset);
    }
  }
  if (has_begin) drop(ModalGroup::EventBegin);
  return !is_event;
}

}  // namespace dripline::line
