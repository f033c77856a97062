#pragma once

#include "gateway/interpreter/dialects/rs274ngc/run.hpp"

/// One line of text to words, settings, codes and a comment (2.2, 2.3). Nothing is executed, no
/// parameter changes.
namespace dripline::interpreter::rs274ngc {

/// Reads the line at `at`, after slash and line number, to its end.
bool read_items(Run& run, const char* at);

/// Moves after the slash and the line number that may begin a line; `is_skip` reports the slash.
bool read_line_head(Run& run, const char*& at, bool& is_skip);

/// Moves after blanks and comments.
bool skip_comments(Run& run, const char*& at);

}  // namespace dripline::interpreter::rs274ngc
