#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "clients/tools/report_template/report_template.hpp"
#include "storage/report_template_store.hpp"

namespace dripline::measurements {

/// A version of a stored template, read.
struct UsedTemplate {
  std::string name;
  std::uint64_t version = 0;
  std::shared_ptr<const report_template::ReportTemplate> content;
  /// Assigned to a printing macro alone: lines it does not know are of no concern, unless a part of
  /// it is open.
  bool is_of_macro = false;
};

/// The templates that apply to records. Any thread.
class TemplateCache {
 public:
  explicit TemplateCache(storage::ReportTemplateStore& store) : store_(store) {}

  /// In the order in which they are asked: of the program, of the machine, of macros; each in the
  /// order of names. One whose text cannot be read (by this version) is left out and logged.
  Result<std::vector<UsedTemplate>> templates_of(const std::string& machine,
                                                 const std::string& program);
  /// Errors: NotFound, and those of read_template.
  Result<UsedTemplate> find(const std::string& name, std::optional<std::uint64_t> version);
  /// Whether anything is assigned at all.
  Result<bool> has_assignments();
  /// After templates or assignments were changed.
  void drop();

 private:
  Result<void> load();  ///< hold the mutex

  storage::ReportTemplateStore& store_;
  std::mutex mutex_;
  bool is_loaded_ = false;
  std::vector<storage::TemplateAssignment> assignments_;
  std::map<std::pair<std::string, std::uint64_t>, UsedTemplate> read_;  ///< versions never change
  std::map<std::string, std::uint64_t> newest_;
};

}  // namespace dripline::measurements
