#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string_view>

#include "clients/tools/report_template/report_interpreter.hpp"

namespace dripline::report_template {

/// A line with what it brought, as `dnc report template try --json` and the server give it; no
/// rule: it was not understood.
nlohmann::ordered_json taken_json(std::string_view line, const LineRule* rule, const Taken& taken);
nlohmann::ordered_json event_json(const ReportEvent& event);

}  // namespace dripline::report_template
