#include "server/mtconnect/documents.hpp"

#include <algorithm>

#include "server/mtconnect/xml_text.hpp"

namespace dripline::mtconnect {
namespace {

constexpr std::string_view kVersion = "2.4";
constexpr std::string_view kUnavailable = "UNAVAILABLE";

/// `<MTConnectStreams ...><Header ...`, without the rest of the header.
std::string begin_document(std::string_view kind, const HeaderFacts& header) {
  std::string xml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<MTConnect";
  xml += kind;
  xml +=
      " xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\" xmlns=\"urn:mtconnect.org:"
      "MTConnect";
  xml += kind;
  xml += ":2.4\" xsi:schemaLocation=\"urn:mtconnect.org:MTConnect";
  xml += kind;
  xml += ":2.4 http://schemas.mtconnect.org/schemas/MTConnect";
  xml += kind;
  xml += "_2.4.xsd\"><Header creationTime=\"";
  append_time(xml, header.created);
  xml += '"';
  append_attribute(xml, "sender", header.sender);
  append_attribute(xml, "instanceId", header.instance);
  append_attribute(xml, "version", kVersion);
  return xml;
}

void append_model_time(std::string& xml, const HeaderFacts& header) {
  xml += " deviceModelChangeTime=\"";
  append_time(xml, header.model_changed);
  xml += '"';
}

std::string_view word_of(Category category) {
  switch (category) {
    case Category::Sample:
      return "SAMPLE";
    case Category::Event:
      return "EVENT";
    case Category::Condition:
      return "CONDITION";
  }
  return "EVENT";
}

void append_item(std::string& xml, const DataItem& item) {
  xml += "<DataItem";
  append_attribute(xml, "id", item.id);
  append_attribute(xml, "name", item.name);
  append_attribute(xml, "category", word_of(item.category));
  append_attribute(xml, "type", item.type);
  if (!item.sub_type.empty()) append_attribute(xml, "subType", item.sub_type);
  if (!item.units.empty()) append_attribute(xml, "units", item.units);
  if (item.is_discrete) append_attribute(xml, "discrete", "true");
  xml += "/>";
}

void append_component(std::string& xml, const Model& model, const Device& device,
                      std::uint32_t place) {
  const Component& component = device.components[place];
  xml += '<';
  xml += component.element;
  append_attribute(xml, "id", component.id);
  if (place == 0) {
    append_attribute(xml, "name", device.name);
    append_attribute(xml, "uuid", device.uuid);
    if (device.is_agent()) append_attribute(xml, "mtconnectVersion", kVersion);
  } else if (!component.name.empty()) {
    append_attribute(xml, "name", component.name);
  }
  xml += '>';
  if (place == 0 && !device.description.empty()) {
    xml += "<Description>";
    append_escaped(xml, device.description);
    xml += "</Description>";
  }
  if (!component.data_items.empty()) {
    xml += "<DataItems>";
    for (const std::uint32_t item : component.data_items) append_item(xml, *model.items[item]);
    xml += "</DataItems>";
  }
  bool has_children = false;
  for (std::uint32_t child = place + 1; child < device.components.size(); ++child) {
    if (device.components[child].parent != place) continue;
    if (!std::exchange(has_children, true)) xml += "<Components>";
    append_component(xml, model, device, child);
  }
  if (has_children) xml += "</Components>";
  xml += "</";
  xml += component.element;
  xml += '>';
}

std::string_view element_of(Level level) {
  switch (level) {
    case Level::Normal:
      return "Normal";
    case Level::Warning:
      return "Warning";
    case Level::Fault:
      return "Fault";
    case Level::Unavailable:
      return "Unavailable";
  }
  return "Unavailable";
}

/// Writes observations that come in the order of DataItem::rank.
class StreamsWriter {
 public:
  explicit StreamsWriter(const Model& model) : model_(model) { xml_ = "<Streams>"; }

  void value(const DataItem& item, const Observation& observation) {
    place(item);
    begin(item.element, item, observation.time, observation.sequence);
    xml_ += '>';
    if (observation.value) {
      append_escaped(xml_, *observation.value);
    } else {
      xml_ += kUnavailable;
    }
    end(item.element);
  }

  void condition(const DataItem& item, const ConditionState& state) {
    place(item);
    const std::string_view element = element_of(state.level);
    begin(element, item, state.time, state.sequence);
    if (!state.native_code.empty()) append_attribute(xml_, "nativeCode", state.native_code);
    if (state.level == Level::Warning || state.level == Level::Fault) {
      append_attribute(xml_, "conditionId",
                       state.native_code.empty() ? item.id : state.native_code);
    }
    if (state.text.empty()) {
      xml_ += "/>";
      return;
    }
    xml_ += '>';
    append_escaped(xml_, state.text);
    end(element);
  }

  std::string finish() {
    if (is_open_) {
      end(group_);
      xml_ += "</ComponentStream></DeviceStream>";
    }
    xml_ += "</Streams>";
    return std::move(xml_);
  }

 private:
  void begin(std::string_view element, const DataItem& item, UtcTime time, std::uint64_t sequence) {
    xml_ += '<';
    xml_ += element;
    xml_ += item.attributes;
    xml_ += " timestamp=\"";
    append_time(xml_, time);
    xml_ += '"';
    append_attribute(xml_, "sequence", sequence);
  }
  void end(std::string_view element) {
    xml_ += "</";
    xml_ += element;
    xml_ += '>';
  }

  static std::string_view group_of(Category category) {
    switch (category) {
      case Category::Sample:
        return "Samples";
      case Category::Event:
        return "Events";
      case Category::Condition:
        return "Condition";
    }
    return "Events";
  }

  /// Closes and opens what is around the item.
  void place(const DataItem& item) {
    const bool is_same_device = is_open_ && item.device == device_;
    const bool is_same_component = is_same_device && item.component == component_;
    const std::string_view group = group_of(item.category);
    if (is_same_component && group == group_) return;
    if (is_open_) end(group_);
    if (is_open_ && !is_same_component) xml_ += "</ComponentStream>";
    if (is_open_ && !is_same_device) xml_ += "</DeviceStream>";
    const Device& device = *model_.devices[item.device];
    if (!is_same_device) {
      xml_ += "<DeviceStream";
      append_attribute(xml_, "name", device.name);
      append_attribute(xml_, "uuid", device.uuid);
      xml_ += '>';
    }
    if (!is_same_component) {
      const Component& component = device.components[item.component];
      const std::string_view name =
          item.component == 0 ? std::string_view(device.name) : component.name;
      xml_ += "<ComponentStream";
      append_attribute(xml_, "component", component.element);
      if (!name.empty()) append_attribute(xml_, "name", name);
      append_attribute(xml_, "componentId", component.id);
      xml_ += '>';
    }
    xml_ += '<';
    xml_ += group;
    xml_ += '>';
    is_open_ = true;
    device_ = item.device;
    component_ = item.component;
    group_ = group;
  }

  const Model& model_;
  std::string xml_;
  bool is_open_ = false;
  std::uint32_t device_ = 0, component_ = 0;
  std::string_view group_;
};

}  // namespace

std::string devices_document(const HeaderFacts& header, const Model& model, const Device* only) {
  std::string xml = begin_document("Devices", header);
  append_attribute(xml, "bufferSize", header.buffer_size);
  append_attribute(xml, "assetBufferSize", header.asset_buffer_size);
  append_attribute(xml, "assetCount", header.assets);
  append_model_time(xml, header);
  xml += "/><Devices>";
  for (const auto& device : model.devices) {
    if (only == nullptr || only->index == device->index) append_component(xml, model, *device, 0);
  }
  xml += "</Devices></MTConnectDevices>\n";
  return xml;
}

std::string path_document(const Model& model, const Device& device) {
  std::string xml = "<MTConnectDevices><Devices>";
  append_component(xml, model, device, 0);
  xml += "</Devices></MTConnectDevices>";
  return xml;
}

std::string current_body(const Model& model, const std::vector<ObservationPointer>& latest,
                         const ItemSet* items) {
  StreamsWriter writer(model);
  for (const auto& device : model.devices) {
    for (const auto& component : device->components) {
      for (const std::uint32_t index : component.data_items) {
        if (items != nullptr && !items->has(index)) continue;
        if (index >= latest.size() || !latest[index]) continue;  // it is about to be observed
        const DataItem& item = *model.items[index];
        const Observation& observation = *latest[index];
        if (observation.condition) {
          for (const auto& state : observation.active) writer.condition(item, *state);
        } else {
          writer.value(item, observation);
        }
      }
    }
  }
  return writer.finish();
}

std::string sample_body(const Model& model, std::span<const ObservationPointer> observations) {
  struct Entry {
    std::uint64_t rank;
    const Observation* observation;
  };
  std::vector<Entry> entries;
  entries.reserve(observations.size());
  for (const auto& observation : observations)
    entries.push_back({model.items[observation->item]->rank(), observation.get()});
  std::ranges::stable_sort(entries, {}, &Entry::rank);
  StreamsWriter writer(model);
  for (const auto& [rank, observation] : entries) {
    const DataItem& item = *model.items[observation->item];
    if (observation->condition) {
      writer.condition(item, *observation->condition);
    } else {
      writer.value(item, *observation);
    }
  }
  return writer.finish();
}

std::string streams_document(const HeaderFacts& header, const ObservationBuffer::Range& range,
                             std::uint64_t next, std::string_view body) {
  std::string xml = begin_document("Streams", header);
  append_attribute(xml, "bufferSize", header.buffer_size);
  append_attribute(xml, "nextSequence", next);
  append_attribute(xml, "firstSequence", range.first);
  append_attribute(xml, "lastSequence", std::max(range.first, range.next - 1));
  append_model_time(xml, header);
  constexpr std::size_t kRest = 32;
  xml.reserve(xml.size() + body.size() + kRest);
  xml += "/>";
  xml += body;
  xml += "</MTConnectStreams>\n";
  return xml;
}

std::string assets_document(const HeaderFacts& header, std::span<const std::string> assets) {
  std::string xml = begin_document("Assets", header);
  append_attribute(xml, "assetBufferSize", header.asset_buffer_size);
  append_attribute(xml, "assetCount", header.assets);
  append_model_time(xml, header);
  xml += "/><Assets>";
  for (const auto& asset : assets) xml += asset;
  xml += "</Assets></MTConnectAssets>\n";
  return xml;
}

std::string error_document(const HeaderFacts& header, std::string_view code,
                           std::string_view text) {
  std::string xml = begin_document("Error", header);
  append_attribute(xml, "bufferSize", header.buffer_size);
  xml += "/><Errors><Error";
  append_attribute(xml, "errorCode", code);
  xml += '>';
  append_escaped(xml, text);
  xml += "</Error></Errors></MTConnectError>\n";
  return xml;
}

}  // namespace dripline::mtconnect
