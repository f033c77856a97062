#include "server/api/request.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace dripline::api {

namespace {

int hex_value(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

Result<std::string> percent_decode(std::string_view text, bool plus_is_blank) {
  std::string decoded;
  for (std::size_t i = 0; i < text.size(); ++i) {
    char c = text[i];
    if (c == '+' && plus_is_blank) {
      c = ' ';
    } else if (c == '%') {
      const int high = i + 2 < text.size() ? hex_value(text[i + 1]) : -1;
      const int low = i + 2 < text.size() ? hex_value(text[i + 2]) : -1;
      if (high < 0 || low < 0) return fail(Errc::Syntax, "bad percent escape in the URL");
      c = static_cast<char>(high << 4 | low);
      i += 2;
    }
    if (c == '\0') return fail(Errc::Syntax, "NUL in the URL");
    decoded += c;
  }
  return decoded;
}

Result<std::vector<std::string>> split_path(std::string_view path) {
  std::vector<std::string> segments;
  while (!path.empty()) {
    path.remove_prefix(1);  // the slash
    const std::size_t end = std::min(path.find('/'), path.size());
    auto segment = percent_decode(path.substr(0, end), false);
    if (!segment) return fail(segment.error());
    segments.push_back(*std::move(segment));
    path.remove_prefix(end);
  }
  return segments;
}

Result<std::map<std::string, std::string>> split_query(std::string_view query) {
  std::map<std::string, std::string> values;
  while (!query.empty()) {
    const std::size_t end = std::min(query.find('&'), query.size());
    const std::string_view pair = query.substr(0, end);
    query.remove_prefix(std::min(end + 1, query.size()));
    if (pair.empty()) continue;
    const std::size_t equals = std::min(pair.find('='), pair.size());
    auto name = percent_decode(pair.substr(0, equals), true);
    auto value = percent_decode(pair.substr(std::min(equals + 1, pair.size())), true);
    if (!name) return fail(name.error());
    if (!value) return fail(value.error());
    if (!values.emplace(*name, *std::move(value)).second) {
      return fail(Errc::Syntax, "query parameter '{}' is given twice", *name);
    }
  }
  return values;
}

}  // namespace

Result<Target> parse_target(std::string_view text) {
  if (text.size() > kMaxTarget) {
    return fail(Errc::LimitExceeded, "URL of {} bytes: at most {}", text.size(), kMaxTarget);
  }
  if (text.empty() || text.front() != '/') return fail(Errc::Syntax, "URL without a leading slash");
  const std::size_t question = std::min(text.find('?'), text.size());
  auto segments = split_path(text.substr(0, question));
  if (!segments) return fail(segments.error());
  auto query = split_query(text.substr(std::min(question + 1, text.size())));
  if (!query) return fail(query.error());
  return Target{.segments = *std::move(segments), .query = *std::move(query)};
}

std::string Request::header(const std::string& lower_case_name) const {
  const auto found = headers.find(lower_case_name);
  return found == headers.end() ? std::string() : found->second;
}

Result<std::uint64_t> parse_unsigned(std::string_view text) {
  std::uint64_t value = 0;
  const auto [end, ec] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (ec != std::errc() || end != text.data() + text.size()) {
    return fail(Errc::Syntax, "'{}' is not a number from 0 to 2^64-1", text);
  }
  return value;
}

std::optional<std::string> QueryReader::text(const std::string& name) {
  const auto node = left_.extract(name);
  if (node.empty()) return std::nullopt;
  return node.mapped();
}

std::optional<std::uint64_t> QueryReader::number(const std::string& name, std::uint64_t highest) {
  const auto given = text(name);
  if (!given) return std::nullopt;
  const auto value = parse_unsigned(*given);
  if (value && *value <= highest) return *value;
  if (value) {
    note({Errc::LimitExceeded, fmt::format("{}={}: at most {}", name, *value, highest)});
  } else {
    note({Errc::Syntax, fmt::format("{}: {}", name, value.error().what)});
  }
  return std::nullopt;
}

std::optional<double> QueryReader::real(const std::string& name) {
  const auto given = text(name);
  if (!given) return std::nullopt;
  double value = 0;
  const char* const end = given->data() + given->size();
  const auto read = std::from_chars(given->data(), end, value);
  if (read.ec == std::errc{} && read.ptr == end && std::isfinite(value)) return value;
  note({Errc::Syntax, fmt::format("query parameter '{}' is '{}': a number", name, *given)});
  return std::nullopt;
}

std::optional<UtcTime> QueryReader::time(const std::string& name) {
  const auto given = text(name);
  if (!given) return std::nullopt;
  const auto value = parse_iso8601(*given);
  if (value) return *value;
  note({value.error().code, fmt::format("query parameter '{}': {}", name, value.error().what)});
  return std::nullopt;
}

bool QueryReader::flag(const std::string& name) {
  const std::string given = text(name).value_or("no");
  if (given != "yes" && given != "no")
    note({Errc::Syntax, fmt::format("query parameter '{}' is '{}': yes or no", name, given)});
  return given == "yes";
}

void QueryReader::note(Error error) {
  if (!error_) error_ = std::move(error);
}

Result<void> QueryReader::finish() {
  if (error_) return fail(*error_);
  if (left_.empty()) return {};
  return fail(Errc::Syntax, "query parameter '{}' is not known here", left_.begin()->first);
}

Result<std::optional<ByteRange>> parse_byte_range(std::string_view header, std::uint64_t size) {
  if (header.empty()) return std::nullopt;
  constexpr std::string_view kUnit = "bytes=";
  if (!header.starts_with(kUnit)) return fail(Errc::Syntax, "Range '{}' is not in bytes", header);
  const std::string_view range = header.substr(kUnit.size());
  if (range.find(',') != std::string_view::npos) {
    return fail(Errc::Unsupported, "Range '{}': one range only", header);
  }
  const std::size_t dash = range.find('-');
  if (dash == std::string_view::npos) return fail(Errc::Syntax, "Range '{}' has no dash", header);
  const std::string_view from = range.substr(0, dash);
  const std::string_view to = range.substr(dash + 1);
  const auto first = from.empty() ? Result<std::uint64_t>{0} : parse_unsigned(from);
  const auto last = to.empty() ? Result<std::uint64_t>{size} : parse_unsigned(to);
  if (!first || !last || (from.empty() && to.empty())) {
    return fail(Errc::Syntax, "Range '{}' is not a range of numbers", header);
  }
  if (from.empty()) {  // the last n bytes
    const std::uint64_t length = std::min(*last, size);
    if (length == 0)
      return fail(Errc::LimitExceeded, "Range '{}' of {} bytes is empty", header, size);
    return ByteRange{.first = size - length, .length = length};
  }
  if (*first >= size || *last < *first) {
    return fail(Errc::LimitExceeded, "Range '{}' lies outside of {} bytes", header, size);
  }
  return ByteRange{.first = *first, .length = std::min(*last, size - 1) - *first + 1};
}

}  // namespace dripline::api
