#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "protocol/base/result.hpp"
#include "storage/programs/program_store.hpp"
#include "storage/programs/search_words.hpp"

namespace dripline::storage {

/// What must be true of a found revision beside its words; values are compared exactly.
struct SearchFilter {
  std::optional<std::string> part = {}, operation = {}, material = {}, machine_group = {};
  std::optional<std::string> control = {}, author = {};
  std::optional<std::string> machine = {};  ///< in the machine group of its program
  std::optional<RevisionState> state = {};
  /// Also revisions that a newer one in force has replaced. Without: the latest in force, the
  /// latest released, and those that wait (for acceptance, in review, approved).
  bool with_replaced = false;
};

struct SearchHit {
  std::uint64_t document = 0;  ///< higher: it was changed later
  Revision revision;
  ProgramFields fields;
};

struct IndexProgress {
  std::uint64_t documents = 0;  ///< made or taken out
  bool is_done = true;          ///< nothing is left to be indexed
};

/// Full-text search over programs: the words of their names, fields, comments, authors, attachments
/// and of the first kIndexedBytes of their text. What changes is noted in the transaction that
/// changes it and indexed by `index_some`. Promises of every store: storage/store.hpp.
class SearchStore {
 public:
  virtual ~SearchStore() = default;

  /// Changed last first; those before document `before`.
  virtual Result<std::vector<SearchHit>> search(const std::vector<SearchTerm>& terms,
                                                const SearchFilter& filter, std::uint64_t before,
                                                std::uint64_t limit) = 0;
  /// Programs that are to be indexed.
  virtual Result<std::uint64_t> count_due() = 0;
  /// Indexes a bounded part of what is due; holds the writer for at most about kIndexedBytes of
  /// text at a time. One thread at a time. A part that was not finished is begun again.
  virtual Result<IndexProgress> index_some() = 0;

  static constexpr std::uint64_t kIndexedBytes = 256u << 10;  ///< of each revision
};

}  // namespace dripline::storage
