#pragma once

#include <cstdint>
#include <vector>

#include "server/api/request.hpp"
#include "server/api/response.hpp"
#include "storage/measurement_store.hpp"

/// Which measurements a request is about, and their rows. Any thread.
namespace dripline::api {

/// The answer of a server without measurements.
Response without_measurements();

/// machine, run, characteristic, part, since, until, verdict, superseded. Errors: Syntax.
Result<storage::MeasurementFilter> read_measurement_filter(QueryReader& query);
/// Errors: Syntax.
Result<std::optional<measurement::Verdict>> read_verdict(QueryReader& query);

/// The newest values of one characteristic, as charts and studies take them.
struct CharacteristicChoice {
  storage::MeasurementFilter filter;
  std::uint64_t last = 0;
};
/// machine, run, characteristic, since, until, last (1000, at most 10,000). Errors: Syntax (no
/// characteristic), LimitExceeded. What is wrong with single values is an error of finish().
Result<CharacteristicChoice> read_characteristic_choice(QueryReader& query);
/// Oldest first, never none. Errors: NotFound (nothing was measured of it), those of the store.
Result<std::vector<measurement::Measurement>> newest_measurements(
    storage::MeasurementStore& store, const CharacteristicChoice& choice);

/// In the order of an export. Errors: LimitExceeded (over `limit`), those of the store.
Result<std::vector<measurement::Measurement>> all_measurements(
    storage::MeasurementStore& store, const storage::MeasurementFilter& filter,
    std::uint64_t limit);

}  // namespace dripline::api
