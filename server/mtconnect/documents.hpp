#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "server/mtconnect/device_model.hpp"
#include "server/mtconnect/observation_buffer.hpp"

/// The four documents of MTConnect 2.4 as XML. Pure; everything that comes from outside is escaped
/// (xml_text.hpp).
namespace dripline::mtconnect {

/// What the headers of all documents have.
struct HeaderFacts {
  std::string sender;
  std::uint64_t instance = 0;
  std::uint64_t buffer_size = 0;
  UtcTime created, model_changed;
  std::uint64_t assets = 0, asset_buffer_size = 0;
};

/// `only` nullptr: all devices.
std::string devices_document(const HeaderFacts& header, const Model& model, const Device* only);

/// One device as a document without namespaces, which paths are evaluated on.
std::string path_document(const Model& model, const Device& device);

/// The body of a Streams document, from <Streams> to its end, so that it can be kept for another
/// header. Every selected item has a value: its latest, or all active states of a condition.
/// `items` nullptr: all.
std::string current_body(const Model& model, const std::vector<ObservationPointer>& latest,
                         const ItemSet* items);
/// The same of these observations, in any order.
std::string sample_body(const Model& model, std::span<const ObservationPointer> observations);

std::string streams_document(const HeaderFacts& header, const ObservationBuffer::Range& range,
                             std::uint64_t next, std::string_view body);

/// `assets`: each a whole element.
std::string assets_document(const HeaderFacts& header, std::span<const std::string> assets);

/// `code`: as the schema has it, OUT_OF_RANGE ...
std::string error_document(const HeaderFacts& header, std::string_view code, std::string_view text);

}  // namespace dripline::mtconnect
