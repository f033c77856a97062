#include "server/api/measurement_reading.hpp"

#include <algorithm>

#include "server/api/api.hpp"

namespace dripline::api {
namespace {

/// Points that a picture can show.
constexpr std::uint64_t kMaxLast = 10'000;
constexpr std::uint64_t kUsualLast = 1'000;

storage::MeasurementPlace place_of(const measurement::Measurement& last) {
  return {last.time, last.id};
}

}  // namespace

Response without_measurements() {
  return error_response({Errc::Unsupported, "this server has no measurements"});
}

Result<std::optional<measurement::Verdict>> read_verdict(QueryReader& query) {
  const auto text = query.text("verdict");
  if (!text) return std::optional<measurement::Verdict>();
  const auto verdict = measurement::parse_verdict(*text);
  if (!verdict) return fail(verdict.error());
  return std::optional(*verdict);
}

Result<storage::MeasurementFilter> read_measurement_filter(QueryReader& query) {
  storage::MeasurementFilter filter;
  filter.machine = query.text("machine");
  filter.run = query.text("run");
  filter.characteristic = query.text("characteristic");
  filter.part_id = query.number("part", kMaxNumber);
  filter.since = query.time("since");
  filter.until = query.time("until");
  const auto verdict = read_verdict(query);
  if (!verdict) return fail(verdict.error());
  filter.verdict = *verdict;
  filter.with_superseded = query.flag("superseded");
  return filter;
}

Result<CharacteristicChoice> read_characteristic_choice(QueryReader& query) {
  CharacteristicChoice choice;
  choice.filter.machine = query.text("machine");
  choice.filter.run = query.text("run");
  choice.filter.characteristic = query.text("characteristic");
  if (!choice.filter.characteristic) {
    return fail(Errc::Syntax, "query parameter 'characteristic' is missing: it is of one");
  }
  choice.filter.since = query.time("since");
  choice.filter.until = query.time("until");
  choice.last = query.number("last", kMaxLast).value_or(kUsualLast);
  if (choice.last == 0)
    return fail(Errc::LimitExceeded, "query parameter 'last' is 0: 1 to {}", kMaxLast);
  return choice;
}

Result<std::vector<measurement::Measurement>> newest_measurements(
    storage::MeasurementStore& store, const CharacteristicChoice& choice) {
  std::vector<measurement::Measurement> all;
  std::optional<storage::MeasurementPlace> before;
  while (all.size() < choice.last) {
    const std::uint64_t wanted = std::min<std::uint64_t>(kMaxLimit, choice.last - all.size());
    const auto rows = store.list_newest(choice.filter, before, wanted);
    if (!rows) return fail(rows.error());
    all.insert(all.end(), rows->begin(), rows->end());
    if (rows->size() < wanted) break;
    before = place_of(rows->back());
  }
  if (all.empty()) {
    return fail(Errc::NotFound, "nothing was measured of characteristic {}",
                *choice.filter.characteristic);
  }
  std::ranges::reverse(all);
  return all;
}

Result<std::vector<measurement::Measurement>> all_measurements(
    storage::MeasurementStore& store, const storage::MeasurementFilter& filter,
    std::uint64_t limit) {
  std::vector<measurement::Measurement> all;
  std::optional<storage::MeasurementPlace> after;
  for (;;) {
    auto rows = store.list(filter, after, kMaxLimit);
    if (!rows) return fail(rows.error());
    if (all.size() + rows->size() > limit) {
      return fail(Errc::LimitExceeded,
                  "over {} measurements: choose fewer, by machine, characteristic or time", limit);
    }
    const bool is_last = rows->size() < kMaxLimit;
    if (!rows->empty()) after = place_of(rows->back());
    std::ranges::move(*rows, std::back_inserter(all));
    if (is_last) return all;
  }
}

}  // namespace dripline::api
