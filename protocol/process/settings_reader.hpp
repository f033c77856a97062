#pragma once

#include <filesystem>
#include <functional>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "protocol/process/settings_table.hpp"

namespace CLI {
class App;
}

namespace dripline::process {

/// Reads the rows of a table into one Options object: from a TOML file, then from the command line,
/// whose values win. Every error names the place: `line 3: lease-ms: ...` or `--lease-ms: ...`.
/// Rows and object must outlive it. The environment is not read here: what comes from it
/// (protocol/base/private_folder.hpp) are defaults, so it belongs into the object before the
/// reader.
class SettingsReader {
 public:
  template <class Options>
  SettingsReader(std::span<const SettingRow<Options>> rows, Options& options) {
    for (const SettingRow<Options>& row : rows) {
      std::string fallback(row.fallback);
      if (fallback.empty() && row.value.show != nullptr) fallback = row.value.show(options);
      settings_.push_back(
          {row.key, row.type, row.unit, std::move(fallback), row.text, row.value.written,
           [&row, &options](std::string_view text) { return row.value.set(options, text); }});
    }
  }
  SettingsReader(const SettingsReader&) = delete;
  SettingsReader& operator=(const SettingsReader&) = delete;

  /// Keys without a row that the caller reads by itself, such as a table `[[port]]`.
  using Others = std::initializer_list<std::string_view>;

  /// Sets every key of a TOML text. Errors: Syntax (not TOML, an unknown key, a wrong type), those
  /// of the rows.
  Result<void> read_toml(std::string_view text, Others others = {}) const;
  /// The same from a file; errors begin with its name. Errors: also NotFound.
  Result<void> read_file(const std::filesystem::path& path, Others others = {}) const;

  /// Adds an option for each row; parsing keeps what is given for `apply_command_line`. The reader
  /// must not move from here on.
  void declare(CLI::App& app);
  Result<void> apply_command_line() const;

 private:
  struct Setting {
    std::string_view key, type, unit;
    std::string fallback;
    std::string_view text;
    Written written{};
    std::function<Result<void>(std::string_view)> set;
  };

  std::vector<Setting> settings_;
  std::vector<std::pair<const Setting*, std::string>> given_;  ///< on the command line, in order
};

}  // namespace dripline::process
