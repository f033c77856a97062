#pragma once

#include <string_view>

#include "gateway/line/inbound/rule_set.hpp"
#include "protocol/base/result.hpp"

namespace dripline::line {

/// Reads a port's rules file. Sets and their rules keep their order:
///
///     reply = "O9998"              # answers to the control bear this number
///     [[set]]
///     name = "requests"
///     program = "O9999"            # for all rules of the set that name no program
///     [[set.rule]]
///     name = "send"                # "rule 1" without
///     trigger = "PRG"              # a comment (PRG=...)
///     action = "send"              # or directory restart next_job program report ignore
///     argument = "O{}"             # {}: what the trigger or the pattern found
///     [[set.rule]]
///     matches = "^PROBE (.*)"      # a regular expression of at most 256 characters
///     kind = "line"                # or "program"
///     action = "report"
///     probe = true
///
/// Rules outside of a set (`[[rule]]`) are tried first. Errors: Syntax (names line, key and value;
/// an unknown key too), LimitExceeded (more than 64 rules).
Result<RuleSet> read_rules(std::string_view toml);

}  // namespace dripline::line
