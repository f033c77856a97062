#include "gateway/interpreter/dialects/tnc155/memory/changer.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <charconv>

namespace dripline::interpreter::tnc155 {
namespace {

constexpr int kSpindle = 0;

ToolPocket* find(std::vector<ToolPocket>& tools, int number) {
  const auto at = std::ranges::find(tools, number, &ToolPocket::tool);
  return at == tools.end() ? nullptr : &*at;
}

/// How many pockets on either side the tool takes besides its own.
int reach_of(const ToolPocket& tool) {
  return tool.is_special ? 1 : 0;
}

/// Whether the tool takes the pocket, with what lies beside a special one.
bool takes(const ToolPocket& tool, int pocket) {
  if (!tool.pocket || *tool.pocket == kSpindle) return false;
  return std::abs(*tool.pocket - pocket) <= reach_of(tool);
}

std::optional<int> lowest_free_pocket(const std::vector<ToolPocket>& tools, int pockets) {
  for (int pocket = 1; pocket <= pockets; ++pocket) {
    const auto takes_it = [&](const ToolPocket& tool) { return takes(tool, pocket); };
    if (std::ranges::none_of(tools, takes_it)) return pocket;
  }
  return std::nullopt;
}

/// No other tool has this pocket.
Result<void> check_place(const ToolPocket& tool, const std::vector<ToolPocket>& others,
                         int pockets) {
  const int pocket = *tool.pocket;
  if (pocket > pockets) {
    return fail(Errc::Syntax, "tool {}: pocket {} is not 1 to magazine_pockets, {}", tool.tool,
                pocket, pockets);
  }
  if (pocket == kSpindle && tool.is_special) {
    return fail(Errc::Syntax,
                "tool {}: a special tool keeps its pocket, and pocket 0 is the spindle", tool.tool);
  }
  for (const ToolPocket& other : others) {
    if (!other.pocket) continue;
    const bool is_one_place = *other.pocket == pocket;
    const bool is_in_magazine = pocket != kSpindle && *other.pocket != kSpindle;
    const int reach = reach_of(tool) + reach_of(other);
    const bool overlaps = is_in_magazine && std::abs(*other.pocket - pocket) <= reach;
    if (!is_one_place && !overlaps) continue;
    if (is_one_place) {
      return fail(Errc::Syntax, "tool {}: {} has tool {} already", tool.tool,
                  pocket == kSpindle ? "the spindle (pocket 0)" : fmt::format("pocket {}", pocket),
                  other.tool);
    }
    return fail(Errc::Syntax,
                "tool {}: pocket {} is beside pocket {} of tool {}: a special tool "
                "takes three",
                tool.tool, pocket, *other.pocket, other.tool);
  }
  return {};
}

void report(Run& run, const ToolPocket& tool) {
  const std::string text = pocket_text(tool);
  run.events().on_output({run.origin, OutputDevice::Screen, text});
}

}  // namespace

Result<std::vector<ToolPocket>> load_pockets(const Setup& setup, const ControlOptions& options) {
  std::vector<ToolPocket> tools;
  if (!options.random_changer) return tools;
  if (!options.central_tool_file) {
    return fail(Errc::Syntax,
                "option random_changer: pockets are those of the tool store: "
                "central_tool_file is false");
  }
  if (options.magazine_pockets < 1) {
    return fail(Errc::Syntax, "option magazine_pockets: {}; with random_changer it is 1 to 9999",
                options.magazine_pockets);
  }
  for (const ToolRecord& record : setup.tools) {
    const ToolPocket tool{static_cast<std::uint8_t>(record.number), record.is_special,
                          record.pocket};
    if (tool.pocket) {
      if (auto good = check_place(tool, tools, options.magazine_pockets); !good) {
        return fail(good.error());
      }
    }
    tools.push_back(tool);
  }
  return tools;
}

bool change_tool(Run& run, int number) {
  auto& tools = run.state.pockets;
  if (number == 0 || tools.empty()) return true;
  ToolPocket* coming = find(tools, number);
  const auto in_spindle = std::ranges::find(tools, std::optional(kSpindle), &ToolPocket::pocket);
  ToolPocket* leaving = in_spindle == tools.end() ? nullptr : &*in_spindle;
  if (coming != nullptr && coming == leaving) return true;
  const bool gives_pocket = coming != nullptr && coming->pocket && !coming->is_special;
  if (leaving != nullptr) {
    const auto pocket =
        gives_pocket ? coming->pocket : lowest_free_pocket(tools, run.options.magazine_pockets);
    if (!pocket) {
      return run.fail(ErrorCode::PocketMissing,
                      fmt::format("tool {} leaves the spindle for tool {}, and all of 1 to {} are "
                                  "taken",
                                  leaving->tool, number, run.options.magazine_pockets));
    }
    leaving->pocket = pocket;
  }
  if (gives_pocket) coming->pocket = kSpindle;
  if (leaving != nullptr) report(run, *leaving);
  if (gives_pocket) report(run, *coming);
  return true;
}

void report_pockets(Run& run) {
  for (const ToolPocket& tool : run.state.pockets) report(run, tool);
}

std::string pocket_text(const ToolPocket& tool) {
  return fmt::format("T{} {}P{}", tool.tool, tool.is_special ? "S" : "",
                     tool.pocket ? std::to_string(*tool.pocket) : "");
}

std::optional<ToolPocket> read_pocket_text(std::string_view text) {
  const auto take = [&](std::string_view mark) {
    if (!text.starts_with(mark)) return false;
    text.remove_prefix(mark.size());
    return true;
  };
  const auto number = [&](auto& value) {
    const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
    text.remove_prefix(static_cast<std::size_t>(read.ptr - text.data()));
    return read.ec == std::errc{};
  };
  ToolPocket tool;
  if (!take("T") || !number(tool.tool) || !take(" ")) return std::nullopt;
  tool.is_special = take("S");
  if (!take("P")) return std::nullopt;
  if (text.empty()) return tool;
  int pocket = 0;
  if (!number(pocket) || !text.empty() || pocket < 0) return std::nullopt;
  tool.pocket = pocket;
  return tool;
}

}  // namespace dripline::interpreter::tnc155
