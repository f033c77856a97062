#include "clients/tools/report_template/report_state.hpp"

#include <nlohmann/json.hpp>

namespace dripline::report_template {
namespace {

using nlohmann::json;

json numbers_json(const LineNumbers& numbers) {
  json made = {{"decimals", numbers.decimals}};
  for (const auto& [name, member] : kLineNumbers) {
    if (const auto& value = numbers.*member) made[name] = *value;
  }
  return made;
}

LineNumbers numbers_of(const json& text) {
  LineNumbers made;
  made.decimals = text.at("decimals").get<std::uint8_t>();
  for (const auto& [name, member] : kLineNumbers) {
    if (text.contains(name)) made.*member = text.at(name).get<double>();
  }
  return made;
}

json part_json(const PartSummary& part) {
  return {{"number", part.number},
          {"serial", part.serial},
          {"values", part.values},
          {"findings", part.findings},
          {"verdict", measurement::to_string(part.verdict)}};
}

measurement::Verdict verdict_of(const json& text) {
  const auto verdict = measurement::parse_verdict(text.get<std::string>());
  return verdict ? *verdict : measurement::Verdict::Unknown;
}

PartSummary part_of(const json& text) {
  return {.number = text.at("number").get<std::string>(),
          .serial = text.at("serial").get<std::string>(),
          .values = text.at("values").get<std::uint64_t>(),
          .findings = text.at("findings").get<std::uint64_t>(),
          .verdict = verdict_of(text.at("verdict"))};
}

ReportState state_of(const json& text) {
  ReportState state;
  state.is_open = text.at("is_open").get<bool>();
  state.part = part_of(text.at("part"));
  state.context = text.at("context").get<std::map<std::string, std::string>>();
  state.pending = numbers_of(text.at("pending"));
  if (text.contains("pending_of")) {  // a state of an older version has none
    for (const auto& [name, numbers] : text.at("pending_of").items())
      state.pending_of[name] = numbers_of(numbers);
  }
  if (const auto& partial = text.at("partial"); !partial.is_null()) {
    state.partial = ReportState::Partial{
        .rule = partial.at("rule").get<std::size_t>(),
        .step = partial.at("step").get<std::size_t>(),
        .texts = partial.at("texts").get<std::vector<std::string>>(),
    };
  }
  for (const auto& [rule, count] :
       text.at("ordinals").get<std::vector<std::pair<std::size_t, std::uint64_t>>>())
    state.ordinals[rule] = count;
  state.seen = text.at("seen").get<std::set<std::string>>();
  if (!text.at("highest").is_null()) state.highest = text.at("highest").get<std::int64_t>();
  state.missing = text.at("missing").get<std::vector<std::pair<std::int64_t, std::int64_t>>>();
  if (text.contains("kept")) {  // a state of an older version has none
    for (auto& [count, line] :
         text.at("kept").get<std::vector<std::pair<std::int64_t, std::string>>>())
      state.kept[count] = std::move(line);
  }
  if (!text.at("expected").is_null()) state.expected = text.at("expected").get<std::uint64_t>();
  state.lines = text.at("lines").get<std::uint64_t>();
  state.is_judged = text.at("is_judged").get<bool>();
  state.worst = verdict_of(text.at("worst"));
  state.is_incomplete = text.at("is_incomplete").get<bool>();
  // A state of an older version has none of these.
  state.cut = text.value("cut", std::string());
  state.is_after_cut = text.value("is_after_cut", false);
  state.has_expected = text.value("has_expected", false);
  state.last_end = text.value("last_end", std::string());
  return state;
}

/// Counts that no interpretation reaches would overflow the computation.
bool is_sound(const ReportState& state) {
  constexpr std::int64_t kMaxCount = 1'000'000'000;  // as read from lines
  const auto is_count = [](std::int64_t count) {
    return count >= -kMaxCount && count <= kMaxCount;
  };
  if (state.partial && state.partial->texts.empty()) return false;
  if (state.highest ? !is_count(*state.highest) : !state.missing.empty()) return false;
  if (state.kept.size() > ReportState::kMaxKept) return false;
  if (state.pending_of.size() > ReportState::kMaxPending) return false;
  return !state.expected || *state.expected <= std::uint64_t{kMaxCount};
}

}  // namespace

std::string to_json(const ReportState& state) {
  json ordinals = json::array();
  json kept = json::array();
  json pending_of = json::object();
  for (const auto& [name, numbers] : state.pending_of) pending_of[name] = numbers_json(numbers);
  for (const auto& [count, line] : state.kept) kept.push_back({count, line});
  for (const auto& [rule, count] : state.ordinals) ordinals.push_back({rule, count});
  const json text = {
      {"is_open", state.is_open},
      {"part", part_json(state.part)},
      {"context", state.context},
      {"pending", numbers_json(state.pending)},
      {"pending_of", pending_of},
      {"partial", state.partial ? json{{"rule", state.partial->rule},
                                       {"step", state.partial->step},
                                       {"texts", state.partial->texts}}
                                : json(nullptr)},
      {"ordinals", ordinals},
      {"seen", state.seen},
      {"highest", state.highest ? json(*state.highest) : json(nullptr)},
      {"missing", state.missing},
      {"kept", kept},
      {"expected", state.expected ? json(*state.expected) : json(nullptr)},
      {"lines", state.lines},
      {"is_judged", state.is_judged},
      {"worst", measurement::to_string(state.worst)},
      {"is_incomplete", state.is_incomplete},
      {"cut", state.cut},
      {"is_after_cut", state.is_after_cut},
      {"has_expected", state.has_expected},
      {"last_end", state.last_end},
  };
  return text.dump(-1, ' ', false, json::error_handler_t::replace);
}

Result<ReportState> parse_state(std::string_view text) {
  try {
    ReportState state = state_of(json::parse(text));
    if (!is_sound(state)) return fail(Errc::Corrupt, "state of a report: its counts");
    return state;
  } catch (const json::exception& e) {
    return fail(Errc::Corrupt, "state of a report: {}", e.what());
  }
}

}  // namespace dripline::report_template
