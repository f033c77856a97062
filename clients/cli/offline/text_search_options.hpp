#pragma once

#include <string>
#include <utility>
#include <vector>

#include "clients/cli/context.hpp"
#include "clients/cli/offline/edited_text.hpp"
#include "clients/tools/program_editing/text_search.hpp"

namespace dripline::cli {

/// --find-text and --change of `dnc edit`, for programs that a control keeps as lines.
class TextSearchOptions {
 public:
  void add_to(Command command);
  bool finds() const { return !wanted_.empty(); }
  bool changes() const { return !replacements_.empty(); }
  /// Errors: Syntax (an option of a search without one).
  Result<void> check() const;
  /// Lists the lines with the text. Exit status 1: there is none.
  int show(Context& context, const EditedText& original) const;
  /// Errors: Unsupported (the control keeps numbered blocks), Conflict (two changes of one text
  /// meet in a line), and those of `change_text`.
  Result<void> add_changes(const EditedText& original,
                           std::vector<program_editing::BlockChange>& changes) const;

 private:
  Result<program_editing::TextPattern> pattern(const EditedText& original,
                                               const std::string& text) const;

  std::vector<std::string> wanted_;
  std::vector<std::pair<std::string, std::string>> replacements_;
  std::string within_;  ///< "10..40"
  bool ignores_case_ = false, is_whole_word_ = false;
};

}  // namespace dripline::cli
