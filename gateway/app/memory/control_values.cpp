#include "gateway/app/memory/control_values.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "protocol/dds/message.hpp"

namespace dripline::gateway {
namespace {

using nlohmann::json;

/// Bytes of values in one answer: the rest of it fits beside them.
constexpr std::size_t kMaxValues = dds::kMaxCommandSetup - 8 * 1024;
constexpr std::size_t kMaxOutputs = 64, kMaxInputs = 64;

json outputs_json(const ExecutionRecorder::Outputs& switched) {
  json outputs = json::array();
  for (const auto& [pin, is_on] : switched) {
    if (outputs.size() == kMaxOutputs) break;
    outputs.push_back({{"axis", std::string(1, interpreter::letter(pin.first))},
                       {"output", pin.second},
                       {"on", is_on}});
  }
  return outputs;
}

json inputs_json(const machine::MotionBackend& machine) {
  json inputs = json::array();
  for (const auto& [name, is_on] : machine.inputs()) {
    if (inputs.size() == kMaxInputs) break;
    inputs.push_back({{"name", name}, {"on", is_on}});
  }
  return inputs;
}

}  // namespace

std::string control_values(const ValueQuery& query, const ControlMemory& memory,
                           const ExecutionRecorder& recorder,
                           const machine::MotionBackend& machine) {
  json values = json::array();
  json next = nullptr;
  std::size_t matching = 0, bytes = 0;
  for (const ControlMemory::Value& value : memory.values()) {
    if (!value.name.starts_with(query.beginning) || matching++ < query.passed_over) continue;
    json one{{"name", value.name},
             {"value", std::isfinite(value.value) ? json(value.value) : json(nullptr)}};
    bytes += one.dump().size() + 1;
    if (bytes > kMaxValues) {
      next = matching - 1;
      break;
    }
    values.push_back(std::move(one));
  }
  return json{{"values", std::move(values)},
              {"next", std::move(next)},
              {"outputs", outputs_json(recorder.switched())},
              {"codes", recorder.codes()},
              {"inputs", inputs_json(machine)}}
      .dump();
}

}  // namespace dripline::gateway
