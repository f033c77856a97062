#include "gateway/interpreter/dialects/tnc155/memory/memory_files.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

namespace dripline::interpreter::tnc155 {
namespace {

std::string length_text(Length length, Units units, char decimal_sign) {
  const bool is_inch = units == Units::Inch;
  std::string text =
      is_inch ? fmt::format("{:+.4f}", length.inch()) : fmt::format("{:+.3f}", length.mm());
  std::ranges::replace(text, '.', decimal_sign);
  return text;
}

/// Lines with their numbers, without blanks at their ends and CR; empty ones left out.
template <class Take>
Result<void> each_line(std::string_view text, Take take) {
  int number = 0;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    ++number;
    const auto is_blank = [](char c) { return static_cast<unsigned char>(c) <= ' '; };
    while (!line.empty() && is_blank(line.back())) line.remove_suffix(1);
    while (!line.empty() && is_blank(line.front())) line.remove_prefix(1);
    if (line.empty()) continue;
    if (auto taken = take(line); !taken) {
      return fail(taken.error().code, "line {}: {}", number, taken.error().what);
    }
  }
  return {};
}

/// Takes words off the front of a line.
class Words {
 public:
  explicit Words(std::string_view line) : line_(line) {}
  bool take(std::string_view word) {
    skip();
    if (!line_.starts_with(word)) return false;
    line_.remove_prefix(word.size());
    return true;
  }
  /// Comma or point before the decimals.
  std::optional<double> number() {
    skip();
    std::string text;
    while (!line_.empty() &&
           (std::isdigit(static_cast<unsigned char>(line_.front())) != 0 ||
            std::string_view("+-,.").find(line_.front()) != std::string_view::npos)) {
      if (line_.front() != '+') text += line_.front() == ',' ? '.' : line_.front();
      line_.remove_prefix(1);
    }
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool is_whole = error == std::errc{} && end == text.data() + text.size();
    return is_whole && std::fabs(value) <= kMax ? std::optional(value) : std::nullopt;
  }
  bool is_at_end() {
    skip();
    return line_.empty();
  }

 private:
  static constexpr double kMax = 1e9;
  void skip() {
    while (!line_.empty() && line_.front() == ' ') line_.remove_prefix(1);
  }
  std::string_view line_;
};

bool is_frame(std::string_view line) {
  return line.find("PGM") != std::string_view::npos;
}

Result<ToolRecord> read_tool(std::string_view line, Units units) {
  Words words(line);
  ToolRecord tool;
  const auto length = [&](double value) {
    return units == Units::Inch ? Length::inch(value) : Length::mm(value);
  };
  const auto number = words.take("T") ? words.number() : std::nullopt;
  if (!number) return fail(Errc::Syntax, "\"{}\": expected T and its number", line);
  tool.number = static_cast<int>(*number);
  if (*number < 1 || *number > kMaxStoredTools || *number != tool.number) {
    return fail(Errc::LimitExceeded, "T{:g}: the store has tools 1 to {}", *number,
                kMaxStoredTools);
  }
  tool.is_special = words.take("S");
  if (words.take("P")) {
    if (const auto pocket = words.number())
      tool.pocket = static_cast<int>(std::clamp(*pocket, 0.0, 9999.0));
  }
  const auto tool_length = words.take("L") ? words.number() : std::nullopt;
  const auto radius = words.take("R") ? words.number() : std::nullopt;
  if (!tool_length || !radius || !words.is_at_end()) {
    return fail(Errc::Syntax, "\"{}\": expected T, P, L and R", line);
  }
  tool.length.set(Axis::Z, length(*tool_length));
  tool.radius = length(*radius);
  return tool;
}

/// The last ones came with later software.
Result<void> check_parameter(int number, const ControlVersion& version) {
  constexpr int kFirstOfPrinter = 225, kFirstOfLater = 235;
  if (number < kFirstOfPrinter) return {};
  const Feature feature =
      number < kFirstOfLater ? Feature::PrinterParameters : Feature::LaterParameters;
  if (version.has(feature)) return {};
  return fail(Errc::Unsupported, "MP{}: {}", number, version.lacks(feature));
}

/// Of "MP71".
Result<int> parameter_number(std::string_view key) {
  Words words(key);
  const auto number = words.take("MP") ? words.number() : std::nullopt;
  if (!number || !words.is_at_end()) {
    return fail(Errc::Syntax, "\"{}\": expected MP and a number", key);
  }
  if (*number < 0 || *number > kLastMachineParameter || *number != std::floor(*number)) {
    return fail(Errc::LimitExceeded, "{}: there are MP0 to MP{}", key, kLastMachineParameter);
  }
  return static_cast<int>(*number);
}

}  // namespace

Result<std::string> write_tool_store(const std::vector<ToolRecord>& tools, Units units,
                                     char decimal_sign) {
  if (tools.size() > kMaxStoredTools) {
    return fail(Errc::LimitExceeded, "{} tools: the store has {}", tools.size(), kMaxStoredTools);
  }
  const char* unit = units == Units::Inch ? "INCH" : "MM";
  std::string text = fmt::format("0 BEGIN PGM 0 {}\r\n", unit);
  for (const ToolRecord& tool : tools) {
    if (tool.number < 1 || tool.number > kMaxStoredTools) {
      return fail(Errc::LimitExceeded, "tool {}: the store has tools 1 to {}", tool.number,
                  kMaxStoredTools);
    }
    text += fmt::format("T{} {}P{} L{} R{}\r\n", tool.number, tool.is_special ? "S" : "",
                        tool.pocket ? std::to_string(*tool.pocket) : "",
                        length_text(tool.length.linear(Axis::Z), units, decimal_sign),
                        length_text(tool.radius, units, decimal_sign));
  }
  return text + fmt::format("{} END PGM 0 {}\r\n", tools.size() + 1, unit);
}

Result<std::vector<ToolRecord>> read_tool_store(std::string_view text,
                                                const ControlVersion& version) {
  if (!version.has(Feature::ToolStore)) {
    return fail(Errc::Unsupported, "{}", version.lacks(Feature::ToolStore));
  }
  std::vector<ToolRecord> tools;
  Units units = Units::Millimeter;
  auto read = each_line(text, [&](std::string_view line) -> Result<void> {
    if (is_frame(line)) {
      if (line.ends_with("INCH")) units = Units::Inch;
      return {};
    }
    const auto tool = read_tool(line, units);
    if (!tool) return fail(tool.error());
    if (std::ranges::find(tools, tool->number, &ToolRecord::number) != tools.end()) {
      return fail(Errc::Syntax, "tool {} is there twice", tool->number);
    }
    tools.push_back(*tool);
    return {};
  });
  if (!read) return fail(read.error());
  return tools;
}

std::string write_machine_parameters(const MachineParameters& parameters) {
  std::string text;
  for (const auto& [number, value] : parameters) text += fmt::format("MP{}: {}\r\n", number, value);
  return text;
}

Result<MachineParameters> read_machine_parameters(std::string_view text,
                                                  const ControlVersion& version) {
  MachineParameters parameters;
  auto read = each_line(text, [&](std::string_view line) -> Result<void> {
    Words words(line);
    const auto number = words.take("MP") ? words.number() : std::nullopt;
    const auto value = number && words.take(":") ? words.number() : std::nullopt;
    if (!value || !words.is_at_end()) {
      return fail(Errc::Syntax, "\"{}\": expected MP, its number, a colon and a value", line);
    }
    if (*number < 0 || *number > kLastMachineParameter) {
      return fail(Errc::LimitExceeded, "MP{:g}: there are 0 to {}", *number, kLastMachineParameter);
    }
    if (auto known = check_parameter(static_cast<int>(*number), version); !known) return known;
    if (!parameters.emplace(static_cast<int>(*number), *value).second) {
      return fail(Errc::Syntax, "MP{:g} is there twice", *number);
    }
    return {};
  });
  if (!read) return fail(read.error());
  return parameters;
}

Result<MachineParameters> machine_parameters_of(const Options& options) {
  MachineParameters parameters;
  const OptionValue* found = options.find("machine_parameters");
  if (found == nullptr) return parameters;
  const auto* table = std::get_if<OptionTable>(&found->value);
  if (table == nullptr) {
    return fail(Errc::Syntax,
                "option machine_parameters, line {}: expected a table, MP71 = 515 ...",
                found->line);
  }
  const auto version = version_of(options);
  if (!version) return fail(version.error());
  for (const auto& [key, value] : *table) {
    const auto* whole = std::get_if<std::int64_t>(&value.value);
    const auto* broken = std::get_if<double>(&value.value);
    if (whole == nullptr && broken == nullptr) {
      return fail(Errc::Syntax, "option machine_parameters, line {}: {} is not a number",
                  value.line, key);
    }
    const auto number = parameter_number(key);
    if (!number) {
      return fail(number.error().code, "option machine_parameters, line {}: {}", value.line,
                  number.error().what);
    }
    if (auto known = check_parameter(*number, *version); !known) {
      return fail(known.error().code, "option machine_parameters, line {}: {}", value.line,
                  known.error().what);
    }
    parameters[*number] = whole != nullptr ? static_cast<double>(*whole) : *broken;
  }
  return parameters;
}

}  // namespace dripline::interpreter::tnc155
