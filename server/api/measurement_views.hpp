#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "storage/measurement_store.hpp"
#include "storage/report_template_store.hpp"

/// The JSON of measurements, and their lines in exports. Pure; as views.hpp.
namespace dripline::api {

nlohmann::json measurement_json(const measurement::Measurement& measurement);
nlohmann::json part_json(const storage::MeasuredPart& part);
nlohmann::json finding_json(const storage::ReportFinding& finding);
/// Without the text.
nlohmann::json report_template_json(const storage::ReportTemplateVersion& version);
nlohmann::json assignment_json(const storage::TemplateAssignment& assignment);

}  // namespace dripline::api
