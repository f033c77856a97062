// A rules file, a NUL, and what a control sends. Properties: any rules file is read or refused; the
// text is cut into the same lines and programs however it arrives; no line is longer than its
// bound; a verdict has an action.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "gateway/line/inbound/inbound_splitter.hpp"
#include "gateway/line/inbound/rule_reader.hpp"

namespace {

using namespace dripline::line;
using What = InboundSplitter::Item::What;

void add(const std::vector<InboundSplitter::Item>& items, std::string& reported) {
  for (const auto& item : items) {
    if (item.what == What::Line && item.text.size() > InboundSplitter::kMaxLine) std::abort();
    // Pieces of a program may be cut anywhere.
    if (item.what != What::ProgramText)
      reported += static_cast<char>('A' + static_cast<int>(item.what));
    reported += item.text;
    if (item.what != What::ProgramText) reported += '\0';
  }
}

std::string reported(const RuleSet& rules, std::string_view text, std::size_t step) {
  InboundSplitter intake(rules);
  std::string all;
  for (std::size_t at = 0; at < text.size(); at += step) {
    add(intake.take(text.substr(at, step)), all);
  }
  add(intake.end(), all);
  return all;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  const auto end = input.find('\0');
  const auto read = read_rules(input.substr(0, end));
  const RuleSet rules = read ? *read : RuleSet{};
  if (end == std::string_view::npos) return 0;
  const auto text = input.substr(end + 1);
  const std::string whole = reported(rules, text, text.size() + 1);
  if (reported(rules, text, 1) != whole || reported(rules, text, 7) != whole) std::abort();
  if (rules.explain(std::string(text)).action.empty()) std::abort();
  return 0;
}
