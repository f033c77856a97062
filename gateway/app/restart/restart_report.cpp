#include "gateway/app/restart/restart_report.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

#include "gateway/app/run/run_texts.hpp"
#include "gateway/interpreter/core/event.hpp"
#include "protocol/dds/message.hpp"

namespace dripline::gateway {

using interpreter::Position;
using Json = nlohmann::ordered_json;

namespace {

/// Nanometers are enough, and keep the text short.
double rounded(double value) {
  return std::round(value * 1e6) / 1e6 + 0.0;
}

Json axes_json(const Position& position) {
  Json json = Json::object();
  for (const interpreter::Axis axis : interpreter::kAllAxes) {
    if (position.has(axis))
      json[std::string(1, interpreter::letter(axis))] = rounded(position.raw(axis));
  }
  return json;
}

/// The axes of `from` that `of` names.
Position only(const Position& from, const Position& of) {
  Position position;
  for (const interpreter::Axis axis : interpreter::kAllAxes) {
    if (of.has(axis)) position.set_raw(axis, from.raw(axis));
  }
  return position;
}

Json origin_json(std::uint64_t block, std::uint64_t line, std::int64_t sequence) {
  Json json{{"block", block}, {"line", line}};
  json["n"] = sequence == interpreter::Origin::kNone ? Json() : Json(sequence);
  return json;
}

Json feed_json(const Feed& feed) {
  if (feed.per() == Feed::Per::Move) return {{"moves_per_min", rounded(feed.moves_per_minute())}};
  const bool is_minute = feed.per() == Feed::Per::Minute;
  return {{is_minute ? "mm_per_min" : "mm_per_rev", rounded(feed.length().mm())}};
}

/// As the tool counts it that is in the spindle before another one is put in.
Position in_spindle(const RestartReport& report, const Position& position) {
  return machine::plus(position, report.length_change);
}

Json moves_json(const RestartReport& report) {
  const Approach::Plan& plan = report.approach;
  Json moves = Json::array();
  const auto add = [&moves](const ApproachMove& move) {
    Json json{{"move", move.arc    ? "arc"
                       : move.feed ? "feed"
                                   : "rapid"},
              {"to", axes_json(move.to)}};
    if (move.feed) json["feed"] = feed_json(*move.feed);
    moves.push_back(std::move(json));
  };
  for (std::size_t i = 0; i <= plan.before.size(); ++i) {
    if (i == plan.retracts && report.tool_to_change)
      moves.push_back({{"move", "change_tool"}, {"tool", *report.tool_to_change}});
    if (i == plan.before.size()) break;
    ApproachMove move = plan.before[i];
    if (i < plan.retracts) move.to = in_spindle(report, move.to);
    add(move);
  }
  moves.push_back({{"move", "switch_on"}});
  for (const ApproachMove& move : plan.after) add(move);
  return moves;
}

Json switched_on_json(const DeliveredState& state) {
  Json json{{"spindle", interpreter::word_of(state.spindle.state)}};
  if (state.spindle.surface_speed) {
    json["surface_mm_per_min"] = rounded(state.spindle.surface_speed->mm());
  } else {
    json["rpm"] = rounded(state.spindle.revolutions_per_minute);
  }
  json["flood"] = state.flood;
  json["mist"] = state.mist;
  return json;
}

Json tool_json(const RestartReport& report) {
  const DeliveredState& state = report.delivered;
  Json json{{"number", state.tool ? Json(*state.tool) : Json()},
            {"offset", state.tool_offset ? Json(*state.tool_offset) : Json()},
            {"next", state.next_tool ? Json(*state.next_tool) : Json()},
            {"length_x", rounded(report.modes.tool_length_x.mm())},
            {"length_z", rounded(report.modes.tool_length_z.mm())},
            {"radius", rounded(report.modes.tool_radius.mm())}};
  return json;
}

Json modes_json(const RestartReport& report) {
  using interpreter::CompensationSide;
  constexpr std::string_view kSides[] = {"off", "left", "right"};
  Json json{{"units", interpreter::word_of(report.modes.units)},
            {"work_system", work_system_text(report.modes)},
            {"compensation", kSides[static_cast<std::size_t>(report.modes.compensation)]},
            {"cycle", report.modes.cycle},
            {"feed", feed_json(report.modes.feed)}};
  if (!report.frame) return json;
  Json datum = Json::object(), shift = Json::object();
  for (const interpreter::Axis axis : interpreter::kAllAxes) {
    const auto i = static_cast<std::size_t>(axis);
    const std::string letter(1, interpreter::letter(axis));
    if (report.frame->datum[i] != 0) datum[letter] = rounded(report.frame->datum[i]);
    if (report.frame->shift[i] != 0) shift[letter] = rounded(report.frame->shift[i]);
  }
  json["datum"] = std::move(datum);
  json["shift"] = std::move(shift);
  json["rotation"] = rounded(report.frame->rotation);
  return json;
}

Json codes_json(const std::vector<int>& codes) {
  Json json = Json::array();
  for (const int code : codes) {
    if (code < DeliveredState::kOutput) {
      json.push_back(fmt::format("M{:02}", code));
      continue;
    }
    const int axis = (code - DeliveredState::kOutput) / 100;
    json.push_back(fmt::format("output {} of {}", code % 100,
                               interpreter::letter(static_cast<interpreter::Axis>(axis % 9))));
  }
  return json;
}

Json proof_json(const RestartReport& report) {
  Json json;
  json["state"] = report.state_equal_at ? "equal" : "no record";
  json["state_block"] = report.state_equal_at ? Json(*report.state_equal_at) : Json();
  json["state_digest"] = report.state_equal_at ? Json(report.state_digest.hex()) : Json();
  json["path"] = report.is_path_equal ? "equal" : "no record";
  return json;
}

}  // namespace

std::string to_json(const RestartReport& report) {
  Json json;
  json["restart_of"] = report.original.run;
  json["program"] = report.original.program;
  json["revision"] = report.original.revision;
  json["at"] = report.at.text;
  json["cut_off_at"] = report.cut_off_at;
  json["on_record"] = report.on_record;
  json["after"] = origin_json(report.after.block, report.after.line, report.after.sequence);
  json["checkpoint"] = report.checkpoint;
  json["proof"] = proof_json(report);
  json["switched_on"] = switched_on_json(report.delivered);
  json["tool"] = tool_json(report);
  json["modes"] = modes_json(report);
  json["not_repeated"] = codes_json(report.delivered.codes);
  json["position"] = axes_json(only(in_spindle(report, report.machine), report.delivered.position));
  json["continues_at"] = axes_json(report.delivered.position);
  json["program_has_ended"] = report.has_ended;
  json["approach"] = report.has_ended ? Json::array() : moves_json(report);
  json["approach_by"] = "default";
  json["stopped_at"] =
      report.stopped_at
          ? axes_json(only(in_spindle(report, *report.stopped_at), report.delivered.position))
          : Json();
  Json next = origin_json(report.next.block, report.next.line, report.next.sequence);
  next["length_mm"] = report.next.has_ended ? Json(rounded(report.next.length)) : Json();
  next["left_mm"] = report.next.left ? Json(rounded(*report.next.left)) : Json();
  json["next"] = std::move(next);
  std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  if (text.size() <= dds::kMaxRecordText) return text;
  json["not_repeated"] = Json::array();
  json["approach"] = Json::array();
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace dripline::gateway
