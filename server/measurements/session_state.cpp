#include <nlohmann/json.hpp>

#include "server/measurements/derivation.hpp"

namespace dripline::measurements {
namespace {

using measurement::Verdict;
using nlohmann::json;

constexpr const char* kActions[] = {"none", "hold_queue", "hold_machine"};

report_template::Action action_of(const std::string& text) {
  for (std::size_t i = 0; i < std::size(kActions); ++i) {
    if (text == kActions[i]) return static_cast<report_template::Action>(i);
  }
  return report_template::Action::None;
}

json part_json(const storage::MeasuredPart& part) {
  return {{"id", part.id},
          {"number", part.number},
          {"serial", part.serial},
          {"measurements", part.measurements},
          {"findings", part.findings},
          {"verdict", measurement::to_string(part.verdict)},
          {"begun", part.begun.time_since_epoch().count()}};
}

Verdict verdict_of(const json& text) {
  return measurement::parse_verdict(text.get<std::string>()).value_or(Verdict::Unknown);
}

storage::MeasuredPart part_of(const json& text) {
  storage::MeasuredPart part;
  part.id = text.at("id").get<std::uint64_t>();
  part.number = text.at("number").get<std::string>();
  part.serial = text.at("serial").get<std::string>();
  part.measurements = text.at("measurements").get<std::uint64_t>();
  part.findings = text.at("findings").get<std::uint64_t>();
  part.verdict = verdict_of(text.at("verdict"));
  part.begun = UtcTime{std::chrono::microseconds{text.at("begun").get<std::int64_t>()}};
  return part;
}

json session_json(const Session& session) {
  return {{"template", session.used.name},
          {"version", session.used.version},
          {"is_of_macro", session.used.is_of_macro},
          {"state", report_template::to_json(session.interpreter.state())},
          {"part", part_json(session.part)},
          {"unmatched", session.unmatched},
          {"announced", measurement::to_string(session.announced)}};
}

}  // namespace

std::string to_json(const MachineState& state) {
  json sessions = json::array(), due = json::array();
  for (const Session& session : state.sessions) sessions.push_back(session_json(session));
  for (const DueAction& one : state.due)
    due.push_back({{"part", one.part}, {"action", report_template::to_string(one.action)}});
  const json text = {{"run", state.run},           {"program", state.program},
                     {"revision", state.revision}, {"is_foreign", state.is_foreign},
                     {"sessions", sessions},       {"due", due}};
  return text.dump(-1, ' ', false, json::error_handler_t::replace);
}

Result<MachineState> parse_machine_state(
    const std::string& text,
    const std::function<Result<UsedTemplate>(const std::string&, std::uint64_t)>& find) {
  MachineState state;
  if (text.empty()) return state;
  try {
    const json all = json::parse(text);
    state.run = all.at("run").get<std::string>();
    state.program = all.at("program").get<std::string>();
    state.revision = all.at("revision").get<std::uint64_t>();
    state.is_foreign = all.at("is_foreign").get<bool>();
    for (const json& one : all.at("due"))
      state.due.push_back(
          {one.at("part").get<std::uint64_t>(), action_of(one.at("action").get<std::string>())});
    for (const json& one : all.at("sessions")) {
      auto used =
          find(one.at("template").get<std::string>(), one.at("version").get<std::uint64_t>());
      if (!used) return fail(used.error());
      used->is_of_macro = one.at("is_of_macro").get<bool>();
      auto inner = report_template::parse_state(one.at("state").get<std::string>());
      if (!inner) return fail(inner.error());
      Session session(*std::move(used), *std::move(inner));
      session.part = part_of(one.at("part"));
      session.part.template_name = session.used.name;
      session.part.template_version = session.used.version;
      session.part.run = state.run;
      session.part.program = state.program;
      session.part.revision = state.revision;
      session.unmatched = one.at("unmatched").get<std::uint64_t>();
      session.announced = verdict_of(one.at("announced"));
      state.sessions.push_back(std::move(session));
    }
  } catch (const json::exception& e) {
    return fail(Errc::Corrupt, "state of measurements: {}", e.what());
  }
  return state;
}

}  // namespace dripline::measurements
