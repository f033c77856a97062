#include "storage/impl/programs/search_repository.hpp"

#include <limits>

#include "storage/impl/programs/field_rows.hpp"
#include "storage/impl/programs/revision_rows.hpp"
#include "storage/impl/programs/search_documents.hpp"

namespace dripline::storage {
namespace {

/// Words have no quotation marks.
std::string in_quotes(std::string_view word) {
  return fmt::format("\"{}\"", word);
}

/// Of the groups that the machine is in; every machine is in `all`.
Result<std::string> machine_condition(sqlite::Database& database, const std::string& machine) {
  const auto groups = sqlite::all_rows(
      database,
      "SELECT machine_group FROM machine_group_member WHERE machine = ?1 UNION SELECT 'all'",
      [](const sqlite::Statement& row) { return row.text(0); }, machine);
  if (!groups) return fail(groups.error());
  std::string condition;
  for (const auto& group : *groups)
    condition += (condition.empty() ? "(" : " OR ") + in_quotes(facet('g', group));
  return condition + ")";
}

/// What the index has instead of `rou*`: its words that begin so, one after the other, because FTS5
/// would read all rows of each before it names the first one. Of too many words it does that.
Result<std::string> beginning_condition(sqlite::Database& database, const std::string& beginning) {
  constexpr std::uint64_t kMaxWords = 64;
  constexpr const char* kLastCharacter = "\xF4\x8F\xBF\xBF";
  const auto words = sqlite::all_rows(
      database, "SELECT word FROM search_word WHERE word >= ?1 AND word < ?2 LIMIT ?3",
      [](const sqlite::Statement& row) { return row.text(0); }, beginning,
      beginning + kLastCharacter, kMaxWords + 1);
  if (!words) return fail(words.error());
  if (words->empty() || words->size() > kMaxWords) return in_quotes(beginning) + " *";
  std::string condition;
  for (const auto& word : *words) condition += (condition.empty() ? "(" : " OR ") + in_quotes(word);
  return condition + ")";
}

/// The expression of FTS5.
Result<std::string> expression_of(sqlite::Database& database, const std::vector<SearchTerm>& terms,
                                  const SearchFilter& filter) {
  std::string expression;
  const auto add = [&](const std::string& term) {
    expression += (expression.empty() ? "" : " AND ") + term;
  };
  for (const SearchTerm& term : terms) {
    auto condition = term.is_beginning ? beginning_condition(database, term.word)
                                       : Result<std::string>(in_quotes(term.word));
    if (!condition) return condition;
    add(*condition);
  }
  const auto add_facet = [&](char kind, const std::optional<std::string>& value) {
    if (value) add(in_quotes(facet(kind, *value)));
  };
  add_facet('p', filter.part);
  add_facet('o', filter.operation);
  add_facet('m', filter.material);
  add_facet('g', filter.machine_group);
  add_facet('c', filter.control);
  add_facet('a', filter.author);
  if (filter.state) add(in_quotes(facet('s', to_string(*filter.state))));
  if (!filter.with_replaced) add(in_quotes(kCurrentFacet));
  if (!filter.machine) return expression;
  auto condition = machine_condition(database, *filter.machine);
  if (!condition) return condition;
  add(*condition);
  return expression;
}

}  // namespace

Result<std::vector<SearchHit>> SearchRepository::search(const std::vector<SearchTerm>& terms,
                                                        const SearchFilter& filter,
                                                        std::uint64_t before, std::uint64_t limit) {
  // What cannot be seen any more may still be in the index for a moment.
  static const std::string kSql =
      "SELECT " + kRevisionColumns + ", search_document.id, " + kFieldColumns +
      "FROM search_index CROSS JOIN search_document ON search_document.id = search_index.rowid "
      "JOIN program ON program.id = search_document.program "
      "JOIN revision ON revision.program = search_document.program "
      "AND revision.number = search_document.revision "
      "LEFT JOIN content ON content.sha256 = revision.sha256 "
      "LEFT JOIN content AS named ON named.id = revision.content "
      "WHERE search_index MATCH ?1 AND search_index.rowid < ?2 AND " +
      kRevisionVisible + "ORDER BY search_index.rowid DESC LIMIT ?3";
  constexpr auto kNewest = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
  return connections_.read([&](sqlite::Database& database) -> Result<std::vector<SearchHit>> {
    const auto expression = expression_of(database, terms, filter);
    if (!expression) return fail(expression.error());
    return sqlite::all_rows(
        database, kSql,
        [](const sqlite::Statement& row) {
          return SearchHit{row.number(kAfterRevision), read_revision(row),
                           read_fields(row, kAfterRevision + 1)};
        },
        *expression, before == 0 ? kNewest : before, limit);
  });
}

Result<std::uint64_t> SearchRepository::count_due() {
  const auto count = connections_.read([&](sqlite::Database& database) {
    return sqlite::first_row(database, "SELECT count(*) FROM search_due",
                             [](const sqlite::Statement& row) { return row.number(0); });
  });
  if (!count) return fail(count.error());
  return count->value_or(0);
}

namespace {

struct IndexWork {
  std::vector<DocumentChange> changes;
  std::vector<DueProgram> finished;
  bool is_done = true;
};

/// What one transaction takes.
Result<IndexWork> work_of(sqlite::Database& database) {
  constexpr std::uint64_t kMaxPrograms = 64;
  const auto due = sqlite::all_rows(
      database, "SELECT program, version FROM search_due ORDER BY program LIMIT ?1",
      [](const sqlite::Statement& row) {
        return DueProgram{row.integer(0), row.number(1)};
      },
      kMaxPrograms);
  if (!due) return fail(due.error());
  IndexWork work;
  work.is_done = due->size() < kMaxPrograms;
  std::uint64_t bytes = 0;
  for (const DueProgram& program : *due) {
    if (bytes >= SearchStore::kIndexedBytes) {
      work.is_done = false;
      break;
    }
    auto found = changes_of(database, program.program, bytes);
    if (!found) return fail(found.error());
    for (auto& change : found->changes) work.changes.push_back(std::move(change));
    if (found->is_whole) work.finished.push_back(program);
    if (!found->is_whole) work.is_done = false;
  }
  return work;
}

}  // namespace

Result<IndexProgress> SearchRepository::index_some() {
  const auto work = connections_.read(work_of);
  if (!work) return fail(work.error());
  if (work->changes.empty() && work->finished.empty()) return IndexProgress{};
  const auto written = connections_.write(
      [&](sqlite::Database& database) -> Result<void> {
        for (const DocumentChange& change : work->changes) {
          if (auto applied = apply(database, change); !applied) return applied;
        }
        for (const DueProgram& program : work->finished) {
          auto done =
              sqlite::run(database, "DELETE FROM search_due WHERE program = ?1 AND version = ?2",
                          program.program, program.version);
          if (!done) return done;
        }
        return {};
      },
      sqlite::Synchronous::Normal);
  if (!written) return fail(written.error());
  return IndexProgress{work->changes.size(), work->is_done};
}

}  // namespace dripline::storage
