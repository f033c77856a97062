#include "server/mtconnect/observer.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "protocol/dds/record_text.hpp"
#include "server/mtconnect/xml_text.hpp"

namespace dripline::mtconnect {
namespace {

constexpr std::size_t kMaxFaults = ObservationBuffer::kMaxActive;
constexpr double kPercent = 100;
constexpr double kSecondsPerMinute = 60;

/// The values of a status that a data item has none for.
using Value = std::optional<std::string>;

/// Collects the observations of one device at one time.
class Writer {
 public:
  Writer(const Device& device, UtcTime time, std::vector<NewObservation>& batch)
      : device_(device), time_(time), batch_(batch) {}

  void value(Slot slot, Value value, bool is_discrete = false) {
    const std::uint32_t item = device_.item(slot);
    if (item == Device::kNone) return;
    batch_.push_back({item, time_, std::move(value), std::nullopt, is_discrete});
  }
  void condition(Slot slot, ConditionState state) {
    const std::uint32_t item = device_.item(slot);
    if (item == Device::kNone) return;
    batch_.push_back({item, time_, std::nullopt, std::move(state)});
  }

 private:
  const Device& device_;
  UtcTime time_;
  std::vector<NewObservation>& batch_;
};

constexpr std::array kConditions{Slot::System, Slot::MotionProgram};

Slot slot_of_axis(std::size_t axis) {
  return static_cast<Slot>(static_cast<std::size_t>(Slot::PositionX) + axis);
}

/// What a status means for a data item. Equal values are compared before texts are made of them.
struct ValueRow {
  Slot slot;
  bool (*is_same)(const dds::Status&, const dds::Status&);
  Value (*value)(const dds::Status&);
};

Value percent(double factor) {
  return number_text(factor * kPercent);
}
std::optional<std::int32_t> tool_of(const dds::Status& status) {
  return status.modes ? status.modes->tool : std::nullopt;
}
std::string_view work_offset_of(const dds::Status& status) {
  return status.modes ? std::string_view(status.modes->work_system) : std::string_view();
}

using S = const dds::Status&;
constexpr std::array kValues{
    ValueRow{Slot::Execution, [](S a, S b) { return a.execution == b.execution; },
             [](S s) { return Value(dds::to_string(s.execution)); }},
    ValueRow{Slot::Mode, [](S a, S b) { return a.mode == b.mode; },
             [](S s) { return Value(dds::to_string(s.mode)); }},
    ValueRow{Slot::SingleBlock, [](S a, S b) { return a.single_block == b.single_block; },
             [](S s) { return Value(s.single_block ? "ON" : "OFF"); }},
    ValueRow{Slot::Program, [](S a, S b) { return a.program == b.program; },
             [](S s) { return Value(s.program); }},
    ValueRow{Slot::LineNumber, [](S a, S b) { return a.line == b.line; },
             [](S s) { return s.line == 0 ? Value() : Value(std::to_string(s.line)); }},
    ValueRow{
        Slot::LineLabel, [](S a, S b) { return a.sequence == b.sequence; },
        [](S s) { return s.sequence < 0 ? Value("") : Value("N" + std::to_string(s.sequence)); }},
    ValueRow{Slot::Feed, [](S a, S b) { return a.feed_mm_per_min == b.feed_mm_per_min; },
             [](S s) { return Value(number_text(s.feed_mm_per_min / kSecondsPerMinute)); }},
    ValueRow{Slot::FeedOverride, [](S a, S b) { return a.feed_override == b.feed_override; },
             [](S s) { return percent(s.feed_override); }},
    ValueRow{Slot::RapidOverride, [](S a, S b) { return a.rapid_override == b.rapid_override; },
             [](S s) { return percent(s.rapid_override); }},
    ValueRow{Slot::SpindleSpeed, [](S a, S b) { return a.spindle_rpm == b.spindle_rpm; },
             [](S s) { return Value(number_text(s.spindle_rpm)); }},
    ValueRow{Slot::SpindleOverride,
             [](S a, S b) { return a.spindle_override == b.spindle_override; },
             [](S s) { return percent(s.spindle_override); }},
    ValueRow{Slot::ToolNumber, [](S a, S b) { return tool_of(a) == tool_of(b); },
             [](S s) {
               const auto tool = tool_of(s);
               return tool ? Value(std::to_string(*tool)) : Value();
             }},
    ValueRow{Slot::WorkOffset, [](S a, S b) { return work_offset_of(a) == work_offset_of(b); },
             [](S s) { return Value(work_offset_of(s)); }},
    ValueRow{Slot::EmergencyStop, [](S a, S b) { return a.emergency_stop == b.emergency_stop; },
             [](S s) { return Value(s.emergency_stop ? "TRIGGERED" : "ARMED"); }},
    ValueRow{Slot::Message, [](S a, S b) { return a.message == b.message; },
             [](S s) { return Value(s.message); }},
};

/// `before` nullptr: all values.
void write_status(Writer& writer, const dds::Status& now, const dds::Status* before) {
  for (const auto& row : kValues) {
    if (before != nullptr && row.is_same(now, *before)) continue;
    writer.value(row.slot, row.value(now));
  }
  for (std::size_t axis = 0; axis < now.position.size(); ++axis) {
    if (before != nullptr && now.position[axis] == before->position[axis]) continue;
    writer.value(slot_of_axis(axis), number_text(now.position[axis]));
  }
}

/// A contact names the axes that the probe moved. "x y z" only when it names all that the machine
/// has of them; where it has none, that is 0.
void write_contact(Writer& writer, const dds::ProbeText& probe, std::uint16_t axes) {
  std::string text;
  bool is_whole = true;
  for (unsigned i = 0; i < 3; ++i) {
    const auto found = probe.at.find(static_cast<char>('X' + i));
    const bool is_there = found != probe.at.end();
    is_whole = is_whole && (is_there || (axes & 1U << i) == 0);
    const std::string number = number_text(is_there ? found->second : 0);
    if (is_there) {
      writer.value(static_cast<Slot>(static_cast<unsigned>(Slot::ContactX) + i), number, true);
    }
    text += (i > 0 ? " " : "") + number;
  }
  if (is_whole) writer.value(Slot::Contact, std::move(text), true);
}

std::optional<ConditionState> state_of(const storage::Record& record) {
  const auto alarm = dds::decode_alarm(record.text);
  if (!alarm) return std::nullopt;
  ConditionState state;
  state.level = record.kind == "alarm" ? Level::Fault : Level::Warning;
  state.native_code = alarm->code;
  state.text = alarm->text;
  state.time = record.time;
  return state;
}

ConditionState normal() {
  ConditionState state;
  state.level = Level::Normal;
  return state;
}

}  // namespace

Slot condition_of(std::string_view code) {
  constexpr std::array<std::string_view, 2> kSystem{"GRB", "LCN"};
  const bool is_system = std::ranges::any_of(
      kSystem, [code](std::string_view prefix) { return code.starts_with(prefix); });
  return is_system ? Slot::System : Slot::MotionProgram;
}

Observer::Observer(Parts parts) : parts_(std::move(parts)) {
  const auto model = parts_.model.snapshot();
  const Device& agent = *model->devices.front();
  Batch batch;
  Writer writer(agent, parts_.clock.now(), batch);
  writer.value(Slot::Availability, "AVAILABLE");
  writer.value(Slot::DeviceAdded, std::nullopt);
  writer.value(Slot::DeviceChanged, std::nullopt);
  writer.value(Slot::DeviceRemoved, std::nullopt);
  parts_.buffer.add(batch);
}

Observer::Seen& Observer::know(const DeviceFacts& facts, Batch& batch) {
  const auto [place, is_new] = seen_.try_emplace(facts.name);
  Seen& seen = place->second;
  if (!is_new && seen.facts == facts) return seen;
  seen.facts = facts;
  const UtcTime now = parts_.clock.now();
  auto known = parts_.model.know(facts, now);
  seen.device = known.device;
  const auto model = parts_.model.snapshot();
  for (const std::uint32_t item : known.new_items) {
    NewObservation none{item, now, std::nullopt, std::nullopt};
    if (model->items[item]->category == Category::Condition) none.condition.emplace();
    batch.push_back(std::move(none));
  }
  if (known.change != DeviceModel::Change::None) {
    Writer agent(*model->devices.front(), now, batch);
    agent.value(
        known.change == DeviceModel::Change::Added ? Slot::DeviceAdded : Slot::DeviceChanged,
        known.device->uuid, true);
    seen.status.reset();  // the new data items have no values yet
  }
  if (is_new && parts_.last_alarms) {
    for (const auto& record : parts_.last_alarms(facts.name)) {
      if (auto state = state_of(record))
        seen.faults.push_back({condition_of(state->native_code), *std::move(state)});
      if (seen.faults.size() == kMaxFaults) break;
    }
  }
  return seen;
}

void Observer::observe(const machines::MachineView& view) {
  const std::lock_guard lock(mutex_);
  Batch batch;
  observe_locked(view, batch);
  parts_.buffer.add(batch);
}

void Observer::observe_locked(const machines::MachineView& view, Batch& batch) {
  DeviceFacts facts{.name = view.machine.name,
                    .control = view.machine.control,
                    .description = view.machine.description,
                    .axes = 0};
  if (view.is_connected && view.status) facts.axes = view.status->axes;
  Seen& seen = know(facts, batch);
  if (!view.is_heard()) {
    if (seen.is_available) lose(seen, batch);
    return;
  }
  const UtcTime now = parts_.clock.now();
  if (!std::exchange(seen.is_available, true)) {
    Writer writer(*seen.device, now, batch);
    writer.value(Slot::Availability, "AVAILABLE");
  }
  // The status from before the machine was lost is shown until the gateway sends another one.
  if (!view.status || view.status->time == seen.stale) return;
  const dds::Status& status = *view.status;
  if (!seen.status) observe_conditions(seen, status.time, batch);
  Writer writer(*seen.device, status.time, batch);
  write_status(writer, status, seen.status ? &*seen.status : nullptr);
  seen.status = view.status;
}

void Observer::observe_conditions(const Seen& seen, UtcTime time, Batch& batch) const {
  Writer writer(*seen.device, time, batch);
  for (const Slot slot : kConditions) {
    if (std::ranges::find(seen.faults, slot, &Fault::slot) == seen.faults.end())
      writer.condition(slot, normal());
  }
  for (const Fault& fault : seen.faults) {
    Writer at(*seen.device, fault.state.time, batch);
    at.condition(fault.slot, fault.state);
  }
}

void Observer::lose(Seen& seen, Batch& batch) const {
  const UtcTime now = parts_.clock.now();
  const auto model = parts_.model.snapshot();
  for (const std::uint32_t item : seen.device->items) {
    if (item == Device::kNone) continue;
    const DataItem& lost = *model->items[item];
    // The server itself reports those.
    if (lost.slot == Slot::AssetChanged || lost.slot == Slot::AssetRemoved) continue;
    NewObservation none{item, now, std::nullopt, std::nullopt};
    if (lost.category == Category::Condition) none.condition.emplace();
    batch.push_back(std::move(none));
  }
  seen.is_available = false;
  if (seen.status) seen.stale = seen.status->time;
  seen.status.reset();
}

void Observer::observe(const storage::Record& record) {
  const std::lock_guard lock(mutex_);
  Batch batch;
  const auto found = seen_.find(record.machine);
  Seen& seen = found != seen_.end()
                   ? found->second
                   : know({.name = record.machine, .control = {}, .description = {}}, batch);
  observe_record(seen, record, batch);
  parts_.buffer.add(batch);
}

void Observer::observe_record(Seen& seen, const storage::Record& record, Batch& batch) const {
  Writer writer(*seen.device, record.time, batch);
  if (record.kind == "output") {
    writer.value(Slot::Output, record.text, true);
  } else if ((record.kind == "message" || record.kind == "stop") && record.device.empty()) {
    writer.value(Slot::ProgramMessage, record.text, true);
  } else if (record.kind == "probe") {
    const auto probe = dds::decode_probe(record.text);
    if (probe && probe->tripped) write_contact(writer, *probe, seen.device->axes);
  } else if (record.kind == "run_started") {
    seen.faults.clear();
    for (const Slot slot : kConditions) writer.condition(slot, normal());
  } else if (record.kind == "alarm" || record.kind == "warning") {
    auto state = state_of(record);
    if (!state) return;
    const Slot slot = condition_of(state->native_code);
    std::erase_if(seen.faults, [&](const Fault& fault) {
      return fault.slot == slot && fault.state.native_code == state->native_code;
    });
    if (seen.faults.size() == kMaxFaults) seen.faults.erase(seen.faults.begin());
    seen.faults.push_back({slot, *state});
    writer.condition(slot, *std::move(state));
  }
}

void Observer::reconcile(const std::vector<machines::MachineView>& views) {
  const std::lock_guard lock(mutex_);
  Batch batch;
  std::set<std::string_view> there;
  for (const auto& view : views) {
    there.insert(view.machine.name);
    // One that is observed already may have changed since `views` was made.
    if (!seen_.contains(view.machine.name)) observe_locked(view, batch);
  }
  for (auto& [name, seen] : seen_) {
    if (seen.is_available && !there.contains(name)) lose(seen, batch);
  }
  parts_.buffer.add(batch);
}

void Observer::observe_asset(const std::string& machine, const std::string& asset,
                             bool is_removed) {
  const std::lock_guard lock(mutex_);
  Batch batch;
  const auto found = seen_.find(machine);
  const Seen& seen = found != seen_.end()
                         ? found->second
                         : know({.name = machine, .control = {}, .description = {}}, batch);
  Writer writer(*seen.device, parts_.clock.now(), batch);
  writer.value(is_removed ? Slot::AssetRemoved : Slot::AssetChanged, asset, true);
  parts_.buffer.add(batch);
}

}  // namespace dripline::mtconnect
