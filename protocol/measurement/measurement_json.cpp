#include "protocol/measurement/measurement_json.hpp"

#include <nlohmann/json.hpp>

namespace dripline::measurement {
namespace {

using nlohmann::json;

json text_or_null(const std::string& text) {
  return text.empty() ? json(nullptr) : json(text);
}

json value_or_null(const std::optional<double>& value) {
  return value ? json(*value) : json(nullptr);
}

}  // namespace

json to_json(const Measurement& one) {
  const auto& characteristic = one.characteristic;
  return {{"id", one.id},
          {"machine", one.machine},
          {"run", text_or_null(one.run)},
          {"program", text_or_null(one.program)},
          {"revision", one.revision == 0 ? json(nullptr) : json(one.revision)},
          {"block", one.block},
          {"line", one.line},
          {"part", one.part_id},
          {"part_number", text_or_null(one.part)},
          {"serial", text_or_null(one.serial)},
          {"tool", text_or_null(one.tool)},
          {"characteristic", characteristic.name},
          {"nominal", value_or_null(characteristic.nominal)},
          {"lower", value_or_null(characteristic.lower)},
          {"upper", value_or_null(characteristic.upper)},
          {"unit", characteristic.unit},
          {"decimals", characteristic.decimals},
          {"actual", one.actual},
          {"deviation", value_or_null(deviation(one))},
          {"time", to_iso8601(one.time)},
          {"epoch", one.record.epoch},
          {"number", one.record.number},
          {"item", one.item},
          {"verdict", to_string(one.verdict)}};
}

}  // namespace dripline::measurement
