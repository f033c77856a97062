#pragma once

#include "storage/store.hpp"

namespace dripline::library {

/// Whether nothing of a run is executed, because it is a test run: it was ordered as one, or its
/// state or what its gateway says of its end says so.
bool is_test_run(const storage::Run& run);

}  // namespace dripline::library
