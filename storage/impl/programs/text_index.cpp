#include "storage/impl/programs/text_index.hpp"

#include "storage/sql/query.hpp"

namespace dripline::storage {

Result<void> add_to_index(sql::Database& database, const IndexedWords& added) {
  if (database.engine() == sql::Engine::Sqlite) {
    return sql::run(database, "INSERT INTO search_index (rowid, words) VALUES (?1, ?2)",
                    added.document, added.words);
  }
  return sql::run(database,
                  "INSERT INTO search_index (id, words) VALUES (?1, "
                  "array_to_tsvector(string_to_array(btrim(?2), ' ')))",
                  added.document, added.words);
}

Result<void> take_from_index(sql::Database& database, const IndexedWords& removed) {
  if (database.engine() == sql::Engine::Sqlite) {
    // The index has no text of its own: what is taken out is named by its words.
    return sql::run(database,
                    "INSERT INTO search_index (search_index, rowid, words) VALUES "
                    "('delete', ?1, ?2)",
                    removed.document, removed.words);
  }
  return sql::run(database, "DELETE FROM search_index WHERE id = ?1", removed.document);
}

void IndexCondition::add(const std::string& term) {
  const char* both = engine_ == sql::Engine::Sqlite ? " AND " : " & ";
  text_ += (text_.empty() ? "" : both) + term;
}

/// Words have no quotation marks, and no backslash.
std::string IndexCondition::quoted(std::string_view word) const {
  return engine_ == sql::Engine::Sqlite ? fmt::format("\"{}\"", word) : fmt::format("'{}'", word);
}

void IndexCondition::add_beginning(std::string_view beginning) {
  add(quoted(beginning) + (engine_ == sql::Engine::Sqlite ? " *" : ":*"));
}

void IndexCondition::add_any_of(const std::vector<std::string>& words) {
  const char* either = engine_ == sql::Engine::Sqlite ? " OR " : " | ";
  std::string any;
  for (const auto& word : words) any += (any.empty() ? "(" : either) + quoted(word);
  add(any + ")");
}

const IndexSource& index_source(sql::Engine engine) {
  static const IndexSource kFts{
      "FROM search_index CROSS JOIN search_document ON search_document.id = search_index.rowid ",
      "search_index.rowid", "search_index MATCH ?1 "};
  static const IndexSource kVector{
      "FROM search_index JOIN search_document ON search_document.id = search_index.id ",
      "search_index.id", "search_index.words @@ CAST(?1 AS tsquery) "};
  return engine == sql::Engine::Sqlite ? kFts : kVector;
}

}  // namespace dripline::storage
