#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/base/clock.hpp"
#include "protocol/base/digest.hpp"
#include "server/library/audit_trail.hpp"
#include "server/library/content_check.hpp"
#include "server/library/control_catalog.hpp"
#include "server/library/program_title.hpp"
#include "storage/store.hpp"

namespace dripline::library {

struct UploadRequest {
  std::string program;
  std::string control;  ///< empty: determined from the text
  std::string comment;
  bool is_held = false;              ///< it came from a machine: the revision waits for acceptance
  storage::FieldChange change = {};  ///< of the program and its new revision
  std::optional<std::uint64_t> folder_file = {};  ///< it came from a hot folder
};

struct Committed {
  storage::Revision revision;
  bool is_unchanged = false;  ///< the latest revision had the same content already
};

/// Errors: Syntax (a control character, bytes that are no UTF-8), LimitExceeded; names the field.
Result<void> check_fields(const storage::FieldChange& change);

/// What to do about a program that is marked against change and erasure (the P of a
/// TNC's BEGIN PGM block).
enum class Protection : std::uint8_t { Respect, Override };

/// The program library: uploads become immutable revisions, which are listed, read, accepted,
/// copied, renamed and removed.
/// Every byte is checked when it arrives; a bad one drops the upload and changes nothing else.
/// Any thread; pieces of one upload are taken one after the other.
class Programs {
 public:
  Programs(const storage::Store& store, const Clock& clock, const ControlCatalog& catalog,
           AuditTrail& audit);

  /// Called after a revision from a machine was stored, on the thread that stored it; must return
  /// soon. Before the first upload.
  void on_held(std::function<void(const storage::Revision&)> listener) {
    on_held_ = std::move(listener);
  }

  /// Errors: Syntax, LimitExceeded (name, comment), Unsupported (control; names the known ones).
  Result<storage::Upload> begin(const UploadRequest& request, const storage::Actor& who);
  /// It belongs to who began it: what another sends would be stored under a wrong author. Errors:
  /// NotFound (also another one's).
  Result<storage::Upload> upload(const std::string& id, const storage::Actor& who);
  /// Errors: those of ContentCheck and detect_control (the upload is dropped then), NotFound,
  /// Conflict (a gap or an overlap).
  Result<storage::Upload> append(const std::string& id, std::uint64_t offset,
                                 std::span<const std::byte> bytes);
  /// Protection does not stop what a machine sent: it waits for acceptance anyway. Errors:
  /// those of append, Syntax (empty), Corrupt (the digest is another one), Conflict (the
  /// newest revision is protected; the upload is dropped).
  Result<Committed> commit(const std::string& id, const std::optional<Digest>& expected,
                           const storage::Actor& who, Protection protection = Protection::Respect);
  Result<void> abandon(const std::string& id);

  Result<std::vector<storage::ProgramSummary>> list(const storage::ProgramFilter& filter,
                                                    storage::Page page) {
    return store_.list(filter, page);
  }
  Result<storage::ProgramFields> fields(const std::string& program) {
    return store_.fields(program);
  }
  /// Errors: those of ProgramStore::describe, Syntax and LimitExceeded (a value).
  Result<void> describe(const storage::Description& description);
  Result<std::uint64_t> count() { return store_.count(); }
  Result<std::vector<storage::Revision>> revisions(const std::string& program) {
    return store_.revisions(program);
  }
  Result<storage::Revision> revision(const std::string& program,
                                     std::optional<std::uint64_t> number) {
    return store_.revision(program, number);
  }
  Result<std::vector<std::byte>> read(const Digest& content, std::uint64_t offset,
                                      std::uint64_t length) {
    return store_.read_content(content, offset, length);
  }
  /// Puts a held revision in force. Errors: NotFound.
  Result<storage::Revision> accept(const std::string& program, std::uint64_t number,
                                   const storage::Actor& who);
  /// Hides a held revision forever. Errors: NotFound, Conflict (it is in force).
  Result<void> reject(const std::string& program, std::uint64_t number, const storage::Actor& who);
  /// Errors: NotFound, Busy, Conflict (protected).
  Result<void> remove(const std::string& program, const storage::Actor& who,
                      Protection protection = Protection::Respect);
  /// Promises of both: storage::ProgramStore.
  Result<storage::Revision> copy(const storage::ProgramMove& move,
                                 std::optional<std::uint64_t> number);
  Result<void> rename(const storage::ProgramMove& move);
  /// The program's own name (program_title.hpp).
  std::string title(const storage::Revision& revision) { return titles_.of(revision.content); }

  static constexpr std::size_t kMaxComment = 1024;
  /// In the comment of what came over a line with faults.
  static constexpr std::string_view kDamageMark = "; DAMAGED ";
  /// How much of a text is searched to determine its control.
  static constexpr std::uint64_t kHead = 64 * 1024;

 private:
  struct Session {
    std::mutex mutex;
    ContentCheck check;
    std::optional<storage::Upload> upload;  ///< as the store returned it last; absent: read it
  };
  std::shared_ptr<Session> session(const std::string& id);
  void drop_session(const std::string& id);
  Result<void> catch_up(Session& session, const storage::Upload& upload);
  Result<void> determine_control(storage::Upload& upload);
  Result<void> check_protection(const std::string& program,
                                const std::optional<Digest>& replacement);
  Error in_control_words(const storage::ProgramMove& move, const Error& error);
  tl::unexpected<Error> drop(const storage::Upload& upload, const Error& error);

  storage::ProgramStore& store_;
  storage::UploadStore& uploads_;
  const Clock& clock_;
  const ControlCatalog& catalog_;
  AuditTrail& audit_;
  ProgramTitles titles_;
  std::function<void(const storage::Revision&)> on_held_;
  std::mutex mutex_;
  std::map<std::string, std::shared_ptr<Session>> sessions_;
};

}  // namespace dripline::library
