#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "clients/tools/report_template/report_state.hpp"
#include "clients/tools/report_template/report_template.hpp"

namespace dripline::report_template {

/// A line of a report as its record has it; of a probe record `line_of_probe` makes it.
struct ReportLine {
  std::string_view text;
  std::string_view kind = "output";
  std::string_view device = {};
};

enum class FindingKind : std::uint8_t {
  Unmatched,   ///< the line has no form of the template
  BadValue,    ///< it has, and a value in it cannot be used
  Missing,     ///< lines of a counted report that did not come
  Doubled,     ///< a line that had come already: nothing is taken from it; or more than expected
  Reordered,   ///< a line that came after a later one
  Incomplete,  ///< a line that is not whole; a part, or lines that follow each other, without all
               ///< that belongs to them
};
std::string_view to_string(FindingKind kind);  ///< unmatched, bad_value, missing, ...

struct Finding {
  FindingKind kind = FindingKind::Unmatched;
  std::string text;  ///< for people
  friend bool operator==(const Finding&, const Finding&) = default;
};

struct PartBegun {
  friend bool operator==(const PartBegun&, const PartBegun&) = default;
};
struct PartEnded {
  PartSummary part;
  friend bool operator==(const PartEnded&, const PartEnded&) = default;
};

/// What a line brought, in order.
using ReportEvent = std::variant<PartBegun, Value, Finding, PartEnded>;

struct Taken {
  bool is_understood = false;
  std::size_t rule = 0;                                     ///< of the template; if understood
  std::vector<std::pair<std::string, std::string>> fields;  ///< as written in the line
  std::vector<ReportEvent> events;
};

/// Lines of one machine, in the order of their records, to measurements. Deterministic: template,
/// state and line decide all. One thread at a time.
class ReportInterpreter {
 public:
  explicit ReportInterpreter(std::shared_ptr<const ReportTemplate> report_template,
                             ReportState state = {})
      : template_(std::move(report_template)), state_(std::move(state)) {}

  /// Whether the template is for lines of this kind and device.
  bool is_for(const ReportLine& line) const;
  /// A line that is not understood has no finding here: another template may know it.
  Taken take(const ReportLine& line);
  /// The lines are over: so is the part. `cut`: how a run ended that did not complete; then nothing
  /// says that the part is whole.
  std::vector<ReportEvent> end(std::string_view cut = {});

  const ReportState& state() const { return state_; }
  const ReportTemplate& report_template() const { return *template_; }

 private:
  /// The fields of one rule's lines, sorted by what they are for.
  struct Fields {
    std::map<std::string, std::string> texts;
    std::map<std::string, LineNumbers> numbers;  ///< by the characteristic in the field's name
    std::optional<std::int64_t> count, expected;
    std::map<std::string, std::string> unusable;  ///< why, by the field's name
    std::string_view line;
  };
  bool take_partial(std::string_view line, Taken& taken);
  const LineForm* next_of_partial() const;
  void take_rule(std::string_view line, Taken& taken);
  /// What one line brings as the first, or as all, of its rule.
  void begin_rule(std::size_t index, const std::vector<FieldText>& fields, std::string_view line,
                  Taken& taken);
  void apply(std::size_t rule, const std::vector<FieldText>& texts, std::string_view line,
             Taken& taken);
  Fields read_fields(const std::vector<FieldText>& texts) const;
  void open_part(std::vector<ReportEvent>& events);
  void close_part(std::vector<ReportEvent>& events);
  /// Something else than its own end is what ends it.
  void break_part(std::string_view why, std::vector<ReportEvent>& events);
  bool keep_texts(const LineRule& rule, const Fields& fields, std::vector<ReportEvent>& events);
  /// False: the line came before.
  bool take_count(std::int64_t count, std::string_view line, std::vector<ReportEvent>& events);
  bool take_earlier(std::int64_t count, std::string_view line, std::vector<ReportEvent>& events);
  void find_doubled(std::int64_t count, std::string_view line, std::vector<ReportEvent>& events);
  void keep_line(std::int64_t count, std::string_view line);
  void take_cut(std::string_view line, Taken& taken);
  void report_cut(std::vector<ReportEvent>& events);
  bool refuses_rest(const LineRule& rule, const std::vector<FieldText>& fields,
                    std::string_view line, Taken& taken);
  bool is_end_again(const LineRule& rule, const std::vector<FieldText>& fields,
                    std::string_view line) const;
  void take_expected(std::int64_t expected, std::string_view line,
                     std::vector<ReportEvent>& events);
  void take_values(const LineRule& rule, const Fields& fields, std::vector<ReportEvent>& events);
  void add_value(Value value, std::vector<ReportEvent>& events);
  void add_finding(FindingKind kind, std::string text, std::vector<ReportEvent>& events);
  /// A finding that leaves the part unknown.
  void add_fault(FindingKind kind, std::string text, std::vector<ReportEvent>& events);
  void find_missing(std::vector<ReportEvent>& events);
  void update_verdict();

  std::shared_ptr<const ReportTemplate> template_;
  ReportState state_;
};

/// A probe record (JSON, as gateways write it) as a line: `PROBE contact X 1.250000 Z -3.000000`.
/// Moved: only the axes in which the contact is before the end that the move would have had; all,
/// where there is none. Text that is no such JSON is taken as it is: serial machines print their
/// own.
std::string line_of_probe(std::string_view text, ProbeAxes axes = ProbeAxes::All);

}  // namespace dripline::report_template
