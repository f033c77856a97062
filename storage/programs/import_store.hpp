#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/base/clock.hpp"
#include "protocol/base/result.hpp"
#include "storage/actor.hpp"
#include "storage/page.hpp"
#include "storage/programs/program_store.hpp"

namespace dripline::storage {

enum class ImportState : std::uint8_t {
  Pending,
  Accepted,
  AcceptedAs,  ///< as a revision of another program
  Rejected,
};
std::string_view to_string(ImportState state);
/// Errors: Syntax.
Result<ImportState> parse_import_state(std::string_view text);

/// What the revision changes, as it was determined when it came.
struct ImportClass {
  std::optional<std::uint64_t> base;  ///< revision it was compared with; absent: there was none
  std::string edit;                   ///< class of the edit; empty: not known
  std::string fault;                  ///< why not, or why a person has to look at it
  UtcTime time;
};

/// A revision that a machine sent, and what became of it.
struct Import {
  Revision revision;
  std::string machine;  ///< that sent it
  ImportState state = ImportState::Pending;
  std::optional<ImportClass> compared;  ///< absent: not yet
  std::optional<UtcTime> decided;       ///< absent: pending
  std::string who, reason;
  bool is_at_once = false;  ///< accepted by the policy
  std::string target;       ///< AcceptedAs: the program, by its name then
  std::uint64_t target_revision = 0;
};

/// Accepts, accepts as another program, or rejects.
struct ImportDecision {
  std::string program;
  std::uint64_t revision = 0;
  ImportState state = ImportState::Accepted;
  std::string target = {};  ///< AcceptedAs
  Actor who;
  UtcTime time = {};
  std::string reason = {};
  /// By the policy, for what was found: only while the revision it was compared with is still the
  /// newest in force. Kept as its class. Absent: by a person.
  std::optional<ImportClass> at_once = {};
};

/// The queue of what machines sent. A row comes to be with its revision (UploadStore::commit).
/// Promises of every store: storage/store.hpp.
class ImportStore {
 public:
  virtual ~ImportStore() = default;

  /// Pending: oldest first, removed programs left out. Decided: the latest decision first.
  virtual Result<std::vector<Import>> list(bool is_pending, Page page) = 0;
  virtual Result<std::uint64_t> count_pending() = 0;
  /// Errors: NotFound.
  virtual Result<Import> find(const std::string& program, std::uint64_t revision) = 0;
  /// Pending ones whose class was not determined yet, oldest first.
  virtual Result<std::vector<Import>> uncompared(std::uint64_t limit) = 0;
  /// Errors: NotFound (it is pending no more).
  virtual Result<void> set_class(const std::string& program, std::uint64_t revision,
                                 const ImportClass& found) = 0;
  /// The audit entry (program.accept, program.accept_as, program.reject) is part of the
  /// transaction. Returns the revision that is in force now; of a rejected one, that one. Errors:
  /// NotFound, Conflict (decided already; another is the newest by now), Syntax and LimitExceeded
  /// (the target's name).
  virtual Result<Revision> decide(const ImportDecision& decision) = 0;
};

}  // namespace dripline::storage
