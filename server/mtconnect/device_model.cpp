#include "server/mtconnect/device_model.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "protocol/base/digest.hpp"
#include "server/mtconnect/xml_text.hpp"

namespace dripline::mtconnect {
namespace {

/// The kinds of components, in the order of a device; each after its parent.
enum class Place : std::uint8_t {
  Device,
  Axes,
  X,
  Y,
  Z,
  A,
  B,
  C,
  U,
  V,
  W,
  Spindle,
  Controller,
  Path,
};
struct PlaceRow {
  Place place, parent;
  std::string_view element, key, name;
};
constexpr std::array kPlaces{
    PlaceRow{Place::Device, Place::Device, "Device", "device", ""},
    PlaceRow{Place::Axes, Place::Device, "Axes", "axes", ""},
    PlaceRow{Place::X, Place::Axes, "Linear", "x", "X"},
    PlaceRow{Place::Y, Place::Axes, "Linear", "y", "Y"},
    PlaceRow{Place::Z, Place::Axes, "Linear", "z", "Z"},
    PlaceRow{Place::A, Place::Axes, "Rotary", "a", "A"},
    PlaceRow{Place::B, Place::Axes, "Rotary", "b", "B"},
    PlaceRow{Place::C, Place::Axes, "Rotary", "c", "C"},
    PlaceRow{Place::U, Place::Axes, "Linear", "u", "U"},
    PlaceRow{Place::V, Place::Axes, "Linear", "v", "V"},
    PlaceRow{Place::W, Place::Axes, "Linear", "w", "W"},
    PlaceRow{Place::Spindle, Place::Axes, "Rotary", "spindle", "S"},
    PlaceRow{Place::Controller, Place::Device, "Controller", "controller", "controller"},
    PlaceRow{Place::Path, Place::Controller, "Path", "path", "path"},
};

/// Which devices have a data item.
enum class Has : std::uint8_t {
  Agent,
  Any,
  Machine,  ///< every machine
  Control,  ///< a machine whose control is observed
  Axis,     ///< one that has the axis
};

struct SlotRow {
  Slot slot;
  Place place;
  Has has;
  Category category;
  std::string_view name, type, sub_type, units;
  bool is_discrete = false;
};
using enum Category;
constexpr std::string_view kMm = "MILLIMETER";
constexpr std::array kItems{
    SlotRow{Slot::Availability, Place::Device, Has::Any, Event, "availability", "AVAILABILITY", "",
            ""},
    SlotRow{Slot::AssetChanged, Place::Device, Has::Machine, Event, "asset-changed",
            "ASSET_CHANGED", "", "", true},
    SlotRow{Slot::AssetRemoved, Place::Device, Has::Machine, Event, "asset-removed",
            "ASSET_REMOVED", "", "", true},
    SlotRow{Slot::DeviceAdded, Place::Device, Has::Agent, Event, "device-added", "DEVICE_ADDED", "",
            "", true},
    SlotRow{Slot::DeviceChanged, Place::Device, Has::Agent, Event, "device-changed",
            "DEVICE_CHANGED", "", "", true},
    SlotRow{Slot::DeviceRemoved, Place::Device, Has::Agent, Event, "device-removed",
            "DEVICE_REMOVED", "", "", true},
    SlotRow{Slot::PositionX, Place::X, Has::Axis, Sample, "position-x", "POSITION", "ACTUAL", kMm},
    SlotRow{Slot::PositionY, Place::Y, Has::Axis, Sample, "position-y", "POSITION", "ACTUAL", kMm},
    SlotRow{Slot::PositionZ, Place::Z, Has::Axis, Sample, "position-z", "POSITION", "ACTUAL", kMm},
    SlotRow{Slot::AngleA, Place::A, Has::Axis, Sample, "angle-a", "ANGLE", "ACTUAL", "DEGREE"},
    SlotRow{Slot::AngleB, Place::B, Has::Axis, Sample, "angle-b", "ANGLE", "ACTUAL", "DEGREE"},
    SlotRow{Slot::AngleC, Place::C, Has::Axis, Sample, "angle-c", "ANGLE", "ACTUAL", "DEGREE"},
    SlotRow{Slot::PositionU, Place::U, Has::Axis, Sample, "position-u", "POSITION", "ACTUAL", kMm},
    SlotRow{Slot::PositionV, Place::V, Has::Axis, Sample, "position-v", "POSITION", "ACTUAL", kMm},
    SlotRow{Slot::PositionW, Place::W, Has::Axis, Sample, "position-w", "POSITION", "ACTUAL", kMm},
    SlotRow{Slot::ContactX, Place::X, Has::Axis, Sample, "contact-x", "POSITION", "PROBE", kMm,
            true},
    SlotRow{Slot::ContactY, Place::Y, Has::Axis, Sample, "contact-y", "POSITION", "PROBE", kMm,
            true},
    SlotRow{Slot::ContactZ, Place::Z, Has::Axis, Sample, "contact-z", "POSITION", "PROBE", kMm,
            true},
    SlotRow{Slot::SpindleSpeed, Place::Spindle, Has::Control, Sample, "spindle-speed",
            "ROTARY_VELOCITY", "ACTUAL", "REVOLUTION/MINUTE"},
    SlotRow{Slot::SpindleOverride, Place::Spindle, Has::Control, Event, "spindle-override",
            "ROTARY_VELOCITY_OVERRIDE", "", "PERCENT"},
    SlotRow{Slot::EmergencyStop, Place::Controller, Has::Control, Event, "emergency-stop",
            "EMERGENCY_STOP", "", ""},
    SlotRow{Slot::System, Place::Controller, Has::Control, Condition, "system", "SYSTEM", "", ""},
    SlotRow{Slot::Execution, Place::Path, Has::Machine, Event, "execution", "EXECUTION", "", ""},
    SlotRow{Slot::Mode, Place::Path, Has::Control, Event, "mode", "CONTROLLER_MODE", "", ""},
    SlotRow{Slot::SingleBlock, Place::Path, Has::Control, Event, "single-block",
            "CONTROLLER_MODE_OVERRIDE", "SINGLE_BLOCK", ""},
    SlotRow{Slot::Program, Place::Path, Has::Machine, Event, "program", "PROGRAM", "", ""},
    SlotRow{Slot::LineNumber, Place::Path, Has::Control, Event, "line-number", "LINE_NUMBER",
            "ABSOLUTE", ""},
    SlotRow{Slot::LineLabel, Place::Path, Has::Control, Event, "line-label", "LINE_LABEL", "", ""},
    SlotRow{Slot::Feed, Place::Path, Has::Control, Sample, "feed", "PATH_FEEDRATE", "ACTUAL",
            "MILLIMETER/SECOND"},
    SlotRow{Slot::FeedOverride, Place::Path, Has::Control, Event, "feed-override",
            "PATH_FEEDRATE_OVERRIDE", "PROGRAMMED", "PERCENT"},
    SlotRow{Slot::RapidOverride, Place::Path, Has::Control, Event, "rapid-override",
            "PATH_FEEDRATE_OVERRIDE", "RAPID", "PERCENT"},
    SlotRow{Slot::ToolNumber, Place::Path, Has::Control, Event, "tool-number", "TOOL_NUMBER", "",
            ""},
    SlotRow{Slot::WorkOffset, Place::Path, Has::Control, Event, "work-offset", "WORK_OFFSET", "",
            ""},
    SlotRow{Slot::Message, Place::Path, Has::Machine, Event, "message", "MESSAGE", "", ""},
    SlotRow{Slot::ProgramMessage, Place::Path, Has::Machine, Event, "program-message", "MESSAGE",
            "", "", true},
    SlotRow{Slot::Output, Place::Path, Has::Machine, Event, "output", "MESSAGE", "", "", true},
    SlotRow{Slot::Contact, Place::Path, Has::Control, Sample, "contact", "PATH_POSITION", "PROBE",
            "MILLIMETER_3D", true},
    SlotRow{Slot::MotionProgram, Place::Path, Has::Control, Condition, "motion-program",
            "MOTION_PROGRAM", "", ""},
};
static_assert(kItems.size() == kSlots);

bool has_item(const Device& device, const SlotRow& row) {
  switch (row.has) {
    case Has::Agent:
      return device.is_agent();
    case Has::Any:
      return true;
    case Has::Machine:
      return !device.is_agent();
    case Has::Control:
      return device.axes != 0;
    case Has::Axis: {
      const Slot first = row.slot < Slot::ContactX ? Slot::PositionX : Slot::ContactX;
      const auto axis = static_cast<unsigned>(row.slot) - static_cast<unsigned>(first);
      return (device.axes & 1U << axis) != 0;
    }
  }
  return false;
}

/// PATH_FEEDRATE: PathFeedrate
std::string element_name(std::string_view type) {
  std::string name;
  bool is_first = true;
  for (const char c : type) {
    if (c == '_') {
      is_first = true;
      continue;
    }
    name += is_first || c < 'A' || c > 'Z' ? c : static_cast<char>(c - 'A' + 'a');
    is_first = false;
  }
  return name;
}

std::shared_ptr<const DataItem> make_item(const Device& device, const SlotRow& row,
                                          std::uint32_t component) {
  auto item = std::make_shared<DataItem>();
  item->device = device.index;
  item->component = component;
  item->slot = row.slot;
  item->category = row.category;
  item->id = fmt::format("{}.{}", row.name, device.name);
  item->name = row.name;
  item->type = row.type;
  item->sub_type = row.sub_type;
  item->units = row.units;
  item->is_discrete = row.is_discrete;
  item->element = element_name(row.type);
  append_attribute(item->attributes, "dataItemId", item->id);
  append_attribute(item->attributes, "name", item->name);
  if (!row.sub_type.empty()) append_attribute(item->attributes, "subType", row.sub_type);
  if (row.category == Condition) append_attribute(item->attributes, "type", row.type);
  if (row.slot == Slot::AssetChanged || row.slot == Slot::AssetRemoved)
    append_attribute(item->attributes, "assetType", "CuttingTool");
  return item;
}

/// The component of a place, with those above it.
std::uint32_t component_of(Device& device, Place place) {
  const PlaceRow& row = kPlaces[static_cast<std::size_t>(place)];
  const std::string id = fmt::format("{}.{}", row.key, device.name);
  const auto found = std::ranges::find(device.components, id, &Component::id);
  if (found != device.components.end())
    return static_cast<std::uint32_t>(found - device.components.begin());
  Component component;
  component.element = place == Place::Device && device.is_agent() ? "Agent" : row.element;
  component.id = id;
  component.name = row.name;
  if (place != Place::Device) component.parent = component_of(device, row.parent);
  device.components.push_back(std::move(component));
  return static_cast<std::uint32_t>(device.components.size() - 1);
}

/// Adds what `device` has by its axes and has not got yet; returns the new items.
std::vector<std::uint32_t> fill(Device& device, Model& model) {
  std::vector<std::uint32_t> added;
  for (const SlotRow& row : kItems) {
    std::uint32_t& place = device.items[static_cast<std::size_t>(row.slot)];
    if (place != Device::kNone || !has_item(device, row)) continue;
    const std::uint32_t component = component_of(device, row.place);
    auto item = std::make_shared<DataItem>(*make_item(device, row, component));
    item->index = static_cast<std::uint32_t>(model.items.size());
    place = item->index;
    added.push_back(place);
    model.items.push_back(std::move(item));
    auto& items = device.components[component].data_items;
    items.push_back(place);
    std::ranges::stable_sort(
        items, {}, [&model](std::uint32_t index) { return model.items[index]->category; });
  }
  return added;
}

constexpr const char* kAgentName = "Agent";  // no machine has a capital letter in its name

}  // namespace

const Device* Model::find(std::string_view name) const {
  const auto found = std::ranges::find_if(
      devices, [name](const auto& device) { return device->name == name || device->uuid == name; });
  return found == devices.end() ? nullptr : found->get();
}

DeviceModel::DeviceModel(std::string plant, UtcTime now) : plant_(std::move(plant)) {
  auto model = std::make_shared<Model>();
  model->revision = 1;
  model->changed = now;
  auto agent = std::make_shared<Device>();
  agent->name = kAgentName;
  agent->uuid = uuid_of(kAgentName);
  agent->revision = 1;
  agent->items.fill(Device::kNone);
  fill(*agent, *model);
  model->devices.push_back(std::move(agent));
  model_ = std::move(model);
}

std::shared_ptr<const Model> DeviceModel::snapshot() const {
  const std::lock_guard lock(mutex_);
  return model_;
}

/// In the form of RFC 9562, version 8: the same at every start.
std::string DeviceModel::uuid_of(std::string_view name) const {
  Sha256 sha;
  sha.update(plant_);
  sha.update("/");
  sha.update(name);
  const std::string hex = sha.digest().hex();
  return fmt::format("{}-{}-8{}-a{}-{}", hex.substr(0, 8), hex.substr(8, 4), hex.substr(12, 3),
                     hex.substr(15, 3), hex.substr(18, 12));
}

DeviceModel::Known DeviceModel::know(const DeviceFacts& facts, UtcTime now) {
  const std::lock_guard lock(mutex_);
  const auto found = std::ranges::find_if(
      model_->devices, [&](const auto& device) { return device->name == facts.name; });
  const bool is_new = found == model_->devices.end();
  const std::string description = facts.description.empty()
                                      ? facts.control
                                      : fmt::format("{}: {}", facts.control, facts.description);
  if (!is_new && ((*found)->axes | facts.axes) == (*found)->axes &&
      (facts.control.empty() || (*found)->description == description)) {
    return {*found, Change::None, {}};
  }
  auto model = std::make_shared<Model>(*model_);
  ++model->revision;
  model->changed = now;
  auto device = is_new ? std::make_shared<Device>() : std::make_shared<Device>(**found);
  if (is_new) {
    device->index = static_cast<std::uint32_t>(model->devices.size());
    device->name = facts.name;
    device->uuid = uuid_of(facts.name);
    device->items.fill(Device::kNone);
    model->devices.push_back(nullptr);
  }
  device->revision = model->revision;
  if (is_new || !facts.control.empty()) device->description = description;
  device->axes = static_cast<std::uint16_t>(device->axes | facts.axes);
  Known known{nullptr, is_new ? Change::Added : Change::Extended, fill(*device, *model)};
  model->devices[device->index] = device;
  known.device = std::move(device);
  model_ = std::move(model);
  return known;
}

}  // namespace dripline::mtconnect
