// The only user of protozero.
#include "server/mqtt/sparkplug_payload.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <protozero/pbf_message.hpp>
#include <protozero/pbf_writer.hpp>

namespace dripline::mqtt {
namespace {

using Json = nlohmann::json;

// Field numbers of sparkplug_b.proto.
namespace payload_field {
constexpr protozero::pbf_tag_type kTimestamp = 1, kMetrics = 2, kSeq = 3;
}
namespace metric_field {
constexpr protozero::pbf_tag_type kName = 1, kTimestamp = 3, kDataType = 4, kIsNull = 7, kLong = 11,
                                  kDouble = 13, kBoolean = 14, kString = 15;
}

/// Of the enumeration DataType.
constexpr std::uint32_t data_type(Metric::Type type) {
  constexpr std::uint32_t kUInt64 = 8, kOfDouble = 10, kOfBoolean = 11, kOfString = 12;
  switch (type) {
    case Metric::Type::Unsigned:
      return kUInt64;
    case Metric::Type::Double:
      return kOfDouble;
    case Metric::Type::Boolean:
      return kOfBoolean;
    case Metric::Type::Text:
      break;
  }
  return kOfString;
}

std::uint64_t milliseconds_of(UtcTime time) {
  return static_cast<std::uint64_t>(
      std::chrono::duration_cast<std::chrono::milliseconds>(time.time_since_epoch()).count());
}

struct ValueWriter {
  protozero::pbf_writer& out;
  void operator()(std::uint64_t value) const { out.add_uint64(metric_field::kLong, value); }
  void operator()(double value) const { out.add_double(metric_field::kDouble, value); }
  void operator()(bool value) const { out.add_bool(metric_field::kBoolean, value); }
  void operator()(const std::string& value) const { out.add_string(metric_field::kString, value); }
};

void write(protozero::pbf_writer& out, const Metric& metric, std::uint64_t time) {
  out.add_string(metric_field::kName, metric.name);
  out.add_uint64(metric_field::kTimestamp, time);
  out.add_uint32(metric_field::kDataType, data_type(metric.type));
  if (metric.value)
    std::visit(ValueWriter{out}, *metric.value);
  else
    out.add_bool(metric_field::kIsNull, true);
}

/// Strings of protocol buffers are UTF-8; what a machine sent may be something else.
std::string valid_text(const std::string& text) {
  const std::string quoted = Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
  return Json::parse(quoted).get<std::string>();
}

void add(const std::string& name, const Json& value, std::vector<Metric>& metrics) {
  if (value.is_object() || value.is_array()) {
    std::size_t index = 0;
    for (const auto& [key, member] : value.items()) {
      const std::string part = value.is_array() ? std::to_string(index++) : key;
      add(name.empty() ? part : name + "/" + part, member, metrics);
    }
  } else if (value.is_boolean()) {
    metrics.push_back({name, Metric::Type::Boolean, value.get<bool>()});
  } else if (value.is_number()) {
    metrics.push_back({name, Metric::Type::Double, value.get<double>()});
  } else if (value.is_string()) {
    metrics.push_back({name, Metric::Type::Text, valid_text(value.get_ref<const std::string&>())});
  }
}

bool is_rebirth(protozero::pbf_reader metric) {
  std::string name;
  bool is_wanted = false;
  while (metric.next()) {
    if (metric.tag() == metric_field::kName &&
        metric.wire_type() == protozero::pbf_wire_type::length_delimited)
      name = metric.get_string();
    else if (metric.tag() == metric_field::kBoolean &&
             metric.wire_type() == protozero::pbf_wire_type::varint)
      is_wanted = metric.get_bool();
    else
      metric.skip();
  }
  return name == kRebirth && is_wanted;
}

}  // namespace

std::string encode(const Payload& payload) {
  std::string bytes;
  protozero::pbf_writer out(bytes);
  const std::uint64_t time = milliseconds_of(payload.time);
  out.add_uint64(payload_field::kTimestamp, time);
  for (const Metric& metric : payload.metrics) {
    protozero::pbf_writer part(out, payload_field::kMetrics);
    write(part, metric, time);
  }
  if (payload.seq) out.add_uint64(payload_field::kSeq, *payload.seq);
  return bytes;
}

std::vector<Metric> metrics_of(const Json& document) {
  std::vector<Metric> metrics;
  add("", document, metrics);
  return metrics;
}

bool asks_rebirth(std::string_view payload) {
  try {
    protozero::pbf_reader in(payload.data(), payload.size());
    while (in.next()) {
      const bool is_metric = in.tag() == payload_field::kMetrics &&
                             in.wire_type() == protozero::pbf_wire_type::length_delimited;
      if (!is_metric)
        in.skip();
      else if (is_rebirth(in.get_message()))
        return true;
    }
  } catch (const protozero::exception&) {  // no payload
  }
  return false;
}

Result<void> check_sparkplug_id(std::string_view id) {
  const bool is_good = !id.empty() && std::ranges::all_of(id, [](char c) {
    return (c < 0 || c >= ' ') && std::string_view("/+#\x7f").find(c) == std::string_view::npos;
  });
  if (is_good) return {};
  return fail(Errc::Syntax, "'{}' must be a name without /, + and #", id);
}

}  // namespace dripline::mqtt
