#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/base/clock.hpp"

namespace dripline::mtconnect {

enum class Category : std::uint8_t { Sample, Event, Condition };

/// What a data item is of its device. The rows (type, units, place) are in device_model.cpp.
enum class Slot : std::uint8_t {
  Availability,
  AssetChanged,
  AssetRemoved,
  DeviceAdded,  ///< this and the next two: of the agent
  DeviceChanged,
  DeviceRemoved,
  PositionX,  ///< the nine axes in the order of a status: X Y Z A B C U V W
  PositionY,
  PositionZ,
  AngleA,
  AngleB,
  AngleC,
  PositionU,
  PositionV,
  PositionW,
  ContactX,  ///< where a probe made contact
  ContactY,
  ContactZ,
  SpindleSpeed,
  SpindleOverride,
  EmergencyStop,
  System,
  Execution,
  Mode,
  SingleBlock,
  Program,
  LineNumber,
  LineLabel,
  Feed,
  FeedOverride,
  RapidOverride,
  ToolNumber,
  WorkOffset,
  Message,         ///< what the machine shows now: a prompt, an alarm, what it waits for
  ProgramMessage,  ///< each message and stop of a program
  Output,          ///< each line that a program puts out (DPRNT)
  Contact,         ///< the same, where the contact names all of the machine's X, Y and Z
  MotionProgram,
};
inline constexpr std::size_t kSlots = static_cast<std::size_t>(Slot::MotionProgram) + 1;

/// One thing that can be observed. It never changes and is never removed.
struct DataItem {
  std::uint32_t index = 0;  ///< in Model::items
  std::uint32_t device = 0, component = 0;
  Slot slot = Slot::Availability;
  Category category = Category::Event;
  std::string id, name;
  std::string_view type, sub_type, units;
  bool is_discrete = false;  ///< each observation is significant, also one with the same value
  std::string element;       ///< its name in Streams; of a condition its state is the name
  std::string attributes;    ///< in Streams, without time and sequence; as XML

  /// Groups observations as Streams does: by device, component and category.
  std::uint64_t rank() const {
    return std::uint64_t{device} << 24U | std::uint64_t{component} << 8U |
           static_cast<std::uint64_t>(category);
  }
};

struct Component {
  std::string_view element;  ///< Device, Axes, Linear ...
  std::string id;
  std::string_view name;                  ///< empty: none; of the Device the device's
  std::optional<std::uint32_t> parent;    ///< in Device::components
  std::vector<std::uint32_t> data_items;  ///< in Model::items; samples, events, conditions
};

/// A machine, or the agent itself (index 0).
struct Device {
  static constexpr std::uint32_t kNone = UINT32_MAX;

  std::uint32_t index = 0;
  std::uint64_t revision = 0;  ///< of the model when this was made
  std::string name, uuid;
  std::string description;
  std::uint16_t axes = 0;             ///< bit 0 = X, bit 8 = W; 0: its control is not observed
  std::vector<Component> components;  ///< the first is the device; parents before children
  std::array<std::uint32_t, kSlots> items;  ///< in Model::items; kNone: it has none

  bool is_agent() const { return index == 0; }
  std::uint32_t item(Slot slot) const { return items[static_cast<std::size_t>(slot)]; }
};

/// All devices at one time. Immutable.
struct Model {
  std::uint64_t revision = 0;
  UtcTime changed;
  std::vector<std::shared_ptr<const Device>> devices;  ///< the agent first
  std::vector<std::shared_ptr<const DataItem>> items;

  /// By name or UUID; nullptr: none.
  const Device* find(std::string_view name) const;
};

/// What is known of a machine when its device is made.
struct DeviceFacts {
  std::string name;
  std::string control, description;
  /// bit 0 = X, bit 8 = W. 0: nothing is known of its control (it is at the end of a serial line,
  /// or its gateway has reported nothing yet).
  std::uint16_t axes = 0;
  friend bool operator==(const DeviceFacts&, const DeviceFacts&) = default;
};

/// The devices of the agent. They are added and extended, never removed: a machine that is gone is
/// UNAVAILABLE. Any thread.
class DeviceModel {
 public:
  /// `plant` makes the UUIDs of its machines differ from those of another server's.
  DeviceModel(std::string plant, UtcTime now);

  std::shared_ptr<const Model> snapshot() const;

  enum class Change { None, Added, Extended };
  struct Known {
    std::shared_ptr<const Device> device;
    Change change = Change::None;
    std::vector<std::uint32_t> new_items;  ///< in Model::items
  };
  /// The machine's device, made or extended where the facts ask for more than it has.
  Known know(const DeviceFacts& facts, UtcTime now);

  std::string uuid_of(std::string_view name) const;

 private:
  const std::string plant_;
  mutable std::mutex mutex_;
  std::shared_ptr<const Model> model_;
};

}  // namespace dripline::mtconnect
