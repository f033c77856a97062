#pragma once

#include <string>

#include "storage/measurement_store.hpp"

namespace dripline::measurements {

/// Why a part has a verdict that holds something, for the people at the machine: the first value
/// that has it, with its limit, or what was found wrong with its report. "part 12, serial S7, is
/// scrap: D40 is 40.30 mm, 0.25 above the upper limit 40.05; 2 more values are scrap". Of a
/// store that refuses, the verdict alone.
std::string hold_reason(storage::MeasurementStore& stored, const storage::MeasuredPart& part);

}  // namespace dripline::measurements
