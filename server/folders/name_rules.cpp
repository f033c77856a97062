#include "server/folders/name_rules.hpp"

#include <re2/re2.h>
#include <algorithm>
#include <array>
#include <map>
#include <vector>

#include "protocol/base/names.hpp"
#include "protocol/base/utf8.hpp"

namespace dripline::folders {
namespace {

constexpr std::size_t kMaxComment = 1024;
constexpr std::size_t kMaxAuthor = 64;

using Values = std::map<std::string, std::string, std::less<>>;

/// `{NAME}` becomes its value; what has none stays, so that a mistake is seen.
std::string fill_in(std::string_view text, const Values& values) {
  std::string filled;
  while (!text.empty()) {
    const auto open = text.find('{');
    filled += text.substr(0, open);
    if (open == std::string_view::npos) return filled;
    text.remove_prefix(open);
    const auto close = text.find('}');
    const auto found =
        close == std::string_view::npos ? values.end() : values.find(text.substr(1, close - 1));
    if (found == values.end()) {
      filled += text.front();
      text.remove_prefix(1);
    } else {
      filled += found->second;
      text.remove_prefix(close + 1);
    }
  }
  return filled;
}

Values values_of(const std::string& file, const std::string& owner) {
  const auto dot = file.rfind('.');
  const bool has_extension = dot != std::string::npos && dot > 0;
  return {{"name", file},
          {"stem", has_extension ? file.substr(0, dot) : file},
          {"extension", has_extension ? file.substr(dot + 1) : ""},
          {"owner", owner}};
}

/// Adds the groups of the pattern; false: it does not fit.
bool fits(const re2::RE2& pattern, const std::string& file, Values& values) {
  const int groups = pattern.NumberOfCapturingGroups() + 1;
  std::vector<re2::StringPiece> found(static_cast<std::size_t>(groups));
  const re2::StringPiece text(file.data(), file.size());
  if (!pattern.Match(text, 0, text.size(), re2::RE2::ANCHOR_BOTH, found.data(), groups))
    return false;
  for (const auto& [name, group] : pattern.NamedCapturingGroups()) {
    const auto& piece = found.at(static_cast<std::size_t>(group));
    values[name] = std::string(piece.data() == nullptr ? "" : piece.data(), piece.size());
  }
  return true;
}

std::string either(const std::string& first, const std::string& second) {
  return first.empty() ? second : first;
}

/// A control character (C1, of two bytes, too), or one with a meaning in names.
bool is_special(std::string_view character) {
  const auto first = static_cast<unsigned char>(character.front());
  if (character.size() == 2)
    return first == 0xc2 && static_cast<unsigned char>(character.back()) < 0xa0;
  return character.size() == 1 && (first < 0x20 || first == 0x7f || first == '/' || first == '%');
}

Result<void> check_names(const NamedProgram& named, const std::string& file) {
  if (auto good = check_program_name(named.program); !good)
    return fail(good.error().code, "file {}: {}", file, good.error().what);
  if (named.machine.empty()) return {};
  if (auto good = check_machine_name(named.machine); !good)
    return fail(good.error().code, "file {}: {}", file, good.error().what);
  return {};
}

}  // namespace

Result<NamedProgram> name_program(const FolderSettings& folder, const std::string& file,
                                  const std::string& owner) {
  Values values = values_of(file, owner);
  const NameRule every_file;
  const NameRule* rule = folder.rules.empty() ? &every_file : nullptr;
  for (const NameRule& candidate : folder.rules) {
    if (!fits(*candidate.matches, file, values)) continue;
    rule = &candidate;
    break;
  }
  if (rule == nullptr)
    return fail(Errc::NotFound, "file {}: no rule of folder {} fits its name", file, folder.name);
  NamedProgram named;
  named.is_ignored = rule->is_ignored;
  if (named.is_ignored) return named;
  named.program = fill_in(rule->program, values);
  named.machine = fill_in(either(rule->machine, folder.machine), values);
  named.control = fill_in(either(rule->control, folder.control), values);
  named.comment = fill_in(either(rule->comment, folder.comment), values).substr(0, kMaxComment);
  named.author = fill_in(folder.author, values).substr(0, kMaxAuthor);
  if (named.author.empty()) named.author = "folder " + folder.name;
  if (auto good = check_names(named, file); !good) return fail(good.error());
  return named;
}

bool is_temporary_name(std::string_view name) {
  constexpr std::array<std::string_view, 6> kEndings{"~",        ".tmp",        ".part",
                                                     ".partial", ".crdownload", ".filepart"};
  constexpr std::array<std::string_view, 2> kNames{"Thumbs.db", "desktop.ini"};
  if (name.starts_with('.')) return true;
  return std::ranges::any_of(kEndings, [&](auto ending) { return name.ends_with(ending); }) ||
         std::ranges::find(kNames, name) != kNames.end();
}

std::string printable_name(std::string_view name) {
  constexpr std::size_t kLongest = 200;
  std::string printable;
  while (!name.empty()) {
    const std::size_t length = utf8_length(name);
    const std::string_view character = name.substr(0, std::max<std::size_t>(length, 1));
    std::string shown;
    if (length > 0 && !is_special(character)) {
      shown = character;
    } else {
      for (const char c : character) shown += fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
    if (printable.size() + shown.size() > kLongest) break;
    printable += shown;
    name.remove_prefix(character.size());
  }
  return printable;
}

bool is_printable_name(std::string_view name) {
  return printable_name(name) == name;
}

}  // namespace dripline::folders
