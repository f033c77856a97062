#include "gateway/interpreter/dialects/tnc155/reading/text_cursor.hpp"

#include <fmt/format.h>
#include <algorithm>

namespace dripline::interpreter::tnc155 {
namespace {

std::string number_of(std::int64_t steps) {
  const double value = static_cast<double>(steps) / Value::kStepsPerUnit;
  return fmt::format("{}", value);
}

}  // namespace

void TextCursor::skip_controls() {
  while (at_ != end_ && static_cast<unsigned char>(*at_) <= ' ') ++at_;
}

bool TextCursor::wrong(ErrorCode code, const char* at, std::string detail) {
  fault_->code = code;
  fault_->column = static_cast<std::uint32_t>(at - begin_) + 1;
  fault_->detail = std::move(detail);
  return false;
}

bool TextCursor::missing(std::string_view name) {
  return wrong(ErrorCode::BlockFormatIncorrect, at_, fmt::format("{} has no value", name));
}

bool TextCursor::unexpected() {
  peek();
  if (at_ == end_) return wrong("the block is not complete");
  const char c = *at_;
  if (c > ' ' && c < 0x7F) return wrong(fmt::format("'{}' is not expected here", c));
  return wrong(fmt::format("character {} is not expected here", static_cast<unsigned char>(c)));
}

bool TextCursor::read_q(Value& value, bool is_negated, const Range& range, std::string_view name,
                        const char* start) {
  if (!range.may_be_q) {
    return wrong(ErrorCode::BlockFormatIncorrect, start,
                 fmt::format("{} cannot be a Q parameter", name));
  }
  ++at_;
  std::int32_t parameter = 0;
  if (!read_integer(parameter, 0, 99, "Q")) return false;
  value = Value::q(parameter, is_negated);
  return true;
}

bool TextCursor::read_millionths(std::int32_t& value, std::int32_t high, std::string_view name) {
  peek();
  const char* start = at_;
  std::int64_t number = 0;
  while (is_digit(*at_) && number < 1'000'000'000) number = number * 10 + (*at_++ - '0');
  auto digits = at_ - start;
  number *= 1'000'000;
  if (*at_ == ',' || *at_ == '.') {
    ++at_;
    for (std::int64_t step = 100'000; is_digit(*at_); ++at_, ++digits, step /= 10) {
      number += step * (*at_ - '0');
      if (step == 0 && *at_ != '0') {
        return wrong(ErrorCode::EntryOutOfRange, start,
                     fmt::format("{} {} has more than 6 decimals", name, word_at(start)));
      }
    }
  }
  if (digits == 0) return missing(name);
  if (number > high) {
    return wrong(ErrorCode::EntryOutOfRange, start,
                 fmt::format("{} {} is not within 0 to 99.999999", name, word_at(start)));
  }
  value = static_cast<std::int32_t>(number);
  return true;
}

/// The number as written in the text.
std::string TextCursor::word_at(const char* start) const {
  std::string word;
  for (const char* at = start; at != end_ && word.size() < 24; ++at) {
    const bool is_part = is_digit(*at) || *at == '+' || *at == '-' || *at == ',' || *at == '.';
    if (!is_part && *at != ' ') break;
    if (is_part) word += *at;
  }
  return word;
}

/// Leading zeros are not significant.
std::int64_t TextCursor::long_number(const char* start) const {
  constexpr std::int64_t kTooLong = 1'000'000'000;
  std::int64_t number = 0;
  for (; start != at_ && number < kTooLong; ++start) number = number * 10 + (*start - '0');
  return number;
}

bool TextCursor::read_many_decimals(const char* start, const char* decimals, std::int64_t& steps,
                                    std::string_view name) {
  const char* const after = decimals + (is_inch() ? 4 : 3);
  if (std::any_of(after, at_, [](char c) { return c != '0'; })) return too_fine(start, name);
  std::int64_t fraction = 0;
  for (int i = 0; i < 4; ++i) fraction = fraction * 10 + (decimals[i] - '0');
  steps += fraction;
  return true;
}

bool TextCursor::too_fine(const char* start, std::string_view name) {
  return wrong(
      ErrorCode::EntryOutOfRange, start,
      fmt::format("{} {} has more than {} decimals", name, word_at(start), is_inch() ? 4 : 3));
}

bool TextCursor::out_of_range(const char* start, std::string_view name, std::int64_t low,
                              std::int64_t high) {
  return wrong(ErrorCode::EntryOutOfRange, start,
               fmt::format("{} {} is not within {} to {}", name, word_at(start), low, high));
}

bool TextCursor::outside(const char* start, std::string_view name, const Range& range,
                         std::int64_t steps) {
  if (range.is_degrees && steps >= range.low && steps <= range.high) {
    return wrong(ErrorCode::EntryOutOfRange, start,
                 fmt::format("{} {} has more than 3 decimals", name, word_at(start)));
  }
  return wrong(ErrorCode::EntryOutOfRange, start,
               fmt::format("{} {} is not {} {} to {}", name, word_at(start),
                           range.is_whole ? "a whole number within" : "within",
                           number_of(range.low), number_of(range.high)));
}

}  // namespace dripline::interpreter::tnc155
