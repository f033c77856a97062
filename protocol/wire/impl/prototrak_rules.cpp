#include "protocol/wire/impl/control_rules.hpp"

/// ProtoTRAK Plus: blocks end with ';', line ends are layout, a program ends with '%'. After any
/// error nothing is stored.
namespace dripline::wire {
namespace {

constexpr std::size_t kLongestBlock = 255;
constexpr char kSubstitute = 0x1a;  // DOS COPY sends it after a file
constexpr std::string_view kCharacters =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789 +-.;%():/";  // '/' occurs in titles
constexpr std::string_view kMoreInComments = ",'\"!#$&*<=>?@[]_";

class ProtoTrakRules final : public ControlRules {
 public:
  void begin() override {
    block_ = 0;
    is_comment_ = is_line_open_ = false;
    blocks_ = 1;
  }
  bool ends_at(char character) const override { return character == kSubstitute; }
  Result<void> take(char character, TextSink& sink) override;
  void finish(TextSink& sink) override {
    if (is_line_open_) sink.text("\n");
    sink.text("%\n");
  }
  std::optional<Error> fault(LineFault fault) const override {
    return Error{Errc::Corrupt, fmt::format("receive error: {}, block {}; nothing is kept",
                                            fault_text(fault), blocks_)};
  }

 private:
  Result<void> check(char character) const;
  std::size_t block_ = 0;   ///< characters of the block so far
  std::size_t blocks_ = 1;  ///< number of the block being read
  bool is_comment_ = false;
  bool is_line_open_ = false;  ///< the line being delivered has text
};

Result<void> ProtoTrakRules::check(char character) const {
  if (block_ >= kLongestBlock) {
    return fail(Errc::Syntax, "P102: block {} has no ';' within {} characters", blocks_,
                kLongestBlock);
  }
  const bool is_known = kCharacters.find(character) != std::string_view::npos ||
                        (is_comment_ && kMoreInComments.find(character) != std::string_view::npos);
  if (!is_known) {
    return fail(Errc::Syntax, "P103: block {} has the character '{}'", blocks_, character);
  }
  return {};
}

Result<void> ProtoTrakRules::take(char character, TextSink& sink) {
  if (character == '\t') return {};
  if (character == '\n') {
    if (std::exchange(is_line_open_, false)) sink.text("\n");
    return {};
  }
  if (character >= 'a' && character <= 'z') character = static_cast<char>(character - 'a' + 'A');
  if (character == '(') is_comment_ = true;
  if (const auto checked = check(character); !checked) return checked;
  if (character == ')') is_comment_ = false;
  ++block_;
  is_line_open_ = true;
  sink.text({&character, 1});
  if (character == ';' && !is_comment_) {
    sink.text("\n");
    is_line_open_ = false;
    block_ = 0;
    ++blocks_;
  }
  return {};
}

}  // namespace

std::unique_ptr<ControlRules> make_prototrak_rules() {
  return std::make_unique<ProtoTrakRules>();
}

}  // namespace dripline::wire
