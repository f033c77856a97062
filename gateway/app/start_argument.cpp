#include "gateway/app/start_argument.hpp"

#include <charconv>

namespace dripline::gateway {
namespace {

std::string_view take_word(std::string_view& text) {
  const std::size_t end = text.find(' ');
  const std::string_view word = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  return word;
}

Result<void> read_choice(std::string_view word, StartArgument& start) {
  constexpr std::string_view kPass = "pass=";
  if (word == "memory=begin") {
    start.memory = StartMemory::Begin;
  } else if (word == "memory=now") {
    start.memory = StartMemory::Now;
  } else if (word.starts_with(kPass)) {
    std::uint32_t pass = 0;
    const char* end = word.data() + word.size();
    const auto read = std::from_chars(word.data() + kPass.size(), end, pass);
    if (read.ec != std::errc{} || read.ptr != end || pass == 0)
      return fail(Errc::Syntax, "a start with '{}': expected pass=1, pass=2 ...", word);
    start.pass = pass;
  } else {
    return fail(Errc::Syntax, "a start with '{}', which this gateway does not know", word);
  }
  return {};
}

}  // namespace

Result<StartArgument> parse_start_argument(std::string_view text) {
  StartArgument start;
  start.place = take_word(text);
  while (!text.empty()) {
    if (auto read = read_choice(take_word(text), start); !read) return fail(read.error());
  }
  return start;
}

}  // namespace dripline::gateway
