#include "clients/cli/server/runs/restart_text.hpp"

#include <fmt/format.h>

#include "clients/cli/text/value_text.hpp"

namespace dripline::cli {
namespace {

using Json = nlohmann::ordered_json;

std::string axes_text(const Json& axes) {
  std::string text;
  if (!axes.is_object()) return "not known";
  for (const auto& [axis, value] : axes.items())
    text += fmt::format("{}{} {:.3f}", text.empty() ? "" : "  ", axis, value.get<double>());
  return text.empty() ? "no axis has moved" : text + " (machine coordinates)";
}

std::string programmed_feed(const Json& feed) {
  for (const auto& [unit, value] : feed.items()) {
    if (unit == "mm_per_min") return fmt::format("{:.4g} mm/min", value.get<double>());
    if (unit == "mm_per_rev") return fmt::format("{:.4g} mm per revolution", value.get<double>());
    return fmt::format("{:.4g} moves/min", value.get<double>());
  }
  return "none";
}

std::string block_text(const Json& block) {
  std::string text = fmt::format("block {}", block.at("block").get<std::uint64_t>());
  const auto line = block.at("line").get<std::uint64_t>();
  if (line > 0) text += fmt::format(", line {}", line);
  if (block.at("n").is_number()) text += fmt::format(", N{}", block.at("n").get<std::int64_t>());
  return text;
}

std::string switched_on_text(const Json& on) {
  const auto spindle = on.at("spindle").get<std::string>();
  std::string text = "spindle " + spindle;
  if (spindle != "off" && on.contains("rpm"))
    text += fmt::format(" {:.0f} rpm", on.at("rpm").get<double>());
  if (spindle != "off" && on.contains("surface_mm_per_min"))
    text += fmt::format(" {:.1f} m/min", on.at("surface_mm_per_min").get<double>() / 1000);
  const bool flood = on.at("flood").get<bool>(), mist = on.at("mist").get<bool>();
  text += flood || mist ? ", coolant" : ", no coolant";
  if (flood) text += " flood";
  if (mist) text += " mist";
  return text;
}

std::string tool_text(const Json& tool) {
  std::string text = tool.at("number").is_number()
                         ? fmt::format("T{}", tool.at("number").get<int>())
                         : "none named";
  if (tool.at("offset").is_number())
    text += fmt::format(", offset {}", tool.at("offset").get<int>());
  const auto length = [&](const char* name, const char* label) {
    const double value = tool.at(name).get<double>();
    if (value != 0) text += fmt::format(", {} {:.3f}", label, value);
  };
  length("length_x", "length X");
  length("length_z", "length Z");
  length("radius", "radius");
  return text;
}

std::string modes_text(const Json& modes) {
  std::string text = modes.at("units").get<std::string>();
  const auto add = [&](const char* name, const char* label) {
    const auto value = modes.at(name).get<std::string>();
    if (!value.empty() && value != "off") text += fmt::format(", {}{}", label, value);
  };
  add("work_system", "");
  add("compensation", "compensation ");
  add("cycle", "cycle ");
  text += ", feed " + programmed_feed(modes.at("feed"));
  if (modes.contains("rotation") && modes.at("rotation").get<double>() != 0)
    text += fmt::format(", rotation {:.3f}", modes.at("rotation").get<double>());
  return text;
}

std::string offsets_text(const Json& modes) {
  std::string text;
  for (const char* name : {"datum", "shift"}) {
    if (!modes.contains(name)) continue;
    for (const auto& [axis, value] : modes.at(name).items())
      text +=
          fmt::format("{}{} {}{:+.3f}", text.empty() ? "" : ", ", name, axis, value.get<double>());
  }
  return text;
}

std::string move_text(const Json& move) {
  const auto kind = move.at("move").get<std::string>();
  if (kind == "switch_on") return "spindle and coolant on";
  if (kind == "change_tool")
    return fmt::format("change to tool {}", move.at("tool").get<std::int64_t>());
  std::string text = kind + " to";
  for (const auto& [axis, value] : move.at("to").items())
    text += fmt::format(" {}{:.3f}", axis, value.get<double>());
  if (move.contains("feed")) text += " at " + programmed_feed(move.at("feed"));
  return text;
}

std::string left_text(const Json& next) {
  if (!next.at("length_mm").is_number()) return "not known";
  const double length = next.at("length_mm").get<double>();
  if (!next.at("left_mm").is_number()) return fmt::format("{:.3f} mm, all of it again", length);
  return fmt::format("{:.3f} of {:.3f} mm, all of it again", next.at("left_mm").get<double>(),
                     length);
}

void add_proof(Details& details, const Json& report) {
  const Json& proof = report.at("proof");
  const bool has_state = proof.at("state") == "equal", has_path = proof.at("path") == "equal";
  details.add("state proved",
              has_state ? Cell(fmt::format("yes: its digest is the one recorded at block {}, {}",
                                           proof.at("state_block").get<std::uint64_t>(),
                                           short_id(proof.at("state_digest").get<std::string>())),
                               Style::Good)
                        : Cell("there is no recorded state to compare with", Style::Bad));
  details.add("path proved",
              has_path ? Cell("yes: every move from the checkpoint on is the one that was executed",
                              Style::Good)
                       : Cell("it is not recorded for this block"));
}

Details details_of(const Json& report) {
  Details details;
  details.add("restart of", fmt::format("{} of {}", report.at("restart_of").get<std::string>(),
                                        report.at("program").get<std::string>()));
  const auto cut_off_at = report.at("cut_off_at").get<std::uint64_t>();
  const auto on_record = report.value("on_record", cut_off_at);
  details.add("cut off after",
              on_record == cut_off_at
                  ? fmt::format("block {}", cut_off_at)
                  : fmt::format("block {}, as the axes show; on record is block {}", cut_off_at,
                                on_record));
  details.add("continues after", block_text(report.at("after")));
  details.add("checkpoint", fmt::format("block {}", report.at("checkpoint").get<std::uint64_t>()));
  add_proof(details, report);
  details.add("switched on", switched_on_text(report.at("switched_on")));
  details.add("tool", tool_text(report.at("tool")));
  details.add("modes", modes_text(report.at("modes")));
  details.add("offsets", offsets_text(report.at("modes")));
  std::string codes;
  for (const Json& code : report.at("not_repeated"))
    codes += (codes.empty() ? "" : ", ") + code.get<std::string>();
  details.add("not repeated", codes);
  details.add("axes are at", axes_text(report.at("position")));
  details.add("continues at", axes_text(report.at("continues_at")));
  if (report.at("stopped_at").is_object())
    details.add("had stopped at", axes_text(report.at("stopped_at")));
  if (report.value("program_has_ended", false)) {
    details.add("next", "the end of the program: all its blocks were executed, nothing will move");
    return details;
  }
  std::size_t number = 0;
  for (const Json& move : report.at("approach")) {
    ++number;
    details.add(number == 1 ? "approach" : "", fmt::format("{}. {}", number, move_text(move)));
  }
  details.add("next", block_text(report.at("next")));
  details.add("left in it", left_text(report.at("next")));
  return details;
}

}  // namespace

Result<Details> restart_details(const nlohmann::ordered_json& report) {
  try {
    return details_of(report);
  } catch (const nlohmann::json::exception& error) {
    return fail(Errc::Syntax, "the gateway's report of the restart: {}", error.what());
  }
}

}  // namespace dripline::cli
