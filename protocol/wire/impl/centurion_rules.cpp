#include <charconv>

#include "protocol/wire/impl/control_rules.hpp"

/// Centurion: a reception may hold several programs, each begun by an O line, or be run while it
/// arrives (DNC). Errors have the control's numbers.
namespace dripline::wire {
namespace {

constexpr std::size_t kDigitsOfName = 4;

bool is_digit(char character) {
  return character >= '0' && character <= '9';
}

/// Finds words of a block that DNC FAST refuses; comments are skipped.
class FastCheck {
 public:
  void begin() { *this = {}; }
  Result<void> take(char character) {
    if (!is_comment_ && is_digit(character) && letter_ == 'G' && number_ < kTooLarge) {
      number_ = number_ * 10 + static_cast<unsigned>(character - '0');
      has_number_ = true;
      return {};
    }
    const bool is_units = letter_ == 'G' && has_number_ && (number_ == 20 || number_ == 21);
    if (is_units && character != '.') {
      return fail(Errc::Unsupported, "error 609: G{} is not allowed in DNC FAST", number_);
    }
    if (character == '(') is_comment_ = true;
    if (character == ')' || character == '\n') is_comment_ = false;
    letter_ = character == 'g' ? 'G' : character;
    number_ = 0;
    has_number_ = false;
    return {};
  }

 private:
  static constexpr unsigned kTooLarge = 100'000;
  char letter_ = '\n';
  unsigned number_ = 0;
  bool has_number_ = false, is_comment_ = false;
};

class CenturionRules final : public ControlRules {
 public:
  explicit CenturionRules(const ControlSettings& settings) : settings_(settings) {}

  void begin() override {
    held_.clear();
    is_line_start_ = true;
    has_text_ = false;
    to_skip_ = settings_.dnc == DncMode::Off ? 0 : settings_.dnc_skip;
    fast_.begin();
  }
  Result<void> take(char character, TextSink& sink) override;
  void finish(TextSink& sink) override {
    if (held_ != "%") deliver(held_, sink);
    held_.clear();
  }
  std::optional<Error> fault(LineFault fault) const override;
  std::optional<Error> overrun(unsigned limit) const override {
    return Error{
        Errc::LimitExceeded,
        fmt::format("error 900: RS232 overrun, the buffer of {} characters is full", limit)};
  }
  Error sending_failed(Error error) const override {
    error.what = "error 319: send aborted: " + error.what;
    return error;
  }
  Error busy() const override {
    if (settings_.dnc == DncMode::Off) return ControlRules::busy();
    return {Errc::Busy, "error 415: no DNC link while a program is running"};
  }
  Result<void> check_begin() const override {
    if (settings_.dnc != DncMode::Continue) return {};
    return fail(Errc::Unsupported, "DNC CONT continues a stored file, not over RS-232");
  }

 private:
  bool splits() const { return settings_.splits_programs && settings_.dnc == DncMode::Off; }
  bool may_be_special(char character) const;
  void end_special(char character, TextSink& sink);
  void deliver(std::string_view text, TextSink& sink);

  ControlSettings settings_;
  std::string held_;  ///< the beginning of a line that may be an O line, or hold only '%'
  bool is_line_start_ = true, has_text_ = false;
  std::uint64_t to_skip_ = 0;
  FastCheck fast_;
};

std::optional<Error> CenturionRules::fault(LineFault fault) const {
  constexpr const char* kTexts[] = {"error 901: RS232 parity error",
                                    "error 902: RS232 framing error", "error 900: RS232 overrun",
                                    "error 903: RS232 break detected"};
  return Error{Errc::Corrupt, kTexts[static_cast<std::size_t>(fault)]};
}

void CenturionRules::deliver(std::string_view text, TextSink& sink) {
  has_text_ = has_text_ || !text.empty();
  sink.text(text);
}

/// Whether `held_` with `character` can still become "%" or an O line.
bool CenturionRules::may_be_special(char character) const {
  if (held_.empty()) return is_line_start_ && (character == '%' || (splits() && character == 'O'));
  return held_.front() == 'O' && is_digit(character) && held_.size() <= kDigitsOfName;
}

/// `character` is not part of the held text.
void CenturionRules::end_special(char character, TextSink& sink) {
  const bool is_program = held_.front() == 'O' && held_.size() > 1 && !is_digit(character);
  if (is_program && has_text_) sink.next_program(held_.substr(1));
  deliver(held_, sink);
  held_.clear();
}

Result<void> CenturionRules::take(char character, TextSink& sink) {
  if (to_skip_ > 0) {
    if (character == '\n') --to_skip_;
    return {};
  }
  if (settings_.dnc == DncMode::Fast) {
    if (const auto taken = fast_.take(character); !taken) return taken;
  }
  if (may_be_special(character)) {
    held_ += character;
    is_line_start_ = false;
    return {};
  }
  is_line_start_ = character == '\n';
  if (held_ == "%" && character == '\n') {  // a line that holds only '%' has no meaning here
    held_.clear();
    return {};
  }
  if (!held_.empty()) end_special(character, sink);
  deliver({&character, 1}, sink);
  return {};
}

}  // namespace

std::unique_ptr<ControlRules> make_centurion_rules(const ControlSettings& settings) {
  return std::make_unique<CenturionRules>(settings);
}

}  // namespace dripline::wire
