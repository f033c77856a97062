#include "server/api/measurement_views.hpp"

#include <nlohmann/json.hpp>

#include "protocol/measurement/measurement_json.hpp"
#include "server/api/nullable_json.hpp"

namespace dripline::api {
namespace {

using nlohmann::json;

json unless_zero(std::uint64_t number) {
  return number == 0 ? json(nullptr) : json(number);
}

}  // namespace

json measurement_json(const measurement::Measurement& one) {
  return measurement::to_json(one);
}

json part_json(const storage::MeasuredPart& part) {
  return {{"id", part.id},
          {"machine", part.machine},
          {"run", text_or_null(part.run)},
          {"program", text_or_null(part.program)},
          {"revision", unless_zero(part.revision)},
          {"template", part.template_name},
          {"template_version", part.template_version},
          {"part_number", text_or_null(part.number)},
          {"serial", text_or_null(part.serial)},
          {"measurements", part.measurements},
          {"findings", part.findings},
          {"verdict", measurement::to_string(part.verdict)},
          {"begun", to_iso8601(part.begun)},
          {"ended", time_or_null(part.ended)},
          {"superseded", part.is_superseded}};
}

json finding_json(const storage::ReportFinding& finding) {
  return {{"id", finding.id},
          {"machine", finding.machine},
          {"run", text_or_null(finding.run)},
          {"part", unless_zero(finding.part_id)},
          {"epoch", finding.record.epoch},
          {"number", finding.record.number},
          {"time", to_iso8601(finding.time)},
          {"kind", finding.kind},
          {"text", finding.text}};
}

json report_template_json(const storage::ReportTemplateVersion& version) {
  return {{"name", version.name},
          {"version", version.version},
          {"author", version.author},
          {"created", to_iso8601(version.created)}};
}

json assignment_json(const storage::TemplateAssignment& assignment) {
  return {{"scope", storage::to_string(assignment.scope)},
          {"subject", assignment.subject},
          {"template", assignment.name},
          {"version", number_or_null(assignment.version)},
          {"author", assignment.author},
          {"created", to_iso8601(assignment.created)}};
}

}  // namespace dripline::api
