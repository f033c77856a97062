#include "server/folders/folder_settings.hpp"

#include <re2/re2.h>
#include <toml++/toml.h>
#include <algorithm>
#include <array>
#include <functional>
#include <optional>

#include "protocol/base/names.hpp"

namespace dripline::folders {
namespace {

constexpr std::size_t kMaxPattern = 256;
constexpr std::size_t kMaxText = 256;
constexpr std::size_t kMaxPath = 1024;
constexpr std::int64_t kPatternMemory = 256 * 1024;
constexpr std::int64_t kMaxSeconds = 3600;
constexpr std::int64_t kMaxMegabytes = 1024;

unsigned line_of(const toml::node& node) {
  return node.source().begin.line;
}

Result<std::string> read_text(std::string_view key, const toml::node& node,
                              std::size_t longest = kMaxText) {
  const auto* text = node.as_string();
  if (text == nullptr)
    return fail(Errc::Syntax, "line {}: {} must be a string", line_of(node), key);
  if (text->get().size() > longest) {
    return fail(Errc::LimitExceeded, "line {}: {} of {} characters: at most {}", line_of(node), key,
                text->get().size(), longest);
  }
  return text->get();
}

Result<bool> read_flag(std::string_view key, const toml::node& node) {
  const auto* flag = node.as_boolean();
  if (flag == nullptr)
    return fail(Errc::Syntax, "line {}: {} must be true or false", line_of(node), key);
  return flag->get();
}

Result<std::int64_t> read_number(std::string_view key, const toml::node& node, std::int64_t least,
                                 std::int64_t highest) {
  const auto* number = node.as_integer();
  if (number == nullptr)
    return fail(Errc::Syntax, "line {}: {} must be a whole number", line_of(node), key);
  if (number->get() < least || number->get() > highest) {
    return fail(Errc::LimitExceeded, "line {}: {} is {}: {} to {}", line_of(node), key,
                number->get(), least, highest);
  }
  return number->get();
}

/// Of a key with that text: the member it is stored in.
template <class Table, std::string Table::*kMember>
Result<void> take_text(Table& table, std::string_view key, const toml::node& node) {
  auto text = read_text(key, node);
  if (!text) return fail(text.error());
  table.*kMember = *std::move(text);
  return {};
}

Result<void> take_pattern(NameRule& rule, std::string_view key, const toml::node& node) {
  const auto text = read_text(key, node, kMaxPattern);
  if (!text) return fail(text.error());
  re2::RE2::Options options;
  options.set_log_errors(false);
  options.set_max_mem(kPatternMemory);
  auto pattern = std::make_shared<const re2::RE2>(*text, options);
  if (!pattern->ok())
    return fail(Errc::Syntax, "line {}: {} '{}': {}", line_of(node), key, *text, pattern->error());
  rule.matches = std::move(pattern);
  return {};
}

Result<void> take_ignore(NameRule& rule, std::string_view key, const toml::node& node) {
  const auto flag = read_flag(key, node);
  if (!flag) return fail(flag.error());
  rule.is_ignored = *flag;
  return {};
}

/// A folder below the hot folder, on the same file system: one step, and not hidden.
template <std::string FolderSettings::*kMember>
Result<void> take_subfolder(FolderSettings& folder, std::string_view key, const toml::node& node) {
  const auto text = read_text(key, node);
  if (!text) return fail(text.error());
  if (text->empty() || text->front() == '.' || text->find('/') != std::string::npos) {
    return fail(Errc::Syntax, "line {}: {} '{}' must be the name of a folder below this one",
                line_of(node), key, *text);
  }
  folder.*kMember = *text;
  return {};
}

Result<void> take_path(FolderSettings& folder, std::string_view key, const toml::node& node) {
  const auto text = read_text(key, node, kMaxPath);
  if (!text) return fail(text.error());
  folder.path = std::filesystem::path(*text).lexically_normal();
  if (folder.path.is_absolute()) return {};
  return fail(Errc::Syntax, "line {}: {} '{}' must be absolute", line_of(node), key, *text);
}

Result<void> take_check(FolderSettings& folder, std::string_view key, const toml::node& node) {
  const auto flag = read_flag(key, node);
  if (!flag) return fail(flag.error());
  folder.is_checked = *flag;
  return {};
}

template <std::chrono::milliseconds FolderSettings::*kMember, std::int64_t kLeast>
Result<void> take_seconds(FolderSettings& folder, std::string_view key, const toml::node& node) {
  const auto number = read_number(key, node, kLeast, kMaxSeconds);
  if (!number) return fail(number.error());
  folder.*kMember = std::chrono::seconds(*number);
  return {};
}

Result<void> take_size(FolderSettings& folder, std::string_view key, const toml::node& node) {
  const auto number = read_number(key, node, 1, kMaxMegabytes);
  if (!number) return fail(number.error());
  folder.max_bytes = static_cast<std::uint64_t>(*number) << 20;
  return {};
}

template <class Table>
struct KeyRow {
  std::string_view key;
  Result<void> (*take)(Table&, std::string_view key, const toml::node&);
};

constexpr std::array kRuleKeys{
    KeyRow<NameRule>{"matches", take_pattern},
    KeyRow<NameRule>{"program", take_text<NameRule, &NameRule::program>},
    KeyRow<NameRule>{"machine", take_text<NameRule, &NameRule::machine>},
    KeyRow<NameRule>{"control", take_text<NameRule, &NameRule::control>},
    KeyRow<NameRule>{"comment", take_text<NameRule, &NameRule::comment>},
    KeyRow<NameRule>{"ignore", take_ignore},
};
constexpr std::array kFolderKeys{
    KeyRow<FolderSettings>{"name", take_text<FolderSettings, &FolderSettings::name>},
    KeyRow<FolderSettings>{"path", take_path},
    KeyRow<FolderSettings>{"machine", take_text<FolderSettings, &FolderSettings::machine>},
    KeyRow<FolderSettings>{"control", take_text<FolderSettings, &FolderSettings::control>},
    KeyRow<FolderSettings>{"author", take_text<FolderSettings, &FolderSettings::author>},
    KeyRow<FolderSettings>{"comment", take_text<FolderSettings, &FolderSettings::comment>},
    KeyRow<FolderSettings>{"check", take_check},
    KeyRow<FolderSettings>{"unchanged_seconds", take_seconds<&FolderSettings::unchanged_time, 0>},
    KeyRow<FolderSettings>{"poll_seconds", take_seconds<&FolderSettings::poll, 1>},
    KeyRow<FolderSettings>{"max_mb", take_size},
    KeyRow<FolderSettings>{"done", take_subfolder<&FolderSettings::done>},
    KeyRow<FolderSettings>{"failed", take_subfolder<&FolderSettings::failed>},
};

template <class Table, class Rows>
Result<void> take_key(Table& table, const Rows& rows, std::string_view key,
                      const toml::node& node) {
  const auto row =
      std::ranges::find(rows, key, [](const auto& candidate) { return candidate.key; });
  if (row == rows.end())
    return fail(Errc::Syntax, "line {}: key '{}' of a folder is not known", line_of(node), key);
  return row->take(table, key, node);
}

Result<NameRule> read_rule(const toml::table& table) {
  NameRule rule;
  for (const auto& [key, node] : table) {
    if (auto taken = take_key(rule, kRuleKeys, key.str(), node); !taken) return fail(taken.error());
  }
  if (rule.matches) return rule;
  return fail(Errc::Syntax, "line {}: a rule needs the key matches", line_of(table));
}

Result<std::vector<NameRule>> read_rules(const toml::node& node) {
  const auto* array = node.as_array();
  if (array == nullptr) return fail(Errc::Syntax, "line {}: write [[folder.rule]]", line_of(node));
  if (array->size() > FolderSettings::kMaxRules) {
    return fail(Errc::LimitExceeded, "line {}: more than {} rules", line_of(node),
                FolderSettings::kMaxRules);
  }
  std::vector<NameRule> rules;
  for (const auto& element : *array) {
    if (!element.is_table())
      return fail(Errc::Syntax, "line {}: write [[folder.rule]]", line_of(element));
    auto rule = read_rule(*element.as_table());
    if (!rule) return fail(rule.error());
    rules.push_back(*std::move(rule));
  }
  return rules;
}

/// The name is used in URLs and as an author: the rule of machine names.
Result<void> check_folder(const FolderSettings& folder, unsigned line) {
  if (auto named = check_machine_name(folder.name); !named)
    return fail(named.error().code, "line {}: folder: {}", line, named.error().what);
  if (folder.path.empty())
    return fail(Errc::Syntax, "line {}: folder '{}' has no path", line, folder.name);
  if (folder.done == folder.failed) {
    return fail(Errc::Conflict, "line {}: folder '{}': done and failed are both '{}'", line,
                folder.name, folder.done);
  }
  return {};
}

Result<FolderSettings> read_folder(const toml::table& table) {
  FolderSettings folder;
  for (const auto& [key, node] : table) {
    if (key.str() == "rule") {
      auto rules = read_rules(node);
      if (!rules) return fail(rules.error());
      folder.rules = *std::move(rules);
      continue;
    }
    if (auto taken = take_key(folder, kFolderKeys, key.str(), node); !taken)
      return fail(taken.error());
  }
  if (auto good = check_folder(folder, line_of(table)); !good) return fail(good.error());
  return folder;
}

Result<void> check_unique(const std::vector<FolderSettings>& folders, const FolderSettings& next,
                          unsigned line) {
  for (const auto& folder : folders) {
    if (folder.name != next.name && folder.path != next.path) continue;
    return fail(Errc::Conflict, "line {}: folder '{}' at {} is there twice", line, next.name,
                next.path.string());
  }
  if (folders.size() < FolderSettings::kMaxFolders) return {};
  return fail(Errc::LimitExceeded, "line {}: more than {} folders", line,
              FolderSettings::kMaxFolders);
}

Result<std::vector<FolderSettings>> read_table(const toml::table& table) {
  std::vector<FolderSettings> folders;
  const toml::node* node = table.get("folder");
  if (node == nullptr) return folders;
  const auto* array = node->as_array();
  if (array == nullptr) return fail(Errc::Syntax, "line {}: write [[folder]]", line_of(*node));
  for (const auto& element : *array) {
    if (!element.is_table())
      return fail(Errc::Syntax, "line {}: write [[folder]]", line_of(element));
    auto folder = read_folder(*element.as_table());
    if (!folder) return fail(folder.error());
    if (auto unique = check_unique(folders, *folder, line_of(element)); !unique)
      return fail(unique.error());
    folders.push_back(*std::move(folder));
  }
  return folders;
}

}  // namespace

Result<std::vector<FolderSettings>> read_folders(std::string_view toml) {
  try {
    return read_table(toml::parse(toml));
  } catch (const toml::parse_error& e) {
    return fail(Errc::Syntax, "line {}: {}", e.source().begin.line, e.description());
  }
}

}  // namespace dripline::folders
