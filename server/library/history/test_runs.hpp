#pragma once

#include "storage/store.hpp"

namespace dripline::library {

/// Whether nothing of a run that has ended was executed, because it was a test run: its state or
/// what its gateway says of its end. False also where that is not known (it was cut off).
bool is_test_run(const storage::Run& run);

}  // namespace dripline::library
