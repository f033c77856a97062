// The part of the interpreter that knows lines which are not whole, and lines that come twice at
// the end of a part.
#include <algorithm>

#include "clients/tools/report_template/impl/kept_line.hpp"
#include "clients/tools/report_template/report_interpreter.hpp"
#include "protocol/measurement/cut_line.hpp"

namespace dripline::report_template {
namespace {

bool has_values(const std::vector<FieldText>& fields) {
  return std::ranges::any_of(fields, [](const FieldText& one) {
    const FieldKind kind = one.field->kind;
    return is_number(kind) && kind != FieldKind::Count && kind != FieldKind::Expected;
  });
}

std::string cut_text(std::string_view shown) {
  return fmt::format(
      "'{}' is not whole: it ended without its end of block, nothing is taken from it", shown);
}

}  // namespace

/// 40.0 may be the beginning of 40.09, and PART 1 of PART 12: nothing is taken from such a line,
/// and nothing that it may have changed is in force any more.
void ReportInterpreter::take_cut(std::string_view line, Taken& taken) {
  const std::string shown = kept_line(trimmed(measurement::printed_line(line)));
  state_.partial.reset();
  state_.pending = {};
  state_.pending_of.clear();
  std::erase_if(state_.context,
                [](const auto& one) { return one.first != "unit" && one.first != "tool"; });
  state_.is_after_cut = true;
  state_.last_end.clear();
  const std::string_view printed = measurement::printed_line(line);
  const bool is_known = std::ranges::any_of(template_->rules, [&](const LineRule& rule) {
    return !rule.is_ignored && rule.steps.front().match(printed);
  });
  if (is_known) open_part(taken.events);
  if (state_.is_open) {
    add_fault(FindingKind::Incomplete, cut_text(shown), taken.events);
  } else {
    taken.events.emplace_back(Finding{FindingKind::Incomplete, cut_text(shown)});
  }
  state_.cut = shown;
}

/// A part that opens now may lack what the line had.
void ReportInterpreter::report_cut(std::vector<ReportEvent>& events) {
  if (!state_.cut.empty()) {
    add_fault(FindingKind::Incomplete, "before its first line: " + cut_text(state_.cut), events);
  }
}

/// What comes after such a line may be its rest: `0.09` of 40.09. Only a line that begins or ends a
/// part and has no value is taken.
bool ReportInterpreter::refuses_rest(const LineRule& rule, const std::vector<FieldText>& fields,
                                     std::string_view line, Taken& taken) {
  if ((rule.starts_part || rule.ends_part) && !has_values(fields)) return false;
  const std::string text =
      fmt::format("'{}' may be the rest of '{}', which is not whole: nothing is taken from it",
                  kept_line(line), state_.cut);
  open_part(taken.events);
  add_fault(FindingKind::Incomplete, text, taken.events);
  return true;
}

/// The end of a part that came twice is no part of its own.
bool ReportInterpreter::is_end_again(const LineRule& rule, const std::vector<FieldText>& fields,
                                     std::string_view line) const {
  return rule.ends_part && !rule.starts_part && !state_.is_open && !has_values(fields) &&
         !state_.last_end.empty() && state_.last_end == kept_line(line);
}

}  // namespace dripline::report_template
