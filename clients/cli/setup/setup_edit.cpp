#include "clients/cli/setup/setup_edit.hpp"

#include <toml++/toml.h>
#include <algorithm>
#include <vector>

namespace dripline::cli {
namespace {

struct Splice {
  std::size_t begin, end;
  const std::string* value;
};

/// Where a line and a column lie, both from 1; the columns of a line are characters, not bytes.
std::size_t offset_of(std::string_view text, const toml::source_position& at) {
  std::size_t offset = 0;
  for (toml::source_index line = 1; line < at.line; ++line) {
    offset = std::min(text.find('\n', offset), text.size() - 1) + 1;
  }
  const auto is_continued = [&] {
    return offset < text.size() && (static_cast<unsigned char>(text[offset]) & 0xC0) == 0x80;
  };
  for (toml::source_index column = 1; column < at.column && offset < text.size(); ++column) {
    ++offset;
    while (is_continued()) ++offset;
  }
  return offset;
}

Result<toml::table> parse(std::string_view text) {
  try {
    return toml::parse(text);
  } catch (const toml::parse_error& error) {
    return fail(Errc::Syntax, "line {}: {}", error.source().begin.line, error.description());
  }
}

}  // namespace

Result<std::string> with_numbers(std::string_view toml, std::span<const SetupChange> changes) {
  const auto table = parse(toml);
  if (!table) return fail(table.error());
  std::vector<Splice> splices;
  for (const SetupChange& change : changes) {
    const auto found = table->at_path(change.path);
    if (!found.is_number()) {
      return fail(Errc::NotFound, "the setup has no number at {}", change.path);
    }
    const toml::source_region& region = found.node()->source();
    splices.push_back({offset_of(toml, region.begin), offset_of(toml, region.end), &change.value});
  }
  std::ranges::sort(splices, std::greater{}, &Splice::begin);
  std::string text(toml);
  for (const Splice& splice : splices) {
    text.replace(splice.begin, splice.end - splice.begin, *splice.value);
  }
  return text;
}

}  // namespace dripline::cli
