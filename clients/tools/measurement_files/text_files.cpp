#include "clients/tools/measurement_files/text_files.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

#include "protocol/base/csv.hpp"

namespace dripline::measurement_files {
namespace {

using measurement::Measurement;
using nlohmann::ordered_json;

std::string optional_text(const std::optional<double>& value, unsigned decimals) {
  return value ? decimal_text(*value, decimals) : std::string();
}

ordered_json json_of(const std::optional<double>& value) {
  return value ? ordered_json(*value) : ordered_json(nullptr);
}

// --- reading ---

/// A field of a table by the name of its column; absent and empty are the same.
class Fields {
 public:
  virtual ~Fields() = default;
  virtual bool has(const char* name) const = 0;
  virtual Result<std::string> text(const char* name) const = 0;
  virtual Result<std::optional<double>> number(const char* name) const = 0;
  /// Whole, and exact: an epoch has more digits than a double.
  virtual Result<std::uint64_t> count(const char* name) const {
    const auto digits = text(name);
    if (!digits) return fail(digits.error());
    if (digits->empty()) return 0;
    std::uint64_t whole = 0;
    const char* const end = digits->data() + digits->size();
    const auto read = std::from_chars(digits->data(), end, whole);
    if (read.ec == std::errc() && read.ptr == end) return whole;
    constexpr double kExact = 9007199254740992.0;  // 3.0 of a table of others
    const auto value = number(name);
    if (value && *value && **value >= 0 && **value < kExact && **value == std::floor(**value))
      return static_cast<std::uint64_t>(**value);
    return fail(Errc::Syntax, "{} {} is no count", name, *digits);
  }
};

class JsonFields final : public Fields {
 public:
  explicit JsonFields(const ordered_json& object) : object_(object) {}
  bool has(const char* name) const override { return object_.contains(name); }
  Result<std::string> text(const char* name) const override {
    const auto found = object_.find(name);
    if (found == object_.end() || found->is_null()) return std::string();
    if (found->is_string()) return found->get<std::string>();
    if (found->is_number()) return found->dump();
    return fail(Errc::Syntax, "{} is no text", name);
  }
  Result<std::optional<double>> number(const char* name) const override {
    const auto found = object_.find(name);
    if (found == object_.end() || found->is_null()) return std::optional<double>();
    if (found->is_number()) return std::optional<double>(found->get<double>());
    return fail(Errc::Syntax, "{} is no number", name);
  }

 private:
  const ordered_json& object_;
};

class CsvFields final : public Fields {
 public:
  CsvFields(const std::map<std::string, std::size_t>& columns,
            const std::vector<std::string>& fields)
      : columns_(columns), fields_(fields) {}
  bool has(const char* name) const override { return columns_.contains(name); }
  Result<std::string> text(const char* name) const override {
    const auto found = columns_.find(name);
    if (found == columns_.end() || found->second >= fields_.size()) return std::string();
    return unguarded(fields_[found->second]);
  }
  Result<std::optional<double>> number(const char* name) const override {
    const auto field = text(name);
    if (!field) return fail(field.error());
    if (field->empty()) return std::optional<double>();
    const auto value = parse_finite(std::string_view(*field).substr(field->front() == '+' ? 1 : 0));
    if (value) return value;
    return fail(Errc::Syntax, "{} '{}' is no number", name, *field);
  }

 private:
  const std::map<std::string, std::size_t>& columns_;
  const std::vector<std::string>& fields_;
};

/// Reads field after field and keeps the first error.
class FieldReader {
 public:
  explicit FieldReader(const Fields& fields) : fields_(fields) {}
  std::string text(const char* name) {
    auto value = fields_.text(name);
    if (value) return *std::move(value);
    note(value.error());
    return {};
  }
  std::optional<double> number(const char* name) {
    const auto value = fields_.number(name);
    if (value) return *value;
    note(value.error());
    return std::nullopt;
  }
  std::uint64_t count(const char* name) {
    const auto value = fields_.count(name);
    if (value) return *value;
    note(value.error());
    return 0;
  }
  void note(const Error& error) {
    if (!error_) error_ = error;
  }
  const std::optional<Error>& error() const { return error_; }

 private:
  const Fields& fields_;
  std::optional<Error> error_;
};

/// Digits after the point in a text of a number.
std::uint8_t decimals_of(std::string_view text) {
  const auto point = text.find('.');
  if (point == std::string_view::npos) return 0;
  const auto digits = text.find_first_not_of("0123456789", point + 1);
  const std::size_t count = std::min(digits, text.size()) - point - 1;
  return static_cast<std::uint8_t>(std::min<std::size_t>(count, 12));
}

void read_characteristic(FieldReader& reader, measurement::Characteristic& of) {
  of.name = reader.text("characteristic");
  if (auto unit = reader.text("unit"); !unit.empty()) of.unit = std::move(unit);
  of.nominal = reader.number("nominal");
  of.lower = reader.number("lower");
  of.upper = reader.number("upper");
}

Result<Measurement> read_fields(const Fields& fields) {
  FieldReader reader(fields);
  Measurement m;
  auto actual = reader.number("actual");
  if (!actual) actual = reader.number("value");
  if (!actual && !reader.error()) return fail(Errc::Syntax, "there is no actual value");
  m.actual = actual.value_or(0);
  m.machine = reader.text(fields.has("machine") ? "machine" : "appraiser");  // of a gauge study
  m.run = reader.text("run");
  m.program = reader.text("program");
  m.revision = reader.count("revision");
  m.block = reader.count("block");
  m.line = reader.count("line");
  m.serial = reader.text("serial");
  m.tool = reader.text("tool");
  // In the server's files `part` is the part's id; tables of others have its number there.
  m.part = reader.text("part_number");
  if (fields.has("part_number")) {
    m.part_id = reader.count("part");
  } else {
    m.part = reader.text("part");
  }
  m.id = reader.count("id");
  read_characteristic(reader, m.characteristic);
  m.record = {reader.count("epoch"), reader.count("number")};
  m.item = static_cast<std::uint32_t>(std::min<std::uint64_t>(reader.count("item"), 0xFFFFFFFFU));
  if (const auto time = reader.text("time"); !time.empty()) {
    const auto parsed = parse_iso8601(time);
    if (!parsed) reader.note(parsed.error());
    m.time = parsed.value_or(UtcTime{});
  }
  if (const auto verdict = reader.text("verdict"); !verdict.empty()) {
    const auto parsed = measurement::parse_verdict(verdict);
    if (!parsed) reader.note(parsed.error());
    m.verdict = parsed.value_or(measurement::Verdict::Unknown);
  } else {
    m.verdict = measurement::judge(m.characteristic, m.actual, measurement::ReworkSide::None);
  }
  if (reader.error()) return fail(*reader.error());
  return m;
}

/// Fields of one record of CSV, which may reach over line ends inside quotes; `file` is moved past
/// it.
Result<std::vector<std::string>> take_record(std::string_view& file, char separator) {
  std::vector<std::string> fields(1);
  bool is_quoted = false;
  std::size_t i = 0;
  for (; i < file.size(); ++i) {
    const char c = file[i];
    if (i > kMaxLine) return fail(Errc::LimitExceeded, "a record over {} bytes", kMaxLine);
    if (is_quoted) {
      if (c != '"') {
        fields.back() += c;
      } else if (i + 1 < file.size() && file[i + 1] == '"') {
        fields.back() += '"';
        ++i;
      } else {
        is_quoted = false;
      }
    } else if (c == '"' && fields.back().empty()) {
      is_quoted = true;
    } else if (c == separator) {
      if (fields.size() == kMaxColumns)
        return fail(Errc::LimitExceeded, "over {} columns", kMaxColumns);
      fields.emplace_back();
    } else if (c == '\n') {
      break;
    } else if (c != '\r') {
      fields.back() += c;
    }
  }
  if (is_quoted) return fail(Errc::Syntax, "a quote is not closed");
  file.remove_prefix(std::min(file.size(), i + 1));
  return fields;
}

char separator_of(std::string_view head) {
  const auto count = [&](char c) { return std::ranges::count(head, c); };
  if (count(';') > count(',')) return ';';
  return count('\t') > count(',') ? '\t' : ',';
}

Error at_line(std::size_t line, const Error& error) {
  return {error.code, fmt::format("line {}: {}", line, error.what)};
}

Result<void> read_csv(std::string_view file, const Visitor& visit) {
  const char separator = separator_of(file.substr(0, file.find('\n')));
  std::map<std::string, std::size_t> columns;
  std::size_t line = 0;
  while (!file.empty()) {
    ++line;
    const auto fields = take_record(file, separator);
    if (!fields) return fail(at_line(line, fields.error()));
    if (fields->size() == 1 && fields->front().empty()) continue;
    if (columns.empty()) {
      for (std::size_t i = 0; i < fields->size(); ++i) columns.try_emplace((*fields)[i], i);
      if (columns.contains("actual") || columns.contains("value")) continue;
      return fail(Errc::Syntax, "line {}: no column 'actual' or 'value'", line);
    }
    const CsvFields row(columns, *fields);
    auto measurement = read_fields(row);
    if (!measurement) return fail(at_line(line, measurement.error()));
    const auto actual = row.text(columns.contains("actual") ? "actual" : "value");
    measurement->characteristic.decimals = decimals_of(*actual);
    if (auto done = visit(*measurement); !done) return done;
  }
  return {};
}

Result<void> read_json_lines(std::string_view file, const Visitor& visit) {
  std::size_t line = 0;
  while (!file.empty()) {
    ++line;
    const std::string_view text = take_until(file, '\n');
    if (text.find_first_not_of(" \t\r") == std::string_view::npos) continue;
    const auto measurement = read_json_line(text);
    if (!measurement) return fail(at_line(line, measurement.error()));
    if (auto done = visit(*measurement); !done) return done;
  }
  return {};
}

}  // namespace

std::string_view csv_head() {
  return "id,time,machine,run,program,revision,part,part_number,serial,tool,characteristic,nominal,"
         "lower,upper,unit,actual,deviation,verdict,block,line,epoch,number,item\r\n";
}

std::string csv_line(const Measurement& m) {
  const auto& of = m.characteristic;
  const auto number = [&](const std::optional<double>& value) {
    return optional_text(value, of.decimals);
  };
  std::optional<double> off = deviation(m);
  // 39.98 - 40 is not -0.02 in binary; the deviation has the decimals of its terms.
  const double scale = std::pow(10.0, of.decimals + 3);
  if (off) off = std::round(*off * scale) / scale;
  if (off && !std::isfinite(*off)) off.reset();  // of numbers as large as a double
  return fmt::format(
      "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\r\n", m.id,
      to_iso8601(m.time), csv_field(m.machine), csv_field(m.run), csv_field(m.program), m.revision,
      m.part_id, csv_field(m.part), csv_field(m.serial), csv_field(m.tool), csv_field(of.name),
      number(of.nominal), number(of.lower), number(of.upper), csv_field(of.unit), number(m.actual),
      number(off), to_string(m.verdict), m.block, m.line, m.record.epoch, m.record.number, m.item);
}

Result<void> write_csv(MeasurementSource& source, const Sink& sink) {
  if (auto written = sink(csv_head()); !written) return written;
  return source.each([&](const Measurement& m) { return sink(csv_line(m)); });
}

std::string json_line(const Measurement& m) {
  const auto& of = m.characteristic;
  const ordered_json object{{"id", m.id},
                            {"time", to_iso8601(m.time)},
                            {"machine", m.machine},
                            {"run", m.run},
                            {"program", m.program},
                            {"revision", m.revision},
                            {"part", m.part_id},
                            {"part_number", m.part},
                            {"serial", m.serial},
                            {"tool", m.tool},
                            {"characteristic", of.name},
                            {"nominal", json_of(of.nominal)},
                            {"lower", json_of(of.lower)},
                            {"upper", json_of(of.upper)},
                            {"unit", of.unit},
                            {"decimals", of.decimals},
                            {"actual", m.actual},
                            {"deviation", json_of(deviation(m))},
                            {"verdict", to_string(m.verdict)},
                            {"block", m.block},
                            {"line", m.line},
                            {"epoch", m.record.epoch},
                            {"number", m.record.number},
                            {"item", m.item}};
  return object.dump(-1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

Result<void> write_json_lines(MeasurementSource& source, const Sink& sink) {
  return source.each([&](const Measurement& m) { return sink(json_line(m)); });
}

Result<Measurement> read_json_line(std::string_view line) {
  if (line.size() > kMaxLine) return fail(Errc::LimitExceeded, "over {} bytes", kMaxLine);
  const auto object = ordered_json::parse(line, nullptr, false);
  if (!object.is_object()) return fail(Errc::Syntax, "no JSON object");
  auto measurement = read_fields(JsonFields(object));
  if (!measurement) return measurement;
  const auto decimals = object.find("decimals");
  const auto actual = object.find(object.contains("actual") ? "actual" : "value");
  if (decimals != object.end() && decimals->is_number_unsigned() && *decimals <= 12) {
    measurement->characteristic.decimals = decimals->get<std::uint8_t>();
  } else if (actual != object.end()) {
    measurement->characteristic.decimals = decimals_of(actual->dump());
  }
  return measurement;
}

Result<void> read_measurements(std::string_view file, const Visitor& visit) {
  if (file.starts_with("\xEF\xBB\xBF")) file.remove_prefix(3);
  const auto first = file.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return {};
  return file[first] == '{' ? read_json_lines(file, visit) : read_csv(file, visit);
}

}  // namespace dripline::measurement_files
