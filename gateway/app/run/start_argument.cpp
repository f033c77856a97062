#include "gateway/app/run/start_argument.hpp"

#include <charconv>

#include "protocol/dds/message.hpp"

namespace dripline::gateway {
namespace {

constexpr std::string_view kPart = "part=", kTest = "test=yes";

std::string_view take_word(std::string_view& text) {
  const std::size_t end = text.find(' ');
  const std::string_view word = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  return word;
}

/// A number from 1 on after `key`; nothing: the word is another one.
std::optional<Result<std::uint32_t>> read_count(std::string_view word, std::string_view key) {
  if (!word.starts_with(key)) return std::nullopt;
  std::uint32_t count = 0;
  const char* end = word.data() + word.size();
  const auto read = std::from_chars(word.data() + key.size(), end, count);
  if (read.ec != std::errc{} || read.ptr != end || count == 0)
    return fail(Errc::Syntax, "a start with '{}': expected {}1, {}2 ...", word, key, key);
  return Result<std::uint32_t>(count);
}

Result<void> read_choice(std::string_view word, StartArgument& start) {
  if (word == "memory=begin") {
    start.memory = StartMemory::Begin;
  } else if (word == "memory=now") {
    start.memory = StartMemory::Now;
  } else if (word == "head=send") {
    start.head = line::HeadChoice::Send;
  } else if (word == "head=set") {
    start.head = line::HeadChoice::Set;
  } else if (word == kTest) {
    start.is_test = true;
  } else if (const auto pass = read_count(word, "pass=")) {
    if (!*pass) return fail(pass->error());
    start.pass = **pass;
  } else if (const auto part = read_count(word, kPart)) {
    if (!*part) return fail(part->error());
    start.part = **part;
  } else {
    return fail(Errc::Syntax, "a start with '{}', which this gateway does not know", word);
  }
  return {};
}

constexpr std::string_view kRestart = "restart=";
constexpr std::string_view kAt = "at=";

Result<RestartArgument> parse_restart(std::string_view text) {
  RestartArgument restart;
  restart.run = take_word(text).substr(kRestart.size());
  if (restart.run.empty()) return fail(Errc::Syntax, "a restart without a run");
  if (text.empty()) return restart;
  const std::string_view at = take_word(text);
  if (!at.starts_with(kAt) || !text.empty())
    return fail(Errc::Syntax, "a restart with '{}', expected at=PLACE alone", at);
  auto place = parse_restart_place(at.substr(kAt.size()));
  if (!place) return fail(place.error());
  restart.at = *std::move(place);
  return restart;
}

}  // namespace

Result<StartArgument> parse_start_argument(std::string_view text) {
  StartArgument start;
  if (text.starts_with(kRestart)) {
    auto restart = parse_restart(text);
    if (!restart) return fail(restart.error());
    start.restart = *std::move(restart);
    return start;
  }
  if (text == dds::kMdiStart) {
    start.is_mdi = true;
    return start;
  }
  if (!text.starts_with(kPart) && !text.starts_with(kTest)) start.place = take_word(text);
  while (!text.empty()) {
    if (auto read = read_choice(take_word(text), start); !read) return fail(read.error());
  }
  return start;
}

}  // namespace dripline::gateway
