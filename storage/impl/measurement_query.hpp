#pragma once

#include <optional>
#include <string>
#include <vector>

#include "storage/measurement_store.hpp"
#include "storage/sql/database.hpp"

/// Reading measurements. Every query follows an index of `measurement` for each machine or part,
/// takes `limit` keys of each, and reads the rows of those that come first among all.
namespace dripline::storage {

struct MeasurementOrder {
  std::optional<MeasurementPlace> from;  ///< excluded
  bool is_newest_first = false;
};

Result<std::vector<measurement::Measurement>> query_measurements(sql::Database& database,
                                                                 const MeasurementFilter& filter,
                                                                 const MeasurementOrder& order,
                                                                 std::uint64_t limit);
Result<std::vector<MeasuredPart>> query_parts(sql::Database& database, const PartFilter& filter,
                                              Page page);
Result<std::optional<MeasuredPart>> query_part(sql::Database& database, std::uint64_t id);
Result<std::vector<ReportFinding>> query_findings(sql::Database& database, const PartFilter& filter,
                                                  Page page);
Result<std::vector<ReportFinding>> query_findings_of(sql::Database& database, std::uint64_t part);
Result<std::vector<std::string>> query_characteristics(sql::Database& database,
                                                       const std::optional<std::string>& machine);

}  // namespace dripline::storage
