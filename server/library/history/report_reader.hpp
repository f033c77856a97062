#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "storage/record_store.hpp"

namespace dripline::library {

enum class ReportFormat { Text, Csv, Json };
/// Errors: Unsupported, naming the known ones.
Result<ReportFormat> parse_report_format(std::string_view text);

/// The output lines of one run, or what a machine printed outside any, rendered piece by piece so
/// that a report of any length needs constant memory and time in proportion to its length. One
/// thread at a time; the store must outlive it.
class ReportReader {
 public:
  ReportReader(storage::RecordStore& store, storage::Run run, ReportFormat format);
  ReportReader(storage::RecordStore& store, const std::string& machine, ReportFormat format);
  /// The next piece; nullopt after the last one.
  Result<std::optional<std::string>> next();

 private:
  Result<std::vector<storage::Record>> records() const;
  std::string head() const;
  std::string tail() const;
  void append_line(const storage::Record& record, std::string& text);

  storage::RecordStore& store_;
  storage::Run run_;  ///< without an id: of the machine alone
  ReportFormat format_;
  std::uint64_t lines_ = 0;
  storage::RecordPlace place_;  ///< of the last line
  enum class Stage { Head, Lines, Done } stage_ = Stage::Head;
};

}  // namespace dripline::library
