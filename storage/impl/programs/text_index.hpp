#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "storage/sql/database.hpp"

/// The full-text index, of which each engine has its own kind: FTS5 in SQLite, `tsvector` with a
/// GIN index in PostgreSQL. Words are those of storage/programs/search_words.hpp, so neither
/// engine's own tokenizer decides anything.
namespace dripline::storage {

struct IndexedWords {
  std::int64_t document = 0;  ///< the id of a search_document
  std::string words;          ///< with blanks between them
};

/// Inside the caller's transaction.
Result<void> add_to_index(sql::Database& database, const IndexedWords& added);
/// `removed` must be what was added.
Result<void> take_from_index(sql::Database& database, const IndexedWords& removed);

/// What documents are looked for by, in the engine's own language.
class IndexCondition {
 public:
  explicit IndexCondition(sql::Engine engine) : engine_(engine) {}
  /// Every one that is added must be true.
  void add_word(std::string_view word) { add(quoted(word)); }
  void add_beginning(std::string_view beginning);
  void add_any_of(const std::vector<std::string>& words);
  const std::string& text() const { return text_; }

 private:
  void add(const std::string& term);
  std::string quoted(std::string_view word) const;

  sql::Engine engine_;
  std::string text_;
};

/// A table of the documents that a condition is true of (`?1`), newest first; the column of their
/// ids and the condition on it.
struct IndexSource {
  std::string from;       ///< "FROM ... " up to and with search_document
  std::string id;         ///< to order by
  std::string condition;  ///< of `?1`
};
const IndexSource& index_source(sql::Engine engine);

}  // namespace dripline::storage
