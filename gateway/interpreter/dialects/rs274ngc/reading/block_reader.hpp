#pragma once

#include "gateway/interpreter/dialects/rs274ngc/run.hpp"

/// One line of text to words, settings, codes and a comment (NIST 3.3). Nothing is executed, no
/// parameter changes.
namespace dripline::interpreter::rs274ngc {

/// Reads the line at `at`, after slash and line number, to its end.
bool read_items(Run& run, const char* at);

/// Moves after the slash and the line number that may begin a line; `is_skip` reports the slash.
bool read_line_head(Run& run, const char*& at, bool& is_skip);

/// Moves after blanks and comments.
bool skip_comments(Run& run, const char*& at);

/// What a line means, before anything of it is executed: which motion its axis words belong to
/// (NIST 3.4), and whether every word has a user; check.cpp.
bool check_line(Run& run);

}  // namespace dripline::interpreter::rs274ngc
