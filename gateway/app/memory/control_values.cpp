#include "gateway/app/memory/control_values.hpp"

#include <fmt/core.h>
#include <cmath>
#include <nlohmann/json.hpp>

#include "protocol/dds/message.hpp"

namespace dripline::gateway {
namespace {

using nlohmann::json;

/// Bytes of values in one answer: the rest of it fits beside them.
constexpr std::size_t kMaxValues = dds::kMaxCommandSetup - 12 * 1024;
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

json analog_json(const std::map<int, double>& analog) {
  json outputs = json::array();
  for (const auto& [output, value] : analog) {
    if (outputs.size() == kMaxOutputs) break;
    outputs.push_back({{"output", output}, {"value", value}});
  }
  return outputs;
}

/// `M102 P2 Q3.5`
std::string text_of(const ExecutionRecorder::Function& function) {
  std::string text = fmt::format("M{}", function.code);
  if (function.e) text += fmt::format(" E{:.6g}", *function.e);
  if (function.p) text += fmt::format(" P{:.6g}", *function.p);
  if (function.q) text += fmt::format(" Q{:.6g}", *function.q);
  return text;
}

json codes_json(const ExecutionRecorder& recorder) {
  json codes = json::array();
  for (const auto& function : recorder.functions()) codes.push_back(function.code);
  return codes;
}
json functions_json(const ExecutionRecorder& recorder) {
  json functions = json::array();
  for (const auto& function : recorder.functions()) functions.push_back(text_of(function));
  return functions;
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
              {"analog", analog_json(recorder.analog())},
              {"codes", codes_json(recorder)},
              {"functions", functions_json(recorder)},
              {"inputs", inputs_json(machine)}}
      .dump();
}

}  // namespace dripline::gateway
