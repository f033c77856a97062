#include "server/api/bodies/run_bodies.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "protocol/base/names.hpp"
#include "server/api/bodies/json_object.hpp"
#include "server/library/job_queue.hpp"
#include "server/machines/start_point.hpp"

namespace dripline::api {
namespace {

constexpr std::size_t kMaxStartPoint = 24;
constexpr std::size_t kMaxRestartPlace = 48;
constexpr std::uint64_t kMaxPass = 1'000'000;
constexpr std::size_t kMaxArgument = 255;  ///< of the command's member in the IDL

struct ActionRow {
  std::string_view name;
  dds::CommandAction action;
  std::string_view needs;          ///< n(ame), t(ext), v(alue)
  std::string_view argument = {};  ///< that it always has
};
constexpr std::array kActions{
    ActionRow{"hold", dds::CommandAction::Hold, ""},
    ActionRow{"resume", dds::CommandAction::Resume, ""},
    ActionRow{"abort", dds::CommandAction::Abort, ""},
    ActionRow{"answer", dds::CommandAction::Answer, "t"},
    ActionRow{"switch", dds::CommandAction::Switch, "nv"},
    ActionRow{"feed_override", dds::CommandAction::FeedOverride, "v"},
    ActionRow{"rapid_override", dds::CommandAction::RapidOverride, "v"},
    ActionRow{"spindle_override", dds::CommandAction::SpindleOverride, "v"},
    ActionRow{"handwheel", dds::CommandAction::Handwheel, "v"},
    ActionRow{"stop_jog", dds::CommandAction::Abort, "", dds::kJogAbort},
};

Result<const ActionRow*> find_action(std::string_view name) {
  std::string known;
  for (const auto& row : kActions) {
    if (row.name == name) return &row;
    known += (known.empty() ? "" : ", ") + std::string(row.name);
  }
  return fail(Errc::Unsupported, "action '{}' is not known; known are: {}", name, known);
}

Result<void> check_value(const ActionRow& row, double value) {
  if (row.action == dds::CommandAction::Switch) {
    if (value == 0 || value == 1) return {};
    return fail(Errc::Syntax, "value {} of a switch must be 0 or 1", value);
  }
  if (row.action == dds::CommandAction::Handwheel) {
    if (value >= 1 && value <= kMaxClicks && value == std::floor(value)) return {};
    return fail(Errc::LimitExceeded, "value {} of handwheel must be a whole number from 1 to {}",
                value, kMaxClicks);
  }
  if (value >= 0 && value <= kMaxOverride) return {};
  return fail(Errc::LimitExceeded, "value {} of {} must be 0 to {}, 1 is 100 %", value, row.name,
              kMaxOverride);
}

}  // namespace

Result<machines::StartRequest> decode_start(std::string_view body) {
  auto object = JsonObject::parse(body);
  if (!object) return fail(object.error());
  machines::StartRequest start;
  start.machine = object->required_text("machine", kMaxName);
  start.program = object->required_text("program", kMaxName);
  start.revision = object->optional_unsigned("revision");
  const auto from = object->optional_text("from", kMaxStartPoint);
  const auto head = object->optional_text("head", kMaxStartPoint);
  const auto memory = object->optional_text("memory", kMaxStartPoint);
  const auto pass = object->optional_unsigned("pass");
  const auto test = object->optional_flag("test");
  if (auto good = object->finish(); !good) return fail(good.error());
  if (head && *head != "send" && *head != "set") {
    return fail(Errc::Syntax, "head is '{}'; expected send or set", *head);
  }
  start.is_test = test.value_or(false);
  if (head) start.head = *head == "send" ? machines::StartHead::Send : machines::StartHead::Set;
  if (memory && *memory != "begin" && *memory != "now") {
    return fail(Errc::Syntax, "memory is '{}'; expected begin or now", *memory);
  }
  if (memory) {
    start.memory = *memory == "begin" ? machines::StartMemory::Begin : machines::StartMemory::Now;
  }
  if (pass && (*pass == 0 || *pass > kMaxPass)) {
    return fail(Errc::LimitExceeded, "pass {} is not 1 to {}", *pass, kMaxPass);
  }
  if (auto good = check_machine_name(start.machine); !good) return fail(good.error());
  if (auto good = check_program_name(start.program); !good) return fail(good.error());
  if (!from && (memory || pass)) {
    return fail(Errc::Syntax, "memory and pass belong to a start with from");
  }
  if (!from) return start;
  const auto point = machines::parse_start_point(*from);
  if (!point) return fail(Errc::Syntax, "from: {}", point.error().what);
  start.from = *point;
  start.from.pass = pass;
  return start;
}

Result<JobBody> decode_job(std::string_view body) {
  auto object = JsonObject::parse(body);
  if (!object) return fail(object.error());
  JobBody read;
  read.job.program = object->required_text("program", kMaxName);
  read.job.revision = object->optional_unsigned("revision");
  read.job.quantity = object->optional_unsigned("quantity").value_or(1);
  read.job.parts_per_run = object->optional_unsigned("parts_per_run").value_or(1);
  const auto counts = object->optional_text("counts", kMaxName);
  read.job.comment = object->optional_text("comment", library::JobQueue::kMaxText).value_or("");
  read.place = object->optional_unsigned("place");
  if (auto good = object->finish(); !good) return fail(good.error());
  if (counts) {
    const auto parsed = storage::parse_job_count(*counts);
    if (!parsed) return fail(parsed.error());
    read.job.counts = *parsed;
  }
  if (auto good = check_program_name(read.job.program); !good) return fail(good.error());
  return read;
}

Result<std::optional<std::uint64_t>> decode_loaded_setup(std::string_view body) {
  auto object = JsonObject::parse(body);
  if (!object) return fail(object.error());
  const auto revision = object->optional_unsigned("revision");
  if (auto good = object->finish(); !good) return fail(good.error());
  return revision;
}

Result<std::uint64_t> decode_job_move(std::string_view body) {
  auto object = JsonObject::parse(body);
  if (!object) return fail(object.error());
  const auto place = object->optional_unsigned("place");
  if (auto good = object->finish(); !good) return fail(good.error());
  if (!place) return fail(Errc::Syntax, "member 'place' is missing: 1 is the first");
  return *place;
}

Result<std::optional<std::uint64_t>> decode_job_start(std::string_view body) {
  auto object = JsonObject::parse(body.empty() ? "{}" : body);
  if (!object) return fail(object.error());
  const auto job = object->optional_unsigned("job");
  if (auto good = object->finish(); !good) return fail(good.error());
  return job;
}

Result<std::string> decode_restart(std::string_view body) {
  auto object = JsonObject::parse(body.empty() ? "{}" : body);
  if (!object) return fail(object.error());
  const std::string at = object->optional_text("at", kMaxRestartPlace).value_or("executed");
  if (auto good = object->finish(); !good) return fail(good.error());
  constexpr std::string_view kAllowed =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789=:.-";
  if (at.empty() || at.find_first_not_of(kAllowed) != std::string::npos) {
    return fail(Errc::Syntax,
                "at is '{}'; expected executed, block=1234, L7, N120, T3 or "
                "time=2026-11-23T15:04:05Z",
                at);
  }
  return at;
}

namespace {

bool stops_jog(const machines::CommandRequest& command) {
  return command.action == dds::CommandAction::Abort && !command.argument.empty();
}

Result<machines::CommandRequest> decode_any_command(std::string_view body) {
  auto object = JsonObject::parse(body);
  if (!object) return fail(object.error());
  const std::string name = object->required_text("action", kMaxName);
  const auto text = object->optional_text("text", kMaxArgument);
  const auto switch_name = object->optional_text("name", kMaxArgument);
  const auto value = object->optional_number("value");
  if (auto good = object->finish(); !good) return fail(good.error());
  const auto row = find_action(name);
  if (!row) return fail(row.error());
  const auto mismatch = [&](char letter, bool is_given, std::string_view member) -> Result<void> {
    const bool is_needed = (*row)->needs.find(letter) != std::string_view::npos;
    if (is_needed == is_given) return {};
    return fail(Errc::Syntax, "action {} {} member '{}'", name,
                is_needed ? "needs" : "does not take", member);
  };
  if (auto good = mismatch('t', text.has_value(), "text"); !good) return fail(good.error());
  if (auto good = mismatch('n', switch_name.has_value(), "name"); !good) return fail(good.error());
  if (auto good = mismatch('v', value.has_value(), "value"); !good) return fail(good.error());
  if (value) {
    if (auto good = check_value(**row, *value); !good) return fail(good.error());
  }
  machines::CommandRequest command;
  command.action = (*row)->action;
  command.argument = text.value_or(switch_name.value_or(std::string((*row)->argument)));
  command.value = value.value_or(0);
  return command;
}

/// Of an axis: its letter, in capitals. Errors: Syntax.
Result<interpreter::Axis> read_axis(const std::string& letter) {
  const auto axis = letter.size() == 1 ? interpreter::axis_of(letter[0]) : std::nullopt;
  if (axis) return *axis;
  return fail(Errc::Syntax, "axis '{}' is none of X Y Z A B C U V W", letter);
}

/// Errors: Syntax.
Result<void> check_unit(interpreter::Axis axis, const std::optional<std::string>& unit) {
  if (!unit) return {};
  if (interpreter::is_rotary(axis)) {
    if (*unit == "deg") return {};
    return fail(Errc::Syntax, "unit '{}' of axis {}, which turns: its value is in degrees", *unit,
                interpreter::letter(axis));
  }
  if (*unit == "mm" || *unit == "in") return {};
  return fail(Errc::Syntax, "unit '{}' is neither mm nor in", *unit);
}

}  // namespace

Result<machines::CommandRequest> decode_command(std::string_view body) {
  auto command = decode_any_command(body);
  if (command && stops_jog(*command))
    return fail(Errc::Unsupported, "action 'stop_jog' is for a machine, not for a run");
  return command;
}

Result<std::string> decode_mdi(std::string_view body) {
  constexpr std::size_t kMaxMdi = 2048;
  auto object = JsonObject::parse(body);
  if (!object) return fail(object.error());
  std::string text = object->required_text("text", kMaxMdi);
  if (auto good = object->finish(); !good) return fail(good.error());
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
  if (text.empty()) return fail(Errc::Syntax, "text has no block");
  const auto is_bad = [](char c) { return c != '\n' && (c < ' ' || c > '~'); };
  if (std::ranges::any_of(text, is_bad))
    return fail(Errc::Syntax, "text has a character that cannot be keyed in");
  return text + "\n";
}

Result<interpreter::PositionSetting> decode_position_setting(std::string_view body, bool is_tool) {
  constexpr std::uint64_t kMaxTool = 99'999'999;
  constexpr double kMaxValue = 1e6;
  auto object = JsonObject::parse(body);
  if (!object) return fail(object.error());
  const std::uint64_t tool = is_tool ? object->optional_unsigned("tool").value_or(0) : 0;
  const std::string letter = object->required_text("axis", 1);
  const auto value = object->optional_number("value");
  const auto unit = object->optional_text("unit", 3);
  std::string offset = object->optional_text("offset", 16).value_or("");
  if (auto good = object->finish(); !good) return fail(good.error());
  const auto axis = read_axis(letter);
  if (!axis) return fail(axis.error());
  if (!value) return fail(Errc::Syntax, "value is missing");
  if (!(std::abs(*value) <= kMaxValue))
    return fail(Errc::LimitExceeded, "value {} is not {} to {}", *value, -kMaxValue, kMaxValue);
  if (auto fits = check_unit(*axis, unit); !fits) return fail(fits.error());
  if (!unit && *value != 0 && !interpreter::is_rotary(*axis))
    return fail(Errc::Syntax, "value {} needs a unit: mm or in", *value);
  if (is_tool && (tool == 0 || tool > kMaxTool))
    return fail(Errc::Syntax, "tool is missing, or not 1 to {}", kMaxTool);
  const auto capital = [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c; };
  std::ranges::transform(offset, offset.begin(), capital);  // as controls show them
  if (offset.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789.") != std::string::npos)
    return fail(Errc::Syntax, "offset '{}' is no name of one: G54, G54.1P7, G59.3", offset);
  const interpreter::PositionSetting setting{
      .tool = static_cast<int>(tool),
      .offset = offset,
      .axis = *axis,
      .value = *value,
      .units = unit == "in" ? interpreter::Units::Inch : interpreter::Units::Millimeter};
  // As its gateway reads it.
  return interpreter::parse_position_setting(interpreter::to_text(setting));
}

namespace {

constexpr std::size_t kMaxHoldWord = 64;

Result<void> check_hold_word(const std::string& word) {
  if (interpreter::is_hold_word(word)) return {};
  return fail(Errc::Syntax, "hold '{}': expected 1 to 64 letters, digits and '-'", word);
}

}  // namespace

Result<std::string> decode_jog_keep(std::string_view body) {
  auto object = JsonObject::parse(body);
  if (!object) return fail(object.error());
  std::string word = object->required_text("hold", kMaxHoldWord);
  if (auto good = object->finish(); !good) return fail(good.error());
  if (auto good = check_hold_word(word); !good) return fail(good.error());
  return word;
}

Result<interpreter::JogMove> decode_jog(std::string_view body) {
  constexpr double kMaxValue = 1e6;
  auto object = JsonObject::parse(body);
  if (!object) return fail(object.error());
  const std::string letter = object->required_text("axis", 1);
  const auto distance = object->optional_number("distance");
  const auto unit = object->optional_text("unit", 3);
  const auto feed = object->optional_number("feed");
  const auto hold = object->optional_text("hold", kMaxHoldWord);
  if (auto good = object->finish(); !good) return fail(good.error());
  if (hold) {
    if (auto good = check_hold_word(*hold); !good) return fail(good.error());
  }
  const auto axis = read_axis(letter);
  if (!axis) return fail(axis.error());
  if (auto fits = check_unit(*axis, unit); !fits) return fail(fits.error());
  if (!unit && !interpreter::is_rotary(*axis))
    return fail(Errc::Syntax, "unit is missing: mm or in");
  if (!distance || *distance == 0) return fail(Errc::Syntax, "distance is missing, or 0");
  if (!(std::abs(*distance) <= kMaxValue))
    return fail(Errc::LimitExceeded, "distance {} is not {} to {}", *distance, -kMaxValue,
                kMaxValue);
  if (feed && !(*feed > 0 && *feed <= kMaxValue))
    return fail(Errc::LimitExceeded, "feed {} is not above 0 and at most {}", *feed, kMaxValue);
  const interpreter::JogMove move{
      .axis = *axis,
      .distance = *distance,
      .units = unit == "in" ? interpreter::Units::Inch : interpreter::Units::Millimeter,
      .feed = feed,
      .hold = hold.value_or("")};
  return interpreter::parse_jog_move(interpreter::to_text(move));  // as its gateway reads it
}

Result<machines::CommandRequest> decode_machine_command(std::string_view body) {
  auto command = decode_any_command(body);
  if (!command) return command;
  using dds::CommandAction;
  const bool is_of_panel = command->action == CommandAction::Switch ||
                           command->action == CommandAction::FeedOverride ||
                           command->action == CommandAction::RapidOverride ||
                           command->action == CommandAction::SpindleOverride || stops_jog(*command);
  if (is_of_panel) return command;
  return fail(Errc::Unsupported,
              "action '{}' is for a run; a machine takes switch, feed_override, rapid_override, "
              "spindle_override and stop_jog",
              dds::to_string(command->action));
}

}  // namespace dripline::api
