#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "gateway/interpreter/core/setup.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/control_version.hpp"

/// What the control's memory holds besides programs, as the texts it sends and takes: the central
/// tool store (program 0) and the machine parameters.
namespace dripline::interpreter::tnc155 {

inline constexpr int kMaxStoredTools = 99;
inline constexpr int kLastMachineParameter = 236;

/// BEGIN PGM 0, a line a tool (T, pocket P, an S before it for a special tool, L, R), END PGM 0.
/// Errors: LimitExceeded (more than 99 tools, a number that is not 1 to 99).
Result<std::string> write_tool_store(const std::vector<ToolRecord>& tools, Units units,
                                     char decimal_sign = ',');
/// Errors: Syntax, LimitExceeded; with the line. Unsupported: the version has no tool store.
Result<std::vector<ToolRecord>> read_tool_store(std::string_view text,
                                                const ControlVersion& version = {});

/// MP number and value.
using MachineParameters = std::map<int, double>;
/// "MP0: 0", a line each, in order.
std::string write_machine_parameters(const MachineParameters& parameters);
/// Errors: Syntax, LimitExceeded, Unsupported (one that the version has not); with the line.
Result<MachineParameters> read_machine_parameters(std::string_view text,
                                                  const ControlVersion& version = {});
/// Of a setup: the table `machine_parameters` among the control's options, MP71 = 515 ... They are
/// kept for the control; what a program can feel of them has options of its own. Errors: Syntax,
/// LimitExceeded, Unsupported (one that the version has not, which `model` and `software` say);
/// naming the key.
Result<MachineParameters> machine_parameters_of(const Options& options);

}  // namespace dripline::interpreter::tnc155
