#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "protocol/base/clock.hpp"
#include "protocol/base/digest.hpp"
#include "protocol/base/result.hpp"
#include "storage/actor.hpp"
#include "storage/page.hpp"
#include "storage/programs/program_fields.hpp"
#include "storage/programs/revision_state.hpp"

namespace dripline::storage {

struct Revision {
  std::string program;       ///< name
  std::uint64_t number = 0;  ///< 1, 2, 3 ... per program
  Digest content;            ///< SHA-256 of the bytes
  std::uint64_t size = 0;
  std::string control;  ///< dialect name, or empty when not known
  std::string comment;
  std::string author;
  UtcTime created;
  bool is_held = false;             ///< a machine sent it; it runs nowhere until it is accepted
  std::optional<UtcTime> accepted;  ///< when a revision that was held was accepted
  RevisionState state = RevisionState::Draft;
  std::optional<UtcTime> released, withdrawn;  ///< when; absent: never
  std::string cam_file;                        ///< where its bytes come from; empty: not stated

  /// The newest run (Run::number) when it came into force, was released, was withdrawn; 0: there
  /// was none. Absent: not yet, or before version 25.
  std::optional<std::uint64_t> in_force_after = {}, released_after = {}, withdrawn_after = {};

  /// What it was when this run was stored; for 0, a run that is not, what it is now. By the store's
  /// own order and by no time: clocks are set, and those of two servers differ.
  bool was_in_force_for(std::uint64_t run) const {
    return !is_held && !came_after(in_force_after, run);
  }
  bool was_withdrawn_for(std::uint64_t run) const {
    return state == RevisionState::Withdrawn && !came_after(withdrawn_after, run);
  }
  bool was_released_for(std::uint64_t run) const {
    const bool is_ever = state == RevisionState::Released ||
                         (state == RevisionState::Withdrawn && released.has_value());
    return is_ever && !came_after(released_after, run) && !was_withdrawn_for(run);
  }

 private:
  static bool came_after(const std::optional<std::uint64_t>& newest, std::uint64_t run) {
    return run != 0 && newest && *newest >= run;
  }
};

struct ProgramSummary {
  Revision latest;              ///< a held one only when the program has no other
  std::uint64_t revisions = 0;  ///< held ones included
  bool is_removed = false;
  std::uint64_t held = 0;                      ///< revisions that wait for acceptance
  std::optional<std::uint64_t> released = {};  ///< the latest revision that is released
  ProgramFields fields = {};
};

/// Programs with these values, exactly. Control, author and state are those of the latest revision.
struct ProgramFilter {
  std::optional<std::string> part = {}, operation = {}, material = {}, machine_group = {};
  std::optional<std::string> control = {}, author = {};
  std::optional<RevisionState> state = {};
  std::string after = {};  ///< only names past this one: for paging by the last name seen
};

/// A program that gets another name, or a copy of one.
struct ProgramMove {
  std::string from, to;
  Actor who;
};

/// Names with immutable revisions; content is addressed by its SHA-256. Promises of every store:
/// storage/store.hpp.
class ProgramStore {
 public:
  virtual ~ProgramStore() = default;

  /// In order of their names.
  virtual Result<std::vector<ProgramSummary>> list(const ProgramFilter& filter, Page page) = 0;
  Result<std::vector<ProgramSummary>> list(Page page) { return list({}, page); }
  /// Errors: NotFound.
  virtual Result<ProgramFields> fields(const std::string& program) = 0;
  /// The audit entry (program.describe) is part of the transaction; what has the value already is
  /// no change. Errors: NotFound, Conflict (no such machine group).
  virtual Result<void> describe(const Description& description) = 0;
  /// The number of programs that `list` names.
  virtual Result<std::uint64_t> count() = 0;
  /// Newest first, held ones included. Errors: NotFound.
  virtual Result<std::vector<Revision>> revisions(const std::string& program) = 0;
  /// The latest that is not held, or the one with that number, held or not. Errors: NotFound (also
  /// when the program was removed), Conflict (every revision is held), Corrupt (its row names
  /// another content than it was stored with).
  virtual Result<Revision> revision(const std::string& program,
                                    std::optional<std::uint64_t> number) = 0;
  /// Puts a held revision in force; the latest is still the one with the highest number. A revision
  /// in force stays as it is. The audit entry (program.accept, program.reject) is part of the
  /// transaction. Errors: NotFound.
  virtual Result<Revision> accept(const std::string& program, std::uint64_t number,
                                  const Actor& who) = 0;
  /// Hides a held revision forever. Errors: NotFound, Conflict (it is not held).
  virtual Result<void> reject(const std::string& program, std::uint64_t number,
                              const Actor& who) = 0;
  /// Makes a new program of the latest revision, or of the one with that number; the audit entry
  /// (program.copy) is part of the transaction. Errors: NotFound, Syntax and LimitExceeded (the new
  /// name), Conflict (it exists, or is the same; the revision is held).
  virtual Result<Revision> copy(const ProgramMove& move, std::optional<std::uint64_t> number) = 0;
  /// Gives a program with all its revisions, and its runs, another name; the audit entry
  /// (program.rename) is part of the transaction. Errors: those of copy, Busy (an unfinished run
  /// uses it, named).
  virtual Result<void> rename(const ProgramMove& move) = 0;
  /// Hides the program from listings and starts; runs keep their revision. A program pushed again
  /// under the name shows only its new revisions, with higher numbers. Errors: NotFound, Busy (an
  /// unfinished run uses it).
  virtual Result<void> remove(const std::string& program) = 0;
  /// Bytes of stored content from `offset`, at most `length`. Every chunk it reads is checked
  /// against its own SHA-256, and against the digest recorded for this place of this content,
  /// before a byte is returned. Errors: NotFound, Corrupt (the chunk is named).
  virtual Result<std::vector<std::byte>> read_content(const Digest& content, std::uint64_t offset,
                                                      std::uint64_t length) = 0;
  /// The same, of what needs no database and waits for none: it is in memory, or in the server's
  /// own cache (content_cache.hpp). nullopt: some of it is not, or the store is another server's
  /// now.
  virtual std::optional<std::vector<std::byte>> near_content(const Digest& content,
                                                             std::uint64_t offset,
                                                             std::uint64_t length) = 0;
  struct Fetched {
    std::uint64_t bytes = 0;  ///< that the chunk takes in the cache; 0: it was not kept
    bool is_end = false;      ///< there is no such chunk, or no cache
  };
  /// Brings the chunk at `position` (0, 1, 2 ...) into the server's own cache. Errors: those of
  /// read_content.
  virtual Result<Fetched> fetch_ahead(const Digest& content, std::uint64_t position) = 0;
  /// Whether the stored list of chunks is the one whose bytes were compared with `content`. Reads
  /// no bytes, except once all of a content that an older version stored. Errors: NotFound, Corrupt
  /// (the chunk is named).
  virtual Result<void> verify_content(const Digest& content) = 0;
};

}  // namespace dripline::storage
