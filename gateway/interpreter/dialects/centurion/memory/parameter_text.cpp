#include "gateway/interpreter/dialects/centurion/memory/parameter_text.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "gateway/interpreter/dialects/centurion/memory/control_memory.hpp"
#include "gateway/interpreter/dialects/centurion/memory/machine_parameters.hpp"
#include "gateway/interpreter/dialects/centurion/reading/keywords.hpp"
#include "protocol/base/decimal.hpp"

namespace dripline::interpreter::centurion {
namespace {

constexpr int kWorkSystems = 6, kReferences = 4, kFirstUnnamed = 200;
constexpr int kLastToolField = static_cast<int>(ToolField::WearRadius);

std::string value_text(double value) {
  return decimal_text(value, 10);
}

class Writer {
 public:
  explicit Writer(const Parameters& parameters) : parameters_(parameters) {}
  void line(std::string_view text) { text_ += fmt::format("{}\n", text); }
  void set(int number) {
    text_ += fmt::format("P{}={}\n", number, value_text(parameters_[number]));
  }
  void set(int first, int count) {
    for (int number = first; number < first + count; ++number) set(number);
  }
  std::string take() { return std::move(text_); }

 private:
  const Parameters& parameters_;
  std::string text_;
};

/// One line of the text: what it sets, or what it switches.
struct Line {
  std::optional<std::pair<int, double>> set;
  std::optional<Units> units;
};

/// Only its letters, as capitals.
std::string letters_of(std::string_view text) {
  std::string letters;
  for (const char c : text)
    if (kind_of(c) == CharKind::Letter) letters += upper(c);
  return letters;
}

std::string without_comment(std::string_view line) {
  std::string text;
  bool in_comment = false;
  for (const char c : line) {
    if (c == '(') in_comment = true;
    if (!in_comment && !is_blank(c) && c != '\r')
      text += kind_of(c) == CharKind::Letter ? upper(c) : c;
    if (c == ')') in_comment = false;
  }
  return text;
}

Result<Line> read_line(std::string_view raw, std::size_t number) {
  const std::string text = without_comment(raw);
  Line line;
  if (text.empty() || text == "%" || text == "G10" || text == "G11" || text == "M30" ||
      text.front() == 'O')
    return line;
  if (text == "G20" || text == "G21") {
    line.units = text == "G20" ? Units::Inch : Units::Millimeter;
    return line;
  }
  const auto equals = text.find('=');
  int parameter = 0;
  double value = 0;
  const char* const begin = text.data();
  const char* const end = begin + text.size();
  if (text.front() == 'P' && equals != std::string::npos) {
    const auto left = std::from_chars(begin + 1, begin + equals, parameter);
    const auto right = std::from_chars(begin + equals + 1, end, value, std::chars_format::fixed);
    if (left.ec == std::errc{} && left.ptr == begin + equals && right.ec == std::errc{} &&
        right.ptr == end && std::isfinite(value)) {
      line.set = {parameter, value};
      return line;
    }
  }
  return fail(Errc::Syntax, "line {}: \"{}\": expected P and a number = a value", number,
              raw.substr(0, 60));
}

bool has_name(int number) {
  if (number >= 0 && number < kFirstUnnamed) return true;
  if (number >= kWorkOffsets && number <= kLastAxisParameter) return true;
  if (number >= kToolOffsets && number < kToolOffsets + kFieldsPerTool * kOffsetCount)
    return (number - kToolOffsets) % kFieldsPerTool <= kLastToolField;
  for (const MachineParameter& row : machine_parameters()) {
    if (number >= row.number && number < row.number + row.count()) return true;
  }
  return false;
}

/// The number of `P500`, or none.
std::optional<int> number_of(std::string_view text) {
  int number = 0;
  if (text.size() < 2 || text.front() != 'P') return std::nullopt;
  const auto read = std::from_chars(text.data() + 1, text.data() + text.size(), number);
  const bool is_whole = read.ec == std::errc{} && read.ptr == text.data() + text.size();
  return is_whole && number >= 0 ? std::optional(number) : std::nullopt;
}

/// A row of the map; none for an empty line and for a row that is not filled in.
Result<std::optional<ParameterMap::Row>> read_row(std::string_view raw, std::size_t number) {
  const std::string text = without_comment(raw.substr(0, raw.find('#')));
  if (text.empty()) return std::optional<ParameterMap::Row>();
  const auto equals = std::min(text.find('='), text.size());
  const auto ours = number_of(std::string_view(text).substr(0, equals));
  const auto rest = std::string_view(text).substr(std::min(equals + 1, text.size()));
  const auto control = number_of(rest);
  if (!ours || equals == text.size() || (!control && !rest.empty())) {
    return fail(Errc::Syntax, "line {}: \"{}\": expected a row as P500 = P7012", number,
                raw.substr(0, 60));
  }
  if (*ours < kFirstUnnamed || !has_name(*ours)) {
    return fail(Errc::LimitExceeded,
                "line {}: P{} is none of Dripline's numbers of tables and pages (P{} and on)",
                number, *ours, kWorkOffsets);
  }
  if (!control) return std::optional<ParameterMap::Row>();
  if (*control < kFirstUnnamed) {
    return fail(Errc::LimitExceeded, "line {}: P{} is a parameter of programs, P0 to P{}", number,
                *control, kFirstUnnamed - 1);
  }
  return std::optional(ParameterMap::Row{*ours, *control});
}

/// The text in the control's numbers, of the parameters that have one.
Result<std::string> write_mapped(const Parameters& parameters, Units units,
                                 const ParameterMap& map) {
  std::string text = units == Units::Inch ? "G20\n" : "G21\n";
  for (int number = 0; number < kFirstUnnamed; ++number) {
    if (parameters[number] != 0) {
      text += fmt::format("P{}={}\n", number, value_text(parameters[number]));
    }
  }
  text += "G10\n";
  for (int number = kFirstUnnamed; number < kParameterCount; ++number) {
    const auto row =
        std::ranges::find(map.rows, number, [](const auto& each) { return each.ours; });
    if (row != map.rows.end()) {
      text += fmt::format("P{}={}\n", row->control, value_text(parameters[number]));
    } else if (has_name(number) && parameters[number] != 0) {
      return fail(Errc::NotFound, "P{}, which is {}, has no row in the map", number,
                  value_text(parameters[number]));
    }
  }
  return text + "G11\nM30\n";
}

/// The values as the sections of a setup file. A value of 0, the default, is written only where a
/// table would be incomplete without it.
class SetupText {
 public:
  SetupText(const Parameters& parameters, Units units) : parameters_(parameters) {
    text_ = fmt::format("units = \"{}\"\n", units == Units::Inch ? "in" : "mm");
  }
  std::string make() {
    for (int system = 0; system < kWorkSystems; ++system) add_offset(system);
    for (int tool = 1; tool <= kOffsetCount; ++tool) add_tool(tool);
    for (int number = 0; number < kFirstUnnamed; ++number) {
      if (parameters_[number] == 0) continue;
      text_ += fmt::format("\n[[variable]]\nname = \"P{}\"\nvalue = {}\n", number, value(number));
    }
    text_ += "\n[control]\nstored_x = \"radius\"\n";
    for (const PlaceOption& place : kPlaceOptions) add_place(place.name, place.parameter);
    add_references();
    add_machine();
    return std::move(text_);
  }

 private:
  std::string value(int number) const { return value_text(parameters_[number]); }
  std::string axes(int z) const {
    return fmt::format("{{ X = {}, Z = {} }}", value(z + 1), value(z));
  }
  bool is_zero(int z) const { return parameters_[z] == 0 && parameters_[z + 1] == 0; }

  void add_offset(int system) {
    const int z = kWorkOffsets + 2 * system;
    if (is_zero(z)) return;
    text_ += fmt::format("\n[[offset]]\nname = \"G{}\"\nX = {}\nZ = {}\n", 54 + system,
                         value(z + 1), value(z));
  }
  void add_tool(int tool) {
    const auto of = [&](ToolField field) { return value(Parameters::tool_parameter(tool, field)); };
    bool is_empty = true;
    for (int field = 0; field <= kLastToolField; ++field)
      is_empty = is_empty &&
                 parameters_[Parameters::tool_parameter(tool, static_cast<ToolField>(field))] == 0;
    if (is_empty) return;
    text_ += fmt::format(
        "\n[[tool]]\nnumber = {}\nX = {}\nZ = {}\nradius = {}\ntip = {}\n"
        "wear = {{ X = {}, Z = {}, radius = {} }}\n",
        tool, of(ToolField::LengthX), of(ToolField::LengthZ), of(ToolField::Radius),
        of(ToolField::Type), of(ToolField::WearX), of(ToolField::WearZ), of(ToolField::WearRadius));
  }
  void add_place(std::string_view name, int z) {
    if (!is_zero(z)) text_ += fmt::format("{} = {}\n", name, axes(z));
  }
  void add_references() {
    std::string points;
    bool is_empty = true;
    for (int i = 0; i < kReferences; ++i) {
      const int z = kReferencePoints + 2 * i;
      is_empty = is_empty && is_zero(z);
      points += (i > 0 ? ", " : "") + axes(z);
    }
    if (!is_empty) text_ += fmt::format("reference = [{}]\n", points);
  }
  void add_machine() {
    std::string rows;
    for (const MachineParameter& row : machine_parameters()) {
      const bool is_empty = row.is_per_axis ? is_zero(row.number) : parameters_[row.number] == 0;
      if (is_empty) continue;
      rows += fmt::format("{} = {}\n", row.name,
                          row.is_per_axis ? axes(row.number) : value(row.number));
    }
    if (!rows.empty()) text_ += "\n[control.machine]\n" + rows;
  }

  const Parameters& parameters_;
  std::string text_;
};

}  // namespace

Result<ParameterMap> read_parameter_map(std::string_view text) {
  ParameterMap map;
  std::size_t number = 0;
  while (!text.empty()) {
    const auto end = text.find('\n');
    auto row = read_row(text.substr(0, end), ++number);
    if (!row) return fail(row.error());
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (!*row) continue;
    for (const ParameterMap::Row& known : map.rows) {
      if (known.ours == (*row)->ours || known.control == (*row)->control) {
        return fail(Errc::Syntax, "line {}: P{} = P{} besides P{} = P{}", number, (*row)->ours,
                    (*row)->control, known.ours, known.control);
      }
    }
    map.rows.push_back(**row);
  }
  if (map.rows.empty()) return fail(Errc::Syntax, "the map has no row as P500 = P7012");
  return map;
}

bool has_own_numbering(std::string_view text) {
  return letters_of(text.substr(0, kNumberingHead)).find(letters_of(kOwnNumbering)) !=
         std::string::npos;
}

Result<std::string> write_parameter_text(const Setup& setup, const ParameterMap* map) {
  ModalState state;
  Parameters parameters;
  if (auto loaded = load_memory(setup, state, parameters); !loaded) return fail(loaded.error());
  if (map != nullptr) return write_mapped(parameters, state.units, *map);
  Writer writer(parameters);
  writer.line(kOwnNumbering);
  writer.line(state.units == Units::Inch ? "G20" : "G21");
  for (int number = 0; number < kFirstUnnamed; ++number) {
    if (parameters[number] != 0) writer.set(number);
  }
  writer.line("G10");
  writer.set(kWorkOffsets, kLastAxisParameter - kWorkOffsets + 1);
  for (int tool = 1; tool <= kOffsetCount; ++tool)
    writer.set(Parameters::tool_parameter(tool, ToolField::LengthZ), kLastToolField + 1);
  for (const MachineParameter& row : machine_parameters()) writer.set(row.number, row.count());
  writer.line("G11");
  writer.line("M30");
  return writer.take();
}

Result<std::string> setup_of_parameter_text(std::string_view text, const ParameterMap* map) {
  // A line may begin with `%` or blanks.
  constexpr std::size_t kHead = 200;
  const bool is_ours =
      map == nullptr && text.substr(0, kHead).find(kOwnNumbering) != std::string_view::npos;
  Parameters parameters;
  Units units = Units::Inch;
  std::size_t number = 0;
  while (!text.empty()) {
    const auto end = text.find('\n');
    const auto line = read_line(text.substr(0, end), ++number);
    if (!line) return fail(line.error());
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (line->units) units = *line->units;
    if (!line->set) continue;
    auto [parameter, value] = *line->set;
    if (parameter >= kFirstUnnamed && map != nullptr) {
      const auto row =
          std::ranges::find(map->rows, parameter, [](const auto& each) { return each.control; });
      if (row == map->rows.end()) {
        return fail(Errc::Syntax, "line {}: P{} has no row in the map", number, parameter);
      }
      parameter = row->ours;
    } else if (parameter >= kFirstUnnamed && !is_ours) {
      return fail(Errc::Unsupported,
                  "line {}: P{}: the control's numbers from P{} on are not known: a map says which "
                  "is which (--map FILE, deploy/examples/centurion-parameters.map)",
                  number, parameter, kFirstUnnamed);
    }
    if (!has_name(parameter)) {
      return fail(Errc::Syntax, "line {}: P{} is none of the parameters that a setup keeps", number,
                  parameter);
    }
    parameters[parameter] = value;
  }
  return SetupText(parameters, units).make();
}

}  // namespace dripline::interpreter::centurion
