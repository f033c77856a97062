#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "server/library/audit_trail.hpp"
#include "server/library/control_catalog.hpp"
#include "storage/setup_store.hpp"

namespace dripline::library {

struct SetupText {
  std::string machine;
  std::string control;  ///< of the machine; its dialect reads the text before it is kept
  std::string text;     ///< TOML
  std::string comment;
  std::optional<std::uint64_t> base = {};  ///< made from this one, which must still be the newest
};
struct SavedSetup {
  storage::SetupRevision setup;
  bool is_unchanged = false;  ///< the newest had this text already
};

/// What the controls of machines know before a program starts: tool tables, offsets, parameters.
/// Kept in versions; the newest goes with every start. Any thread.
class Setups {
 public:
  Setups(storage::SetupStore& store, const ControlCatalog& catalog, AuditTrail& audit)
      : store_(store), catalog_(catalog), audit_(audit) {}

  /// Errors: Syntax, Unsupported, LimitExceeded (what the control would not take, with key and
  /// line; the comment; the size), Conflict (`base` is not the newest any more).
  Result<SavedSetup> save(const SetupText& text, const storage::Actor& who);
  /// The same, kept by `keep` (in a transaction with something else). `base` is for `keep` to
  /// compare, and so is the audit entry. Errors: as save; those of `keep`.
  using Keep = std::function<Result<storage::SetupRevision>(const storage::SetupRevision&)>;
  Result<storage::SetupRevision> save_by(const SetupText& text, const storage::Actor& who,
                                         const Keep& keep);
  /// Called after a new revision was kept, by who saved it. All are added before any save.
  void on_saved(
      std::function<void(const storage::SetupRevision&, const std::string& control)> notify) {
    on_saved_.push_back(std::move(notify));
  }
  /// Newest first, without their texts.
  Result<std::vector<storage::SetupRevision>> list(const std::string& machine,
                                                   storage::Page page) const {
    return store_.list(machine, page);
  }
  /// The newest, or the one with that number. Errors: NotFound.
  Result<storage::SetupRevision> find(const std::string& machine,
                                      std::optional<std::uint64_t> number) const {
    return store_.find(machine, number);
  }
  /// Which one is in a control that gets none with a start. Promises and errors: SetupStore.
  Result<storage::LoadedSetup> note_loaded(const std::string& machine,
                                           std::optional<std::uint64_t> number,
                                           const storage::Actor& who);
  Result<std::optional<storage::LoadedSetup>> loaded(const std::string& machine) const {
    return store_.loaded(machine);
  }

  static constexpr std::size_t kMaxComment = 1024;

 private:
  Result<void> check(const SetupText& text) const;
  void announce(const storage::SetupRevision& saved, const SetupText& text) const;

  storage::SetupStore& store_;
  const ControlCatalog& catalog_;
  AuditTrail& audit_;
  std::vector<std::function<void(const storage::SetupRevision&, const std::string& control)>>
      on_saved_;
};

}  // namespace dripline::library
