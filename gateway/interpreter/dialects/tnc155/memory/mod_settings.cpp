// How the options that the MOD menu holds are read and checked.
#include <fmt/ranges.h>
#include <algorithm>
#include <array>

#include "gateway/interpreter/dialects/tnc155/memory/memory_files.hpp"
#include "gateway/interpreter/dialects/tnc155/memory/mod_functions.hpp"

namespace dripline::interpreter::tnc155 {
namespace {

constexpr std::array kBaudRates{110, 150, 300, 600, 1200, 2400, 4800, 9600};
constexpr std::size_t kLongestText = 80;  ///< of a dialog; a choice of ours

template <class... Arguments>
tl::unexpected<Error> refuse(std::string_view key, fmt::format_string<Arguments...> text,
                             Arguments&&... arguments) {
  return fail(Errc::Syntax, "option {}: {}", key,
              fmt::format(text, std::forward<Arguments>(arguments)...));
}

/// A text that is one of `allowed`; gives its place among them.
template <std::size_t kCount>
Result<std::size_t> choice(const Options& options, std::string_view key,
                           const std::array<std::string_view, kCount>& allowed) {
  const auto text = options.text(key, allowed.front());
  if (!text) return fail(text.error());
  const auto at = std::ranges::find(allowed, *text);
  if (at == allowed.end()) {
    return refuse(key, "\"{}\" is none of {}", *text, fmt::join(allowed, ", "));
  }
  return static_cast<std::size_t>(at - allowed.begin());
}

Result<void> read_display(const Options& options, ModSettings& settings) {
  constexpr std::array<std::string_view, 2> kUnits{"mm", "inch"};
  constexpr std::array<std::string_view, 2> kSizes{"small", "large"};
  const auto units = choice(options, "display_units", kUnits);
  if (!units) return fail(units.error());
  const auto position = choice(options, "position_display", kPositionDisplays);
  if (!position) return fail(position.error());
  const auto size = choice(options, "display_size", kSizes);
  if (!size) return fail(size.error());
  settings.display_units = *units == 0 ? Units::Millimeter : Units::Inch;
  settings.position_display = static_cast<PositionDisplay>(*position);
  settings.is_display_large = *size == 1;
  return {};
}

Result<void> read_line_settings(const Options& options, ModSettings& settings) {
  const auto increment = options.integer("block_increment", settings.block_increment);
  if (!increment) return fail(increment.error());
  if (*increment < 0 || *increment > kHighestIncrement) {
    return refuse("block_increment", "{} is not 0 to {}", *increment, kHighestIncrement);
  }
  settings.block_increment = static_cast<int>(*increment);
  if (options.find("baud_rate") == nullptr) return {};
  const auto rate = options.integer("baud_rate", 0);
  if (!rate) return fail(rate.error());
  if (std::ranges::find(kBaudRates, *rate) == kBaudRates.end()) {
    return refuse("baud_rate", "{} is none of {}", *rate, fmt::join(kBaudRates, ", "));
  }
  settings.baud_rate = static_cast<int>(*rate);
  return {};
}

/// "227 020 08": the program, its variant, its version.
Result<std::string> software_number(const Options& options, std::string_view key) {
  auto text = options.text(key, "");
  if (!text || text->empty()) return text;
  constexpr std::string_view kShape = "ddd ddd dd";
  bool fits = text->size() == kShape.size();
  for (std::size_t i = 0; fits && i < kShape.size(); ++i) {
    const char c = (*text)[i];
    fits = kShape[i] == 'd' ? c >= '0' && c <= '9' : c == ' ';
  }
  if (!fits) return refuse(key, "\"{}\" is no software number as 227 020 08", *text);
  return text;
}

Result<void> read_limits(const Options& options, ModSettings& settings) {
  const std::pair<std::string_view, Position*> ends[] = {{"limit_low", &settings.limit_low},
                                                         {"limit_high", &settings.limit_high}};
  for (const auto& [key, position] : ends) {
    const auto read = options.position(key);
    if (!read) return fail(read.error());
    *position = *read;
    for (const Axis axis : kAllAxes) {
      if (!read->has(axis) || std::abs(read->raw(axis)) <= kFarthestLimit) continue;
      return refuse(key, "{} {} is not {} to {}", letter(axis), read->raw(axis), -kFarthestLimit,
                    kFarthestLimit);
    }
  }
  return {};
}

std::optional<double> as_number(const OptionValue& value) {
  if (const auto* whole = std::get_if<std::int64_t>(&value.value))
    return static_cast<double>(*whole);
  if (const auto* number = std::get_if<double>(&value.value)) return *number;
  return std::nullopt;
}

/// Reads one table of the list; `place` begins at 1.
class UserParameterReader {
 public:
  explicit UserParameterReader(std::size_t place) : place_(place) {}

  Result<UserParameter> read(const OptionValue& value) {
    const auto* table = std::get_if<OptionTable>(&value.value);
    if (table == nullptr) return wrong("expected a table with parameter, text and value");
    read_.text = fmt::format("USER PAR. {}", place_);
    for (const OptionEntry& entry : *table) {
      if (auto done = take(entry); !done) return fail(done.error());
    }
    if (!has_parameter_) return wrong("parameter is missing: the number of a machine parameter");
    if (!has_value_) return wrong(fmt::format("value of MP{} is missing", read_.parameter));
    return check_range();
  }

 private:
  tl::unexpected<Error> wrong(const std::string& text) const {
    return refuse("user_parameters", "{}: {}", place_, text);
  }

  Result<void> take(const OptionEntry& entry) {
    if (entry.key == "text") return take_text(entry.value);
    const auto number = as_number(entry.value);
    const bool is_known = entry.key == "parameter" || entry.key == "value" || entry.key == "min" ||
                          entry.key == "max";
    if (!is_known) {
      return wrong(
          fmt::format("{} is nothing a user parameter has; it has parameter, text, value, min, max",
                      entry.key));
    }
    if (!number) return wrong(fmt::format("{} is not a number", entry.key));
    if (entry.key == "parameter") return take_parameter(*number);
    if (entry.key == "min") {
      read_.min = *number;
    } else if (entry.key == "max") {
      read_.max = *number;
    } else {
      read_.value = *number;
      has_value_ = true;
    }
    return {};
  }

  Result<void> take_text(const OptionValue& value) {
    const auto* text = std::get_if<std::string>(&value.value);
    if (text == nullptr) return wrong("text is not a text in quotes");
    if (text->size() > kLongestText) {
      return wrong(fmt::format("a text of {} bytes, at most {}", text->size(), kLongestText));
    }
    if (!text->empty()) read_.text = *text;
    return {};
  }

  Result<void> take_parameter(double number) {
    if (number < 0 || number > kLastMachineParameter || number != static_cast<int>(number)) {
      return wrong(fmt::format("MP{:g}: there are MP0 to MP{}", number, kLastMachineParameter));
    }
    read_.parameter = static_cast<int>(number);
    has_parameter_ = true;
    return {};
  }

  Result<UserParameter> check_range() const {
    const auto min = read_.min, max = read_.max;
    if (min && max && *min > *max) {
      return wrong(fmt::format("min, {}, is more than max, {}", *min, *max));
    }
    if (auto good = check_value(read_, read_.value); !good) return wrong(good.error().what);
    return read_;
  }

  std::size_t place_;
  UserParameter read_;
  bool has_parameter_ = false, has_value_ = false;
};

/// A machine parameter has one value, wherever it is written, and one place in the menu.
Result<void> check_twice(const UserParameter& parameter, std::size_t place,
                         const MachineParameters& machine,
                         const std::vector<UserParameter>& others) {
  for (const UserParameter& other : others) {
    if (other.parameter == parameter.parameter) {
      return refuse("user_parameters", "{}: MP{} is one already", place, parameter.parameter);
    }
    if (other.text == parameter.text) {
      return refuse("user_parameters", "{}: \"{}\" names another one already", place,
                    parameter.text);
    }
  }
  const auto known = machine.find(parameter.parameter);
  if (known == machine.end() || known->second == parameter.value) return {};
  return refuse("user_parameters", "{}: {}, but machine_parameters has MP{} = {}", place,
                parameter.value, parameter.parameter, known->second);
}

Result<void> read_user_parameters(const Options& options, ModSettings& settings) {
  const OptionValue* found = options.find("user_parameters");
  if (found == nullptr) return {};
  const auto* list = std::get_if<OptionList>(&found->value);
  if (list == nullptr) {
    return refuse("user_parameters", "expected a list of tables, [[control.user_parameters]]");
  }
  if (list->size() > kMaxUserParameters) {
    return refuse("user_parameters", "{} are given, the control has {}", list->size(),
                  kMaxUserParameters);
  }
  const auto machine = machine_parameters_of(options);
  if (!machine) return fail(machine.error());
  auto& parameters = settings.user_parameters;
  for (const OptionValue& value : *list) {
    const std::size_t place = parameters.size() + 1;
    auto parameter = UserParameterReader(place).read(value);
    if (!parameter) return fail(parameter.error());
    if (auto once = check_twice(*parameter, place, *machine, parameters); !once) return once;
    parameters.push_back(*std::move(parameter));
  }
  return {};
}

}  // namespace

Result<ModSettings> read_mod_settings(const Options& options) {
  ModSettings settings;
  for (auto* read : {&read_display, &read_line_settings, &read_limits, &read_user_parameters}) {
    if (auto done = read(options, settings); !done) return fail(done.error());
  }
  auto nc = software_number(options, "nc_software");
  if (!nc) return fail(nc.error());
  auto plc = software_number(options, "plc_software");
  if (!plc) return fail(plc.error());
  settings.nc_software = *std::move(nc);
  settings.plc_software = *std::move(plc);
  const auto fourth = options.text("fourth_axis", "C");
  if (fourth && fourth->size() == 1) settings.fourth_axis = axis_of((*fourth)[0]).value_or(Axis::C);
  const auto blocks = options.integer("memory_blocks", 3'100);
  if (blocks && *blocks > 0) settings.memory_blocks = static_cast<std::size_t>(*blocks);
  return settings;
}

Result<MachineParameters> all_machine_parameters(const Options& options) {
  auto parameters = machine_parameters_of(options);
  if (!parameters) return fail(parameters.error());
  const auto settings = read_mod_settings(options);
  if (!settings) return fail(settings.error());
  for (const UserParameter& user : settings->user_parameters) {
    (*parameters)[user.parameter] = user.value;
  }
  return std::move(*parameters);
}

}  // namespace dripline::interpreter::tnc155
