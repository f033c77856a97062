#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "clients/cli/context.hpp"
#include "clients/tools/program_editing/program_edit.hpp"

namespace dripline::cli {

/// A program that is edited: a file, or the newest revision of a program on the server. Nothing is
/// written before `save`.
class EditedText {
 public:
  struct Place {
    std::string file;     ///< empty: `program`
    std::string program;  ///< on the server
    std::string control;  ///< empty: found out from the text, or as the server has it
    std::string output;   ///< file to write; empty: where it came from
    std::string comment;  ///< of the new revision
    bool overrides_protection = false;
  };

  /// On failure it has printed the error and set context.status; `is_open` is then false.
  EditedText(Context& context, Place place);

  bool is_open() const { return is_open_; }
  const std::string& text() const { return text_; }
  /// The editor of its control; nullptr: a program is its lines.
  const program_editing::ProgramEditor* editor() const { return editor_; }
  /// As its control edits it. Errors: those of the editor, or of edit_lines.
  Result<program_editing::EditedProgram> edited(
      std::span<const program_editing::BlockChange> changes) const;
  /// Blocks as the text of an insertion. Errors: those of ProgramEditor::text_of.
  Result<std::string> text_of(std::int64_t first, std::int64_t last) const;
  /// The program is marked as protected against editing.
  bool is_protected() const;
  /// FILE, or the program's name.
  const std::string& name() const;
  /// Writes atomically, or stores a new revision; returns the exit status. `written` names the
  /// target.
  int save(const std::string& text, std::string& written);

 private:
  bool read_file();
  bool pull();
  bool use_control(const std::string& control);
  int save_file(const std::string& text, std::string& written) const;
  int push(const std::string& text, std::string& written);

  Context& context_;
  Place place_;
  std::string text_;
  std::uint64_t revision_ = 0;
  std::string control_;
  const program_editing::ProgramEditor* editor_ = nullptr;
  bool is_open_ = false;
};

}  // namespace dripline::cli
