#include "server/mtconnect/cutting_tools.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "gateway/interpreter/core/setup.hpp"
#include "gateway/interpreter/registry.hpp"
#include "server/mtconnect/xml_text.hpp"

namespace dripline::mtconnect {
namespace {

using interpreter::Axis;
using interpreter::ToolRecord;

/// `name`: the element; `code`: that of ISO 13399.
void append_measurement(std::string& xml, std::string_view name, std::string_view code,
                        double millimeters) {
  xml += fmt::format("<{0} code=\"{1}\" units=\"MILLIMETER\">{2}</{0}>", name, code,
                     number_text(millimeters));
}

double length_of(const ToolRecord& tool, Axis axis) {
  const double length = tool.length.has(axis) ? tool.length.raw(axis) : 0;
  return length + (tool.wear.has(axis) ? tool.wear.raw(axis) : 0);
}

/// What belongs to the whole tool.
std::string assembly_measurements(const ToolRecord& tool, bool is_lathe) {
  std::string xml;
  const double diameter = 2 * (tool.radius.mm() + tool.radius_wear.mm());
  if (!is_lathe && diameter > 0) append_measurement(xml, "CuttingDiameterMax", "DC", diameter);
  if (tool.length.has(Axis::Z))
    append_measurement(xml, "FunctionalLength", "LF", length_of(tool, Axis::Z));
  return xml;
}

/// What belongs to the edge of a lathe's tool.
std::string edge_measurements(const ToolRecord& tool) {
  std::string xml;
  const double radius = tool.radius.mm() + tool.radius_wear.mm();
  if (radius > 0) append_measurement(xml, "CornerRadius", "RE", radius);
  if (tool.length.has(Axis::X))
    append_measurement(xml, "FunctionalWidth", "WF", length_of(tool, Axis::X));
  return xml;
}

std::string content_of(const ToolRecord& tool, bool is_lathe) {
  std::string xml = "<CuttingToolLifeCycle><CutterStatus><Status>UNKNOWN</Status></CutterStatus>";
  xml += fmt::format("<ProgramToolNumber>{}</ProgramToolNumber>", tool.number);
  if (tool.pocket) xml += fmt::format("<Location type=\"POT\">{}</Location>", *tool.pocket);
  const std::string assembly = assembly_measurements(tool, is_lathe);
  if (!assembly.empty()) xml += "<Measurements>" + assembly + "</Measurements>";
  const std::string edge = is_lathe ? edge_measurements(tool) : std::string();
  if (!edge.empty()) {
    xml += fmt::format(
        "<CuttingItems count=\"1\"><CuttingItem indices=\"1\"><Measurements>{}</Measurements>"
        "</CuttingItem></CuttingItems>",
        edge);
  }
  xml += "</CuttingToolLifeCycle>";
  return xml;
}

}  // namespace

Result<std::vector<CuttingTool>> read_tools(const std::string& machine, std::string_view control,
                                            std::string_view toml) {
  const auto dialect = interpreter::find_dialect(control);
  if (!dialect) return fail(dialect.error());
  const auto setup = interpreter::parse_control_data(toml, (*dialect)->units);
  if (!setup) return fail(setup.error());
  std::vector<ToolRecord> records = setup->tools;
  std::ranges::stable_sort(records, {}, &ToolRecord::number);
  const bool is_lathe = (*dialect)->machine == interpreter::MachineKind::Lathe;
  std::vector<CuttingTool> tools;
  for (const auto& record : records) {
    const std::string tool = fmt::format("T{}", record.number);
    tools.push_back({fmt::format("{}.{}", machine, tool), tool, content_of(record, is_lathe)});
  }
  return tools;
}

std::string Assets::element(const Asset& asset) {
  std::string xml = "<CuttingTool";
  append_attribute(xml, "assetId", asset.tool.id);
  append_attribute(xml, "deviceUuid", asset.device_uuid);
  append_attribute(xml, "serialNumber", asset.tool.id);
  append_attribute(xml, "toolId", asset.tool.tool);
  xml += " timestamp=\"";
  append_time(xml, asset.time);
  xml += '"';
  if (asset.is_removed) append_attribute(xml, "removed", "true");
  xml += '>';
  xml += asset.tool.content;
  xml += "</CuttingTool>";
  return xml;
}

Assets::Changes Assets::replace(const Setup& setup) {
  const std::lock_guard lock(mutex_);
  Changes changes;
  std::uint64_t& number = numbers_[setup.machine];
  if (setup.number <= number) return changes;
  number = setup.number;
  const auto touch = [&](Asset& asset, bool is_removed) {
    by_order_.erase(asset.order);
    if (asset.order != 0 && asset.is_removed) --removed_;
    if (is_removed) ++removed_;
    asset.is_removed = is_removed;
    asset.time = setup.time;
    asset.order = ++changes_;
    by_order_.emplace(asset.order, asset.tool.id);
    (is_removed ? changes.removed : changes.changed).push_back(asset.tool.id);
  };
  const std::string prefix = setup.machine + ".";
  for (auto at = assets_.lower_bound(prefix); at != assets_.end() && at->first.starts_with(prefix);
       ++at) {
    const bool is_there =
        std::ranges::find(setup.tools, at->first, &CuttingTool::id) != setup.tools.end();
    if (!is_there && !at->second.is_removed) touch(at->second, true);
  }
  for (const auto& tool : setup.tools) {
    const auto found = assets_.find(tool.id);
    if (found == assets_.end() && assets_.size() >= kMaxAssets) continue;
    Asset& asset = assets_[tool.id];
    const bool is_same =
        asset.order != 0 && !asset.is_removed && asset.tool.content == tool.content;
    if (is_same) continue;
    asset.tool = tool;
    asset.device_uuid = setup.device_uuid;
    touch(asset, false);
  }
  return changes;
}

std::vector<std::string> Assets::list(const Filter& filter) const {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> elements;
  for (auto at = by_order_.rbegin(); at != by_order_.rend(); ++at) {
    if (elements.size() == filter.count) break;
    const Asset& asset = assets_.find(at->second)->second;
    if (asset.is_removed && !filter.with_removed) continue;
    if (!filter.device_uuid.empty() && filter.device_uuid != asset.device_uuid) continue;
    elements.push_back(element(asset));
  }
  return elements;
}

std::optional<std::string> Assets::find(const std::string& id) const {
  const std::lock_guard lock(mutex_);
  const auto found = assets_.find(id);
  return found == assets_.end() ? std::nullopt : std::optional(element(found->second));
}

std::size_t Assets::size() const {
  const std::lock_guard lock(mutex_);
  return assets_.size() - removed_;
}

}  // namespace dripline::mtconnect
