#include "server/measurements/hold_reason.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace dripline::measurements {
namespace {

using measurement::Measurement;

constexpr std::uint64_t kMaxCounted = 1000;
constexpr std::size_t kMaxText = 200;  ///< of what a report says: a reason is read at a glance

std::string shortened(const std::string& text) {
  if (text.size() <= kMaxText) return text;
  std::size_t end = kMaxText;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80) --end;
  return text.substr(0, end) + " ...";
}

/// "; 2 more values are scrap"
std::string more_text(std::size_t count, std::string_view thing, std::string_view what) {
  if (count == 0) return {};
  return fmt::format("; {} more {}{} {}", count, thing, count == 1 ? " is" : "s are", what);
}

/// With the decimals of the report, and more where the number has them: a limit may be finer than
/// what was printed.
std::string number_text(double value, int decimals) {
  constexpr int kMost = 6;
  constexpr double kHuge = 1e9;
  if (!(std::abs(value) < kHuge)) return fmt::format("{:g}", value);
  std::string text = fmt::format("{:.{}f}", value, std::max(kMost, decimals));
  const std::size_t least = text.find('.') + 1 + static_cast<std::size_t>(decimals);
  while (text.size() > least && text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text;
}

std::string limit_text(const Measurement& one) {
  const auto& limits = one.characteristic;
  const auto number = [&](double value) { return number_text(value, limits.decimals); };
  if (limits.upper && one.actual > *limits.upper) {
    return fmt::format(", {} above the upper limit {}", number(one.actual - *limits.upper),
                       number(*limits.upper));
  }
  if (limits.lower && one.actual < *limits.lower) {
    return fmt::format(", {} below the lower limit {}", number(*limits.lower - one.actual),
                       number(*limits.lower));
  }
  return limits.lower || limits.upper ? std::string() : std::string(", without limits");
}

std::string value_text(const Measurement& one) {
  const auto& what = one.characteristic;
  return fmt::format("{} is {} {}{}", shortened(what.name), number_text(one.actual, what.decimals),
                     what.unit, limit_text(one));
}

std::string found_text(const std::vector<storage::ReportFinding>& findings) {
  const auto& first = findings.front();
  const std::size_t more = findings.size() - 1;
  return fmt::format("{}: {}{}", first.kind, shortened(first.text),
                     more_text(more, "finding", "there"));
}

}  // namespace

std::string hold_reason(storage::MeasurementStore& stored, const storage::MeasuredPart& part) {
  const std::string verdict(measurement::to_string(part.verdict));
  const std::string serial =
      part.serial.empty() ? "" : fmt::format(", serial {},", shortened(part.serial));
  const std::string known = fmt::format("part {}{} is {}", part.id, serial, verdict);
  if (part.verdict == measurement::Verdict::Unknown) {
    const auto findings = stored.findings({.run = part.run}, {.limit = kMaxCounted});
    if (findings) {
      std::vector<storage::ReportFinding> own;
      for (const auto& finding : *findings) {
        if (finding.part_id == part.id) own.push_back(finding);
      }
      if (!own.empty()) return known + ": " + found_text(own);
    }
  }
  const auto values =
      stored.list({.part_id = part.id, .verdict = part.verdict}, std::nullopt, kMaxCounted);
  if (!values || values->empty()) return known;
  const std::size_t more = values->size() - 1;
  return fmt::format("{}: {}{}", known, value_text(values->front()),
                     more_text(more, "value", verdict));
}

}  // namespace dripline::measurements
