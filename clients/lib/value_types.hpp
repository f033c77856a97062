#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace dripline::client {

/// A variable, an offset or a table entry of a control, under the control's own name.
struct ControlValue {
  std::string name;
  std::optional<double> value = {};  ///< absent: vacant
};

/// An output that a program has switched.
struct ControlOutput {
  std::string axis;
  std::int64_t output = 0;
  bool on = false;
};

/// An analog output that a program has set.
struct ControlAnalogOutput {
  std::int64_t output = 0;
  double value = 0;
};

/// An input that the machine reports.
struct ControlInput {
  std::string name;
  bool on = false;
};

/// What a machine's control holds now, as executed blocks have left it.
struct ControlValues {
  std::string machine;
  std::vector<ControlValue> values;
  std::optional<std::uint64_t> next = {};  ///< how many to pass over for the rest
  std::vector<ControlOutput> outputs;
  std::vector<ControlAnalogOutput> analog = {};  ///< none from an older gateway
  std::vector<std::int64_t> codes;  ///< M functions handed to the machine, the last one first
  std::vector<std::string> functions =
      {};                                 ///< the same with their words; none from an older gateway
  std::vector<ControlInput> inputs = {};  ///< none from an older gateway
};

}  // namespace dripline::client
