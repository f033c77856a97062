#pragma once

#include <string>
#include <string_view>

#include "protocol/base/result.hpp"
#include "server/folders/folder_settings.hpp"

namespace dripline::folders {

/// What a file becomes.
struct NamedProgram {
  std::string program, machine, control, author, comment;
  bool is_ignored = false;  ///< it is left where it is
};

/// By the first rule that fits the file's name. `owner`: the account that owns the file, empty when
/// it is not known. Pure. Errors: NotFound (no rule fits), Syntax and LimitExceeded (the name of
/// the program or machine that comes out), each with the file's name.
Result<NamedProgram> name_program(const FolderSettings& folder, const std::string& file,
                                  const std::string& owner);

/// Files that their writers rename when they are complete, and those of editors and systems: they
/// begin with a dot, end with `~`, .tmp, .part, .partial, .crdownload or .filepart, or are
/// Thumbs.db or desktop.ini.
bool is_temporary_name(std::string_view name);

/// The name as it may be printed and used for a file: control characters, `/`, `%` and bytes that
/// are no UTF-8 as %XX; at most 200 bytes.
std::string printable_name(std::string_view name);
/// Whether that is the name itself.
bool is_printable_name(std::string_view name);

}  // namespace dripline::folders
