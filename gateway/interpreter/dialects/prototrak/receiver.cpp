#include "gateway/interpreter/dialects/prototrak/receiver.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <iterator>

namespace dripline::interpreter::prototrak {
namespace {

constexpr char kDosEnd = 0x1a;
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";  ///< of an editor
constexpr std::string_view kFanucHint = "is this a Fanuc program without the three changes?";

bool is_layout(char c) {
  return c == '\r' || c == '\n' || c == '\t' || c == '\0' || c == 0x7f;
}

bool is_known(char c) {
  return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
         std::string_view(" +-.():/").find(c) != std::string_view::npos;
}

bool names_event(const std::vector<Word>& words) {
  return std::any_of(words.begin(), words.end(), [](const Word& word) {
    const double code = word.number.digits;
    return word.address == Address::G && (code <= 3 || (code >= 100 && code <= 109));
  });
}

/// G20 and G21, also with blanks: lost in a title they would change every length.
bool has_units(std::string_view text) {
  std::string bare;
  std::ranges::copy_if(text, std::back_inserter(bare), [](char c) { return c != ' '; });
  for (const std::string_view code : {"G20", "G21"}) {
    const std::size_t at = bare.find(code);
    if (at != std::string::npos &&
        (at + 3 == bare.size() || bare[at + 3] < '0' || bare[at + 3] > '9'))
      return true;
  }
  return false;
}

char upper(char c) {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

}  // namespace

// Characters to blocks.

Receiver::State Receiver::take(const SourceLine& line) {
  line_ = line.place.line;
  offset_ = line.place.offset;
  for (const char c : line.text) {
    if (state_ != State::Receiving) return state_;
    if (!take_character(upper(c))) return state_ = State::Failed;
    ++offset_;
  }
  return state_;
}

Receiver::State Receiver::end_of_text(std::uint64_t line) {
  line_ = line;
  fail(part_ == Part::Title ? Fault::NoBlockEnd : Fault::NoEnd, "");
  return state_ = State::Failed;
}

Receiver::State Receiver::fail_line(const DiagnosticRow& fault, std::string_view detail) {
  fail(fault, detail);
  return state_ = State::Failed;
}

bool Receiver::take_character(char c) {
  if (is_layout(c)) return true;
  const bool is_mark = offset_ < kByteOrderMark.size() && c == kByteOrderMark[offset_];
  if (is_mark) return true;
  if (c == kDosEnd) {
    notice(Fault::Noticed, "DOS end of file ends the program");
    c = '%';
  }
  if (block_.empty() && !in_comment_ && c != ' ') {
    block_line_ = line_;
    block_offset_ = offset_;
  }
  if (c == '%') {
    const bool has_content = block_.find_first_not_of(' ') != std::string::npos || in_comment_;
    if (part_ == Part::Title || has_content) {
      return fail(Fault::NoBlockEnd, kFanucHint);
    }
    if (part_ == Part::BeforeStart && program_.events.empty()) {
      part_ = Part::Title;
      title_line_ = line_;
      return true;
    }
    state_ = State::Complete;
    return true;
  }
  if (block_.size() >= kMaxBlock) {
    return fail(Fault::NoBlockEnd,
                fmt::format("more than {} characters without ';'; {}", kMaxBlock, kFanucHint));
  }
  // What begins on another line is no title, unless it is marked as one: units may be in it.
  if (part_ == Part::Title && block_.empty()) {
    if (c == ' ') return true;
    if (c != ':' && line_ != title_line_) part_ = Part::Blocks;
  }
  if (part_ == Part::Title) {
    if (c != ';') {
      block_ += c;
      return true;
    }
    part_ = Part::Blocks;
    const bool is_header = block_.starts_with("PN");
    if (!is_header && has_units(block_)) {
      return fail(Fault::NoBlockEnd,
                  fmt::format("the title '{}' has units in it; {}", block_, kFanucHint));
    }
    const bool done = !is_header || end_block();
    block_.clear();
    return done;
  }
  if (in_comment_) {
    in_comment_ = c != ')';
    return true;
  }
  if (c == '(') {
    in_comment_ = true;
    return true;
  }
  if (c == ';') {
    part_ = Part::Blocks;
    const bool done = end_block();
    block_.clear();
    return done;
  }
  if (!is_known(c)) {
    const bool is_control = c >= 0 && c < ' ' && program_.events.empty();
    return fail(is_control ? Fault::NotText : Fault::Character,
                fmt::format("code {}", static_cast<unsigned char>(c)));
  }
  if (c != ' ' || !block_.empty()) block_ += c;
  return true;
}

bool Receiver::end_block() {
  int skipped = 0;
  ReadWords read = read_words(block_, program_.events.empty(), skipped);
  // A title may be passed over. In the block of the first event it would be a coordinate.
  if (skipped > 0 && names_event(read.words)) read = read_words(block_, false, skipped = 0);
  // "G 21" among them are the units of all that follows.
  if (skipped > 0 && block_.starts_with("PN") && has_units(block_) &&
      std::ranges::none_of(read.words, [](const Word& word) { return word.address == Address::G; }))
    return fail(Fault::UnknownWord, block_);
  if (skipped > 0) notice(Fault::Ignored, fmt::format("{} words before the first event", skipped));
  switch (read.fault) {
    case WordFault::None:
      break;
    case WordFault::Character:
      return fail(Fault::Character,
                  std::string(1, block_[std::min<std::size_t>(read.column, block_.size() - 1)]));
    case WordFault::NoNumber:
      return fail(Fault::NoNumber, block_);
    case WordFault::NotAWord:
      return fail(Fault::UnknownWord, block_.substr(read.column));
  }
  BlockWords block;
  for (const Word& word : read.words) {
    if (word.address == Address::G) {
      block.g_codes.push_back(static_cast<int>(std::min(word.number.digits, 999.0)));
    } else {
      block.words.push_back(word);
    }
  }
  sequence_ = -1;
  return apply_modes(block) && take_header_words(block) && apply_modal_words(block) &&
         make_event(block);
}

bool Receiver::fail(const DiagnosticRow& fault, std::string_view detail) {
  // faults of a character are at its line, all others at that of their block
  const bool is_of_block = block_line_ != 0 && fault.id >= Fault::Range.id;
  const std::uint64_t line = is_of_block ? block_line_ : line_;
  failure_ = {line, block_offset_, diagnostic(fault, detail, line)};
  return false;
}

void Receiver::notice(const DiagnosticRow& fault, std::string_view detail) {
  if (notices_.size() >= kMaxNotices) return;
  const std::uint64_t line = block_line_ != 0 ? block_line_ : line_;
  notices_.push_back({line, block_offset_, diagnostic(fault, detail, line)});
}

const Word* Receiver::BlockWords::find(Address address) const {
  for (auto word = words.rbegin(); word != words.rend(); ++word) {  // the last one counts
    if (word->address == address) return &*word;
  }
  return nullptr;
}

bool Receiver::BlockWords::has_g(int code) const {
  return std::find(g_codes.begin(), g_codes.end(), code) != g_codes.end();
}

// Numbers.

double Receiver::largest() const {
  return modal_.is_metric ? 9999.99 : 99.9999 * Length::kMillimetersPerInch;
}

/// To the control's resolution, half away from zero.
double Receiver::rounded(const Word& word, double value) {
  const double steps = modal_.is_metric ? 100 : 10'000;
  const double whole = std::round(value * steps) / steps;
  if (std::fabs(whole - value) > 1e-9) {
    notice(Fault::Noticed, fmt::format("{} is rounded to {}", name_of(word.address), whole));
  }
  return whole;
}

bool Receiver::dimension(const BlockWords& block, Address address, double& mm) {
  const Word* word = block.find(address);
  if (word == nullptr) return true;
  take(address);
  const double written = rounded(*word, word->number.value(modal_.is_metric ? 2 : 4));
  const double value = modal_.is_metric ? written : written * Length::kMillimetersPerInch;
  if (std::fabs(value) > largest() * (1 + 1e-12)) {
    return fail(Fault::Range, fmt::format("{}{} is over {}", name_of(address), written,
                                          modal_.is_metric ? 9999.99 : 99.9999));
  }
  mm = value;
  return true;
}

/// Absolute, or counted from `reference`: by the word's tag, else by G90 or G91.
bool Receiver::coordinate(const BlockWords& block, Address address, double reference, double& mm) {
  const Word* word = block.find(address);
  if (word == nullptr) return true;
  double value = 0;
  if (!dimension(block, address, value)) return false;
  const bool is_incremental =
      word->tag == Tag::None ? modal_.is_incremental : word->tag == Tag::Incremental;
  mm = is_incremental ? reference + value : value;
  return true;
}

bool Receiver::size(const BlockWords& block, Address address, double least, double& mm) {
  const Word* word = block.find(address);
  if (word == nullptr) return true;
  double value = 0;
  if (!dimension(block, address, value)) return false;
  if (value < least * (1 - 1e-12) || word->number.is_negative) {
    return fail(Fault::Range, fmt::format("{}{}", name_of(address), word->number.value(4)));
  }
  mm = value;
  return true;
}

bool Receiver::integer(const BlockWords& block, Address address, std::int64_t least,
                       std::int64_t most, std::int64_t& value) {
  const Word* word = block.find(address);
  if (word == nullptr) return true;
  take(address);
  const double number = word->number.value(0);
  if (number < static_cast<double>(least) || number > static_cast<double>(most) ||
      number != std::floor(number)) {
    return fail(Fault::Range,
                fmt::format("{}{} is not {} to {}", name_of(address), number, least, most));
  }
  value = static_cast<std::int64_t>(number);
  return true;
}

bool Receiver::require(const BlockWords& block, std::initializer_list<Address> addresses) {
  for (const Address address : addresses) {
    if (!block.has(address)) return fail(Fault::MissingWord, name_of(address));
  }
  return true;
}

// Modes and words that stay.

bool Receiver::apply_modes(const BlockWords& block) {
  for (const int code : block.g_codes) {
    switch (code) {
      case 20:
      case 21:
        modal_.is_metric = code == 21;
        if (!has_units_) program_.is_metric = modal_.is_metric;
        has_units_ = true;
        break;
      case 40:
        modal_.side = ToolSide::Center;
        break;
      case 41:
        modal_.side = ToolSide::Left;
        break;
      case 42:
        modal_.side = ToolSide::Right;
        break;
      case 90:
      case 91:
        modal_.is_incremental = code == 91;
        break;
      default:
        if (code > 3 && (code < 100 || code > 109)) {
          notice(Fault::Ignored, fmt::format("G{:02}", code));
        }
    }
  }
  return true;
}

bool Receiver::take_header_words(const BlockWords& block) {
  std::int64_t number = 0;
  if (!integer(block, Address::PN, 0, 99'999'999, number)) return false;
  if (block.has(Address::PN)) {
    if (program_.has_part_number) notice(Fault::Noticed, "part number is given again");
    program_.part_number = static_cast<std::uint32_t>(number);
    program_.has_part_number = true;
  }
  std::int64_t sequence = -1;
  if (!integer(block, Address::N, 0, 9999, sequence)) return false;
  if (sequence > 999) notice(Fault::Noticed, fmt::format("N{} is over 999", sequence));
  sequence_ = sequence;
  return true;
}

bool Receiver::apply_modal_words(const BlockWords& block) {
  if (const Word* word = block.find(Address::F)) {
    const double feed = word->number.value(modal_.is_metric ? 0 : 1);
    const double least = modal_.is_metric ? 5 : 0.1;
    const double most = modal_.is_metric ? 2535 : 99.9;
    if (feed < least || feed > most) {
      return fail(Fault::Range, fmt::format("F{} is not {} to {}", feed, least, most));
    }
    modal_.feed = modal_.is_metric ? feed : feed * Length::kMillimetersPerInch;
    modal_.has_feed = true;
  }
  std::int64_t tool = modal_.tool;
  std::int64_t side = static_cast<std::int64_t>(modal_.side);
  const bool is_repeat = block.has_g(105);
  if (!integer(block, Address::T, 1, 99, tool) || !integer(block, Address::TC, 0, 2, side)) {
    return false;
  }
  if (!is_repeat) {
    if (!size(block, Address::D, 0, modal_.diameter)) return false;
    modal_.tool = static_cast<std::uint8_t>(tool);
  }
  modal_.side = static_cast<ToolSide>(side);
  for (const Word& word : block.words) {
    if (word.address == Address::H || word.address == Address::M || word.address == Address::S) {
      notice(Fault::Ignored, fmt::format("{}{:g}", name_of(word.address), word.number.value(0)));
    }
    if (block.find(word.address) != &word) {
      notice(Fault::Noticed,
             fmt::format("{} is repeated; the last one counts", name_of(word.address)));
    }
  }
  return true;
}

}  // namespace dripline::interpreter::prototrak
