#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "clients/cli/context.hpp"
#include "clients/cli/text/terminal.hpp"
#include "clients/tools/report_template/report_interpreter.hpp"

/// How measurements and report templates look.
namespace dripline::cli {

Table template_table(const nlohmann::ordered_json& templates,
                     const nlohmann::ordered_json& assignments);
Table measurement_table(const nlohmann::ordered_json& measurements);
Table part_table(const nlohmann::ordered_json& parts);
Table finding_table(const nlohmann::ordered_json& findings);

/// An indented line.
std::string event_text(const report_template::ReportEvent& event);
/// The line, and below it what it brought; no rule: it was not understood.
std::string taken_text(std::string_view line, const report_template::LineRule* rule,
                       const report_template::Taken& taken);

}  // namespace dripline::cli
