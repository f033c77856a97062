#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/base/clock.hpp"
#include "protocol/base/result.hpp"
#include "storage/actor.hpp"

namespace dripline::storage {

/// One version of a template; it never changes. The store does not read its text.
struct ReportTemplateVersion {
  std::string name;
  std::uint64_t version = 0;
  std::string text;
  std::string author;
  UtcTime created{};
};

enum class TemplateScope : std::uint8_t {
  Program,  ///< the runs of a program
  Machine,  ///< what a machine reports, also outside runs
  Macro,    ///< what a printing macro prints, on any machine
};
std::string_view to_string(TemplateScope scope);
/// Errors: Syntax.
Result<TemplateScope> parse_template_scope(std::string_view text);

struct TemplateAssignment {
  TemplateScope scope = TemplateScope::Program;
  std::string subject;                        ///< name of the program, machine or macro
  std::string name;                           ///< of the template
  std::optional<std::uint64_t> version = {};  ///< absent: the newest
  std::string author = {};
  UtcTime created = {};
};

/// Promises of every store: storage/store.hpp. Audit entries are part of the transactions.
class ReportTemplateStore {
 public:
  virtual ~ReportTemplateStore() = default;

  /// The next version; the newest again when its text is the same. A removed template comes back.
  /// Errors: Syntax, LimitExceeded (its name, as of a machine).
  virtual Result<ReportTemplateVersion> push(const ReportTemplateVersion& version,
                                             const Actor& who) = 0;
  /// The newest version of each, without those removed; in order of their names.
  virtual Result<std::vector<ReportTemplateVersion>> list() = 0;
  /// Newest first; of a removed one too.
  virtual Result<std::vector<ReportTemplateVersion>> versions(const std::string& name) = 0;
  /// Errors: NotFound. Without a version: the newest of one that is not removed.
  virtual Result<ReportTemplateVersion> find(const std::string& name,
                                             std::optional<std::uint64_t> version) = 0;
  /// It is not listed and assigned to nothing any more; its versions stay for their measurements.
  /// Errors: NotFound.
  virtual Result<void> remove(const std::string& name, const Actor& who, UtcTime time) = 0;

  /// Applies to records that are not derived yet. What machines reported while no template was
  /// assigned to anything is passed over. Errors: NotFound (template, version).
  virtual Result<void> assign(const TemplateAssignment& assignment, const Actor& who) = 0;
  /// Errors: NotFound.
  virtual Result<void> unassign(const TemplateAssignment& assignment, const Actor& who) = 0;
  virtual Result<std::vector<TemplateAssignment>> assignments() = 0;
};

}  // namespace dripline::storage
