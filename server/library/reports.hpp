#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "storage/store.hpp"

namespace dripline::library {

enum class ReportFormat { Text, Csv, Json };
/// Errors: Unsupported, naming the known ones.
Result<ReportFormat> parse_report_format(std::string_view text);

/// The output lines of one run, rendered piece by piece so that a report of any length needs
/// constant memory. One thread at a time; the store must outlive it.
class ReportReader {
 public:
  ReportReader(storage::Store& store, storage::Run run, ReportFormat format);
  /// The next piece; nullopt after the last one.
  Result<std::optional<std::string>> next();

 private:
  std::string head() const;
  std::string tail() const;
  void append_line(const storage::Record& record, std::string& text);

  storage::Store& store_;
  storage::Run run_;
  ReportFormat format_;
  std::uint64_t lines_ = 0;
  enum class Stage { Head, Lines, Done } stage_ = Stage::Head;
};

}  // namespace dripline::library
