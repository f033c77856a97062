#include "gateway/interpreter/dialects/rs274ngc/memory/table_files.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>

#include "gateway/interpreter/dialects/rs274ngc/memory/retained_memory.hpp"
#include "protocol/base/lines.hpp"

namespace dripline::interpreter::rs274ngc {
namespace {

constexpr std::string_view kBlanks = " \t\r";

/// Calls `use(line, number)` with each line that is not empty; a remark is taken off.
template <class Use>
Result<void> for_each_line(std::string_view text, Use use) {
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = text.find('\n');
    std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    line = trimmed(line.substr(0, line.find(';')), kBlanks);
    if (line.empty()) continue;
    if (auto used = use(line, number); !used) return used;
  }
  return {};
}

/// Takes the text up to the next blank off the line.
std::string_view next_word(std::string_view& line) {
  const std::size_t end = std::min(line.find_first_of(kBlanks), line.size());
  const std::string_view word = line.substr(0, end);
  line.remove_prefix(std::min(line.find_first_not_of(kBlanks, end), line.size()));
  return word;
}

std::optional<double> number_of(std::string_view text) {
  if (text.starts_with('+')) {
    text.remove_prefix(1);
    if (text.starts_with('-')) return std::nullopt;
  }
  double value = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_whole_text = read.ec == std::errc{} && read.ptr == text.data() + text.size();
  if (!is_whole_text || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<int> whole_of(std::string_view text, int most) {
  const auto value = number_of(text);
  if (!value || *value < 0 || *value > most || *value != std::floor(*value)) return std::nullopt;
  return static_cast<int>(*value);
}

struct TableRow {
  std::optional<int> number, pocket;
  std::map<char, double> values;  ///< by its letter, as written
};

Result<TableRow> read_row(std::string_view line, std::size_t at) {
  constexpr int kMostTools = 99'999;
  TableRow row;
  while (!line.empty()) {
    const std::string_view word = next_word(line);
    const char letter = word.front() >= 'a' && word.front() <= 'z'
                            ? static_cast<char>(word.front() - 'a' + 'A')
                            : word.front();
    const std::string_view digits = word.substr(1);
    if (letter == 'T' || letter == 'P') {
      auto& whole = letter == 'T' ? row.number : row.pocket;
      if (whole) return fail(Errc::Syntax, "tool table, line {}: {} comes twice", at, letter);
      whole = whole_of(digits, kMostTools);
      if (!whole)
        return fail(Errc::Syntax, "tool table, line {}: {} is not a number from 0 to {}", at, word,
                    kMostTools);
      continue;
    }
    const auto value = number_of(digits);
    if (std::string_view("XYZABCUVWDIJQ").find(letter) == std::string_view::npos || !value)
      return fail(Errc::Syntax, "tool table, line {}: {} is no word of a tool", at, word);
    if (!row.values.emplace(letter, *value).second)
      return fail(Errc::Syntax, "tool table, line {}: {} comes twice", at, letter);
  }
  if (!row.number || !row.pocket)
    return fail(Errc::Syntax, "tool table, line {}: a tool needs T and P", at);
  return row;
}

/// What a setup's tool has no key for is a variable (retained_memory.hpp), in mm.
struct SetupText {
  std::string tools, offsets, variables, remarks;

  void add_variable(const std::string& name, double value) {
    variables += fmt::format("\n[[variable]]\nname = \"{}\"\nvalue = {}\n", name, value);
  }
};

Result<void> add_tool(const TableRow& row, double mm_per_unit, std::size_t at, SetupText& text) {
  text.tools += fmt::format("\n[[tool]]\nnumber = {}\npocket = {}\n", *row.number, *row.pocket);
  for (const auto& [letter, value] : row.values) {
    const std::string cell = fmt::format("tool.{}.", *row.number);
    switch (letter) {
      case 'X':
      case 'Z':
        text.tools += fmt::format("{} = {}\n", letter, value);
        break;
      case 'D':
        text.tools += fmt::format("radius = {}\n", value / 2);
        break;
      case 'Q':
        if (!(value >= 0 && value <= 9) || value != std::floor(value))
          return fail(Errc::Syntax, "tool table, line {}: Q{} is not from 0 to 9", at, value);
        text.tools += fmt::format("tip = {}\n", value);
        break;
      case 'I':
        text.add_variable(cell + "front_angle", value);
        break;
      case 'J':
        text.add_variable(cell + "back_angle", value);
        break;
      default:
        text.add_variable(cell + letter, is_rotary(*axis_of(letter)) ? value : value * mm_per_unit);
    }
  }
  return {};
}

Result<std::map<int, double>> read_parameters(std::string_view file) {
  std::map<int, double> values;
  auto read = for_each_line(file, [&](std::string_view line, std::size_t at) -> Result<void> {
    const auto number = whole_of(next_word(line), kAllParameters - 1);
    const auto value = number_of(next_word(line));
    if (!number || *number == 0 || !value || !line.empty())
      return fail(Errc::Syntax, "parameter file, line {}: a number from 1 to {} and its value", at,
                  kAllParameters - 1);
    if (!values.emplace(*number, *value).second)
      return fail(Errc::Syntax, "parameter file, line {}: parameter {} comes twice", at, *number);
    return {};
  });
  if (!read) return fail(read.error());
  return values;
}

/// Taken out of `values`, so that what is left are variables.
void add_offset(std::string_view name, int first, std::map<int, double>& values, SetupText& text) {
  std::string axes;
  for (const Axis axis : kAllAxes) {
    const auto value = values.extract(first + static_cast<int>(axis));
    if (value && value.mapped() != 0)
      axes += fmt::format("{} = {}\n", letter(axis), value.mapped());
  }
  if (!axes.empty()) text.offsets += fmt::format("\n[[offset]]\nname = \"{}\"\n{}", name, axes);
}

void add_parameters(std::map<int, double> values, SetupText& text) {
  add_offset("G28", kHome, values, text);
  add_offset("G30", kSecondHome, values, text);
  const auto active = values.extract(kG92Active);
  const std::size_t before = text.offsets.size();
  add_offset("G92", kG92Offsets, values, text);
  if (active && active.mapped() == 0 && text.offsets.size() > before) {
    text.offsets.resize(before);
    text.remarks += "# G92 was not in force: its values are left out.\n";
  }
  for (int system = 1; system <= kSystems; ++system)
    add_offset(kWorkSystems[static_cast<std::size_t>(system) - 1], first_of_system(system), values,
               text);
  for (const auto& [number, value] : values) {
    const bool is_kept = (number >= kFirstFree && number < kProbeResult) ||
                         (number >= kSystemNumber && number < kInputResult);
    const bool is_default = number == kSystemNumber ? value == 1 : value == 0;
    // A free parameter is kept because the file lists it.
    if (is_kept && (number < kProbeResult || !is_default))
      text.add_variable(fmt::format("#{}", number), value);
  }
}

struct Loaded {
  ControlOptions options;
  State state;
  Parameters parameters{};
  std::vector<Tool> tools;
};

Result<Loaded> load(Setup setup) {
  if (setup.control.find("profile") == nullptr)
    setup.control.set("profile", {std::string("linuxcnc"), 0});
  Loaded loaded;
  auto options = read_options(setup);
  if (!options) return fail(options.error());
  loaded.options = *std::move(options);
  if (auto done = load_memory(setup, loaded.options, loaded.state, loaded.parameters, loaded.tools);
      !done)
    return fail(done.error());
  return loaded;
}

/// That is not empty.
std::string_view first_line(std::string_view text) {
  std::string_view first;
  const auto read = for_each_line(text, [&](std::string_view line, std::size_t) -> Result<void> {
    first = line;
    return fail(Errc::Conflict, "the rest is not read");
  });
  return read ? std::string_view{} : first;
}

/// In the setup's units, without the last digits, which the conversion to mm and back has changed.
std::string number(double value) {
  return fmt::format("{:.12g}", value == 0 ? 0 : value);
}

}  // namespace

bool is_tool_table(std::string_view text) {
  // A TNC's tools begin with T, too; they have L and R.
  return read_row(first_line(text), 1).has_value();
}

bool is_parameter_file(std::string_view text) {
  std::string_view line = first_line(text);
  const bool are_numbers = number_of(next_word(line)) && number_of(next_word(line));
  return are_numbers && line.empty();
}

Result<std::string> setup_of_table_files(std::string_view tool_table,
                                         std::string_view parameter_file, Units units) {
  SetupText parts;
  std::map<int, std::size_t> lines;
  auto read = for_each_line(tool_table, [&](std::string_view line, std::size_t at) -> Result<void> {
    const auto row = read_row(line, at);
    if (!row) return fail(row.error());
    const auto [first, is_new] = lines.emplace(*row->number, at);
    if (!is_new)
      return fail(Errc::Syntax, "tool table, line {}: T{} is in line {} already", at, *row->number,
                  first->second);
    return add_tool(*row, mm_per_unit(units), at, parts);
  });
  if (!read) return fail(read.error());
  auto values = read_parameters(parameter_file);
  if (!values) return fail(values.error());
  add_parameters(*std::move(values), parts);
  std::string text =
      fmt::format("{}units = \"{}\"\n\n[control]\nprofile = \"linuxcnc\"\n{}{}{}", parts.remarks,
                  units == Units::Inch ? "in" : "mm", parts.tools, parts.offsets, parts.variables);
  const auto setup = parse_control_data(text);
  if (!setup) return fail(setup.error());
  if (const auto loaded = load(*setup); !loaded) return fail(loaded.error());
  return text;
}

Result<std::string> write_tool_table(const Setup& setup) {
  const auto loaded = load(setup);
  if (!loaded) return fail(loaded.error());
  const double mm = loaded->options.mm_per_machine_unit;
  std::map<int, int> pockets;
  for (const ToolRecord& record : setup.tools) {
    if (record.pocket) pockets[record.number] = *record.pocket;
  }
  std::string text;
  for (const Tool& tool : loaded->tools) {
    const auto pocket = pockets.find(tool.number);
    text +=
        fmt::format("T{} P{}", tool.number, pocket == pockets.end() ? tool.number : pocket->second);
    for (const Axis axis : kAllAxes) {
      const double length = tool.length[index_of(axis)] / (is_rotary(axis) ? 1 : mm);
      if (length != 0) text += fmt::format(" {}{}", letter(axis), number(length));
    }
    if (tool.diameter != 0) text += " D" + number(tool.diameter / mm);
    if (tool.front_angle != 0) text += " I" + number(tool.front_angle);
    if (tool.back_angle != 0) text += " J" + number(tool.back_angle);
    if (tool.orientation != 0) text += fmt::format(" Q{}", tool.orientation);
    text += '\n';
  }
  return text;
}

Result<std::string> write_parameter_file(const Setup& setup) {
  const auto loaded = load(setup);
  if (!loaded) return fail(loaded.error());
  const auto value = [&](int number) {
    return loaded->parameters[static_cast<std::size_t>(number)];
  };
  std::map<int, double> values;
  const auto add = [&](int first, int count) {
    for (int number = first; number < first + count; ++number) values[number] = value(number);
  };
  for (const VariableRecord& variable : setup.variables) {
    const auto number = whole_of(
        std::string_view(variable.name).substr(variable.name.starts_with('#') ? 1 : 0), kLastFree);
    if (number && *number >= kFirstFree) add(*number, 1);
  }
  const int axes = static_cast<int>(kAxisCount);
  add(kHome, axes);
  add(kSecondHome, axes);
  add(kG92Offsets, axes);
  const bool has_g92 = std::any_of(values.lower_bound(kG92Offsets), values.end(),
                                   [](const auto& entry) { return entry.second != 0; });
  values[kG92Active] = has_g92 ? 1 : 0;
  add(kSystemNumber, 1);
  for (int system = 1; system <= kSystems; ++system) add(first_of_system(system), axes + 1);
  std::string text;
  for (const auto& [number, of_number] : values)
    text += fmt::format("{}\t{:.6f}\n", number, of_number);
  return text;
}

}  // namespace dripline::interpreter::rs274ngc
