#pragma once

#include <string>

#include "clients/tools/report_template/report_state.hpp"
#include "clients/tools/report_template/report_template.hpp"

namespace dripline::report_template {

/// What a line gives for one value.
struct ValueParts {
  std::string raw;   ///< name of the characteristic as the line has it
  std::string name;  ///< as the rule makes it
  LineNumbers numbers;
  std::string unit, tool;  ///< in force; may be empty
};

/// The line goes before the characteristic's definition, this before the rule's and this before the
/// template's. Errors: Syntax (no name, no actual value), Conflict (limits that exclude each other
/// or need a nominal), LimitExceeded (the name's length).
Result<Value> make_value(const ReportTemplate& report_template, const LineRule& rule,
                         const ValueParts& parts);

/// `D{feature}` with the fields filled in. Errors: NotFound (no such field).
Result<std::string> fill_in(const std::string& text,
                            const std::map<std::string, std::string>& fields);

}  // namespace dripline::report_template
