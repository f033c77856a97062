#include "server/library/history/report_reader.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "protocol/base/csv.hpp"

namespace dripline::library {
namespace {

constexpr std::uint64_t kLinesPerPiece = 1000;

std::string json_text(const nlohmann::json& value) {
  return value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace

Result<ReportFormat> parse_report_format(std::string_view text) {
  if (text == "text") return ReportFormat::Text;
  if (text == "csv") return ReportFormat::Csv;
  if (text == "json") return ReportFormat::Json;
  return fail(Errc::Unsupported, "report format '{}' is not known; known are: text, csv, json",
              text);
}

ReportReader::ReportReader(storage::RecordStore& store, storage::Run run, ReportFormat format)
    : store_(store), run_(std::move(run)), format_(format) {}

ReportReader::ReportReader(storage::RecordStore& store, const std::string& machine,
                           ReportFormat format)
    : store_(store), format_(format) {
  run_.machine = machine;
}

Result<std::vector<storage::Record>> ReportReader::records() const {
  if (run_.id.empty()) return store_.machine_report(run_.machine, place_, kLinesPerPiece);
  return store_.of_run_after(run_.id, "output", place_, kLinesPerPiece);
}

Result<std::optional<std::string>> ReportReader::next() {
  if (stage_ == Stage::Done) return std::nullopt;
  std::string text;
  if (stage_ == Stage::Head) text = head();
  stage_ = Stage::Lines;
  const auto records = this->records();
  if (!records) return fail(records.error());
  for (const auto& record : *records) append_line(record, text);
  if (!records->empty()) place_ = {records->back().epoch, records->back().number};
  if (records->size() < kLinesPerPiece) {
    text += tail();
    stage_ = Stage::Done;
  }
  return text;
}

std::string ReportReader::head() const {
  if (format_ == ReportFormat::Csv) return "number,time,device,block,line,sequence,text\r\n";
  if (format_ == ReportFormat::Text) return {};
  if (run_.id.empty()) {
    return fmt::format(R"({{"run":null,"machine":{},"program":null,"revision":null,"lines":[)",
                       json_text(run_.machine));
  }
  return fmt::format(R"({{"run":{},"machine":{},"program":{},"revision":{},"lines":[)",
                     json_text(run_.id), json_text(run_.machine), json_text(run_.program),
                     run_.revision);
}

std::string ReportReader::tail() const {
  return format_ == ReportFormat::Json ? "\n]}\n" : "";
}

void ReportReader::append_line(const storage::Record& record, std::string& text) {
  const bool is_first = lines_++ == 0;
  switch (format_) {
    case ReportFormat::Text:
      text += record.text + "\n";
      return;
    case ReportFormat::Csv:
      text += fmt::format("{},{},{},{},{},{},{}\r\n", record.number, to_iso8601(record.time),
                          csv_field(record.device), record.block, record.line,
                          record.sequence < 0 ? "" : fmt::to_string(record.sequence),
                          csv_field(record.text));
      return;
    case ReportFormat::Json:
      text += is_first ? "\n" : ",\n";
      text += json_text({{"number", record.number},
                         {"time", to_iso8601(record.time)},
                         {"device", record.device},
                         {"block", record.block},
                         {"line", record.line},
                         {"sequence", record.sequence < 0 ? nlohmann::json(nullptr)
                                                          : nlohmann::json(record.sequence)},
                         {"text", record.text}});
      return;
  }
}

}  // namespace dripline::library
