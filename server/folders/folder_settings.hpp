#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/base/result.hpp"

namespace re2 {
class RE2;
}

namespace dripline::folders {

/// What becomes of files whose names fit. The texts may hold `{NAME}` for a group `(?P<NAME>...)`
/// of the pattern, and {name}, {stem}, {extension} and {owner} of the file.
struct NameRule {
  std::shared_ptr<const re2::RE2> matches;  ///< the whole file name
  std::string program = "{stem}";
  std::string machine, control, comment;  ///< empty: the folder's
  bool is_ignored = false;                ///< such files are left where they are
};

/// A folder into which others write programs.
struct FolderSettings {
  std::string name;
  std::filesystem::path path;
  std::string machine;  ///< the control that the programs are for; its setup is used for the check
  std::string control;  ///< without a machine; empty: determined from the text
  std::string author;   ///< of the revisions, may hold {owner}; empty: "folder NAME"
  std::string comment = "{name}";
  bool is_checked = true;  ///< a program with an alarm is not taken
  std::chrono::milliseconds unchanged_time{
      2000};                             ///< a file is complete when it did not change for so long
  std::chrono::milliseconds poll{5000};  ///< two looks at the folder are at most so far apart
  std::uint64_t max_bytes = 256ull << 20;        ///< of a file
  std::string done = "done", failed = "failed";  ///< folders below `path`
  std::vector<NameRule> rules;                   ///< the first that fits; none: every file

  static constexpr std::size_t kMaxFolders = 32;
  static constexpr std::size_t kMaxRules = 100;
};

/// Reads the tables `[[folder]]` of a configuration; everything else in it is left out. The format:
/// deploy/examples/folders.toml. Errors: Syntax (also an unknown key), LimitExceeded, Conflict (two
/// folders with one name or path); they name line and key.
Result<std::vector<FolderSettings>> read_folders(std::string_view toml);

}  // namespace dripline::folders
