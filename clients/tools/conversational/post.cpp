#include "clients/tools/conversational/post.hpp"

#include <fmt/format.h>

#include "clients/tools/conversational/impl/posting.hpp"
#include "clients/tools/conversational/sequence.hpp"

namespace dripline::conversational {

BlockText& BlockText::code(std::string_view text) {
  if (text.empty()) return *this;
  if (!text_.empty() && text.front() != ',') text_ += ' ';
  text_ += text;
  return *this;
}

BlockText& BlockText::word(std::string_view letters, const Entry& value) {
  return value ? code(std::string(letters) + number_text(*value)) : *this;
}

void Posting::block(const BlockText& block) {
  if (block.text().empty()) return;
  text_ += block.text();
  text_ += '\n';
}

void Posting::parameter(int number, const Entry& value) {
  if (value) parameter(number, number_text(*value));
}

void Posting::parameter(int number, std::string_view expression) {
  block(fmt::format("P{} = {}", number, expression));
}

void Posting::clearances(const Entry& start_x, const Entry& start_z) {
  parameter(140, start_z);
  parameter(139, start_x);
}

std::string_view code_of(Compensation compensation) {
  if (compensation == Compensation::Off) return "G40";
  return compensation == Compensation::Left ? "G41" : "G42";
}

Result<std::string> post(const Events& events, const PostOptions& options) {
  if (auto checked = check_sequence(events); !checked) return fail(checked.error());
  Posting out(options);
  for (const Event& event : events) {
    std::visit(
        [&](const auto& record) {
          using Record = std::decay_t<decltype(record)>;
          constexpr bool kIsGeometry = std::is_same_v<Record, Line> || std::is_same_v<Record, Arc>;
          if (!kIsGeometry) out.set_motion("");
          post(out, record);
        },
        event);
  }
  return out.take();
}

}  // namespace dripline::conversational
