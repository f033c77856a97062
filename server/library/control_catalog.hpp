#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "gateway/interpreter/core/dialect.hpp"
#include "protocol/base/result.hpp"
#include "storage/machine_store.hpp"
#include "storage/programs/program_store.hpp"

namespace dripline::library {

/// The known controls, and the one that a text is for. Implementations are safe on any thread.
class ControlCatalog {
 public:
  virtual ~ControlCatalog() = default;
  virtual std::vector<std::string> names() const = 0;
  /// The candidates for a program that begins with `head`, likeliest first; one when the text
  /// leaves no doubt.
  virtual std::vector<std::string> detect(std::string_view head,
                                          std::string_view program) const = 0;
  /// Whether the control accepts this as its tools, offsets and parameters. Errors: Syntax,
  /// Unsupported, LimitExceeded, with key and line.
  virtual Result<void> check_setup(std::string_view control, std::string_view toml) const = 0;
  /// Whether a program that begins with `head` is marked against erasure and change.
  virtual bool is_protected(std::string_view /*control*/, std::string_view /*head*/) const {
    return false;
  }
};

/// Errors: Unsupported, naming the known controls.
Result<void> check_control(const ControlCatalog& catalog, std::string_view control);
/// Errors: Unsupported (the revision is for another control than the machine is).
Result<void> check_fits(const storage::Revision& revision, const storage::Machine& machine);
/// The one control the text is for. Errors: Unsupported (none or several fit), asking for one.
Result<std::string> detect_control(const ControlCatalog& catalog, std::string_view head,
                                   std::string_view program);

/// The controls whose dialects are built into this program.
class DialectCatalog final : public ControlCatalog {
 public:
  std::vector<std::string> names() const override;
  std::vector<std::string> detect(std::string_view head, std::string_view program) const override;
  Result<void> check_setup(std::string_view control, std::string_view toml) const override;
  bool is_protected(std::string_view control, std::string_view head) const override;
};

/// Where a run can begin on a control that looks through its program up to there.
struct StartSearch {
  std::vector<std::string_view>
      at;                   ///< block, line, byte, tool, count; empty: only at the beginning
  bool has_memory = false;  ///< with which memory it looks through can be chosen
  bool has_pass = false;    ///< which pass of a block can be named
};
/// As the control's dialect accepts it; of an unknown control nothing. Any thread.
const StartSearch& start_search_of(std::string_view control);

using interpreter::Refusal;

/// The control's own words: "error 300: program already exists"; empty: it has no number for this
/// refusal, or numbers none. Pure.
std::string control_words(std::string_view control, Refusal refusal);

/// The error with the control's words after it, for an operator who knows those:
/// "... exists already (centurion error 300: program already exists)".
Error with_control_words(Error error, std::string_view control, Refusal refusal);

}  // namespace dripline::library
