#include "clients/tools/measurement_files/part_report.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>
#include <vector>

#include "clients/tools/charts/text.hpp"

namespace dripline::measurement_files {
namespace {

using charts::xml_text;
using measurement::Measurement;
using measurement::Verdict;

constexpr std::string_view kStyle = R"(
body { font: 10pt/1.35 "DejaVu Sans", Verdana, Arial, sans-serif; color: #1a1a1a; background: #fff; margin: 1.5em; }
h1 { font-size: 15pt; margin: 0 0 .2em; } h2 { font-size: 12pt; margin: 1.2em 0 .3em; }
dl { display: grid; grid-template-columns: max-content 1fr; gap: 0 1em; margin: .4em 0 .8em; } dt { color: #555; } dd { margin: 0; }
table { border-collapse: collapse; width: 100%; } thead { display: table-header-group; }
th, td { border-bottom: 1px solid #bbb; padding: .25em .5em; text-align: right; font-variant-numeric: tabular-nums; }
th { border-bottom: 2px solid #1a1a1a; } th:first-child, td:first-child, .word { text-align: left; } tr { break-inside: avoid; }
.good { color: #1b5e20; } .rework { color: #8a4b00; font-weight: bold; } .scrap { color: #a31515; font-weight: bold; } .unknown { color: #555; }
svg { display: block; } section + section { break-before: page; } footer { margin-top: 1em; color: #555; font-size: 8.5pt; }
@page { size: A4; margin: 15mm; } @media print { body { margin: 0; } }
)";

std::string cell(const std::optional<double>& value, unsigned decimals) {
  return value ? decimal_text(*value, decimals) : std::string("-");
}

/// Where the value lies between its limits: a line with both ends and a mark. The words beside it
/// say the same.
std::string bar(const Measurement& m) {
  const auto& of = m.characteristic;
  if (!of.lower || !of.upper || !(*of.lower < *of.upper)) return "";
  constexpr double kWidth = 100, kRoom = 15;
  const double part = (m.actual - *of.lower) / (*of.upper - *of.lower);
  if (std::isnan(part)) return "";  // of limits as wide as a double
  const double x = kRoom + std::clamp(part, -0.2, 1.2) * (kWidth - 2 * kRoom);
  const bool is_inside = part >= 0 && part <= 1;
  return fmt::format(
      "<svg width=\"{0}\" height=\"12\" viewBox=\"0 0 {0} 12\" aria-hidden=\"true\"><path d=\"M{1} "
      "6H{2}M{1} 2v8M{2} "
      "2v8M{3} 4v4\" stroke=\"#1a1a1a\" fill=\"none\"/><{4} fill=\"{5}\"/></svg>",
      kWidth, kRoom, kWidth - kRoom, kWidth / 2,
      is_inside ? fmt::format("circle cx=\"{:.1f}\" cy=\"6\" r=\"3.5\"", x)
                : fmt::format("rect x=\"{:.1f}\" y=\"2\" width=\"8\" height=\"8\"", x - 4),
      is_inside ? "#1f4e8c" : "#b3261e");
}

std::string row(const Measurement& m) {
  const auto& of = m.characteristic;
  const auto off = deviation(m);
  const std::string deviation_text =
      off && std::isfinite(*off) ? fmt::format("{:+.{}f}", *off, std::max<unsigned>(of.decimals, 3))
                                 : std::string("-");
  return fmt::format(
      "<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td "
      "class=\"word\">{}</td>"
      "<td class=\"word\">{}</td><td>{}</td><td class=\"word {}\">{}</td></tr>\n",
      xml_text(of.name), cell(of.nominal, of.decimals), cell(of.lower, of.decimals),
      cell(of.upper, of.decimals), decimal_text(m.actual, of.decimals), deviation_text,
      xml_text(of.unit), xml_text(m.tool), bar(m), to_string(m.verdict), to_string(m.verdict));
}

/// To the second, for a reader.
std::string second_text(UtcTime time) {
  std::string text = to_iso8601(time).substr(0, 19);
  text[10] = ' ';
  return text + " UTC";
}

std::string facts(const Measurement& m, Verdict verdict, std::size_t count) {
  std::string text = "<dl>";
  const auto add = [&](std::string_view name, const std::string& value) {
    if (!value.empty()) text += fmt::format("<dt>{}</dt><dd>{}</dd>", name, xml_text(value));
  };
  add("Part", m.part);
  add("Serial number", m.serial);
  add("Program", m.revision > 0 ? fmt::format("{} revision {}", m.program, m.revision) : m.program);
  add("Machine", m.machine);
  add("Run", m.run);
  if (m.time > UtcTime{}) add("First value", second_text(m.time));
  add("Measured", fmt::format("{} {}", count, count == 1 ? "value" : "values"));
  return text + fmt::format("<dt>Verdict of these values</dt><dd class=\"{0}\">{0}</dd></dl>\n",
                            to_string(verdict));
}

/// As of a part: values without limits do not matter while another has some.
Verdict verdict_of(const std::vector<Measurement>& part) {
  std::optional<Verdict> worst;
  for (const Measurement& m : part) {
    if (!m.characteristic.lower && !m.characteristic.upper) continue;
    worst = measurement::worse(worst.value_or(Verdict::Good), m.verdict);
  }
  return worst.value_or(Verdict::Unknown);
}

/// What identifies it best of what is known.
std::string name_of(const Measurement& m) {
  if (!m.serial.empty()) return m.serial;
  if (!m.part.empty()) return m.part;
  if (m.part_id > 0) return fmt::format("{}", m.part_id);
  return m.run.empty() ? "without a number" : "of run " + m.run.substr(0, 8);
}

std::string section(const std::vector<Measurement>& part) {
  const Measurement& first = part.front();
  std::string text =
      fmt::format("<section>\n<h2>Workpiece {}</h2>\n", xml_text(name_of(first))) +
      facts(first, verdict_of(part), part.size()) +
      "<table><thead><tr><th>Characteristic</th><th>Nominal</th><th>Lower</th><th>Upper</"
      "th><th>Actual</th>"
      "<th>Deviation</th><th class=\"word\">Unit</th><th class=\"word\">Tool</th><th></th>"
      "<th class=\"word\">Verdict</th></tr></thead><tbody>\n";
  for (const Measurement& m : part) text += row(m);
  return text + "</tbody></table>\n</section>\n";
}

}  // namespace

Result<void> write_part_report(MeasurementSource& source, const PartReportHead& head,
                               const Sink& sink) {
  std::string begin = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta "
      "charset=\"utf-8\"><title>{0}</title><style>{1}</style></head>\n"
      "<body>\n<h1>{0}</h1>\n",
      xml_text(head.title), kStyle);
  if (!head.note.empty()) begin += fmt::format("<p>{}</p>\n", xml_text(head.note));
  if (auto written = sink(begin); !written) return written;
  bool is_empty = true;
  auto done = each_part(source, [&](const std::vector<Measurement>& part) {
    is_empty = false;
    return sink(section(part));
  });
  if (!done) return done;
  if (is_empty) return fail(Errc::LimitExceeded, "a report of no measurement");
  return sink(
      "<footer>Limits are as they were when the part was measured. Values are as the machine "
      "reported them. Whether a report was complete is part of the part's own verdict, not of its "
      "values: dnc report parts.</footer>\n"
      "</body></html>\n");
}

}  // namespace dripline::measurement_files
