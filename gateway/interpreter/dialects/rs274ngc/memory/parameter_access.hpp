#pragma once

#include <optional>
#include <string_view>

#include "gateway/interpreter/dialects/rs274ngc/run.hpp"

/// Reading and setting parameters by number and by name, those that show the state included
/// (NIST 3.2.1; LinuxCNC: named parameters).
namespace dripline::interpreter::rs274ngc {

/// `index` is whole, but may be any number.
bool read_parameter(Run& run, double index, std::uint32_t column, double& value);
/// Inline for those of the control's memory, which are nearly all that programs read.
inline bool read_parameter(Run& run, int index, std::uint32_t column, double& value) {
  if (index >= 1 && index < kFirstReadOnly) [[likely]] {
    value = run.parameters[static_cast<std::size_t>(index)];
    return true;
  }
  return read_parameter(run, static_cast<double>(index), column, value);
}
/// Whether the program may set it.
bool check_settable(Run& run, double index, std::uint32_t column);

bool read_named(Run& run, std::string_view name, std::uint32_t column, double& value);
/// False: a HAL pin is asked for first.
bool is_defined(Run& run, std::string_view name, bool& is_there);
/// The number under which a name can be set; alarms on those that only show the state.
bool name_to_set(Run& run, std::string_view name, std::uint32_t column, NameId& id);

/// A HAL pin as the setup lists it, else as the machine answers. nullopt: the machine is asked
/// first.
std::optional<SignalValue> ask_signal(Run& run, std::string_view hal);

/// For the texts of comments: the value after a #, without alarms.
std::optional<double> parameter_for_text(Run& run, int index);
std::optional<double> named_for_text(Run& run, std::string_view name);

}  // namespace dripline::interpreter::rs274ngc
