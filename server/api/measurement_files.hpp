#pragma once

#include <string>

#include "server/api/response.hpp"
#include "storage/measurement_store.hpp"

namespace dripline::api {

/// More are for `dnc report export`, which keeps them on disk.
inline constexpr std::uint64_t kMaxInFile = 50'000;

/// Measurements as a file for others (clients/tools/measurement_files): dfq, dfd and dfx (Q-DAS),
/// qif, html (a page for each part), points, dxf and stl (digitized points; `x`: what their X is,
/// radius or diameter). Such a file is made as a whole: most of them name at their head what
/// follows. Errors: Unsupported (the format), Syntax (`x`), LimitExceeded (over kMaxInFile),
/// NotFound (no measurement is a point), those of the writers.
Response file_response(storage::MeasurementStore& store, const storage::MeasurementFilter& filter,
                       const std::string& format, const std::string& x);

}  // namespace dripline::api
