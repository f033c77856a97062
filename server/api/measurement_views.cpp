#include "server/api/measurement_views.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "protocol/measurement/measurement_json.hpp"
#include "server/api/nullable_json.hpp"
#include "server/library/report_reader.hpp"

namespace dripline::api {
namespace {

using nlohmann::json;

json unless_zero(std::uint64_t number) {
  return number == 0 ? json(nullptr) : json(number);
}

std::string number_text(const std::optional<double>& value) {
  return value ? fmt::format("{}", *value) : std::string();
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

std::string measurement_csv_head() {
  return "id,time,machine,run,program,revision,part,part_number,serial,tool,characteristic,"
         "nominal,lower,upper,unit,actual,deviation,verdict,block,line,epoch,number,item\r\n";
}

std::string measurement_csv(const measurement::Measurement& one) {
  using library::csv_field;
  const auto& characteristic = one.characteristic;
  return fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\r\n",
                     one.id, to_iso8601(one.time), csv_field(one.machine), csv_field(one.run),
                     csv_field(one.program), one.revision, one.part_id, csv_field(one.part),
                     csv_field(one.serial), csv_field(one.tool), csv_field(characteristic.name),
                     number_text(characteristic.nominal), number_text(characteristic.lower),
                     number_text(characteristic.upper), csv_field(characteristic.unit), one.actual,
                     number_text(measurement::deviation(one)), measurement::to_string(one.verdict),
                     one.block, one.line, one.record.epoch, one.record.number, one.item);
}

}  // namespace dripline::api
