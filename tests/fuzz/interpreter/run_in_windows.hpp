#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "gateway/interpreter/registry.hpp"

namespace dripline::interpreter {

/// Runs at most 2,000 blocks of `text`, given in windows of at most `spare` bytes more than asked
/// for, each after one NotYet; questions get fixed answers. The events as text. Traps when the
/// program neither continues nor ends, and when a snapshot does not restore.
std::vector<std::string> run_in_windows(const Dialect& dialect, std::string_view text,
                                        std::size_t spare, const Setup& setup = {});

/// Traps when an axis word of an executed block does nothing (tests/support/vanished_words.hpp).
void expect_no_vanished_word(const Dialect& dialect, std::string_view text,
                             const Setup& setup = {});

}  // namespace dripline::interpreter
