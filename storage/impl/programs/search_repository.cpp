#include "storage/impl/programs/search_repository.hpp"

#include <limits>

#include "storage/impl/programs/field_rows.hpp"
#include "storage/impl/programs/revision_rows.hpp"
#include "storage/impl/programs/search_documents.hpp"
#include "storage/impl/programs/text_index.hpp"

namespace dripline::storage {
namespace {

/// Of the groups that the machine is in; every machine is in `all`.
Result<std::vector<std::string>> group_facets(sql::Database& database, const std::string& machine) {
  return sql::all_rows(
      database,
      "SELECT machine_group FROM machine_group_member WHERE machine = ?1 UNION SELECT 'all'",
      [](const sql::Statement& row) { return facet('g', row.text(0)); }, machine);
}

/// What the index has instead of `rou*`: its words that begin so, one after the other, because FTS5
/// would read all rows of each before it names the first one. Of too many words it does that.
Result<void> add_beginning(sql::Database& database, const std::string& beginning,
                           IndexCondition& condition) {
  constexpr std::uint64_t kMaxWords = 64;
  constexpr const char* kLastCharacter = "\xF4\x8F\xBF\xBF";
  const auto words = sql::all_rows(
      database, "SELECT word FROM search_word WHERE word >= ?1 AND word < ?2 LIMIT ?3",
      [](const sql::Statement& row) { return row.text(0); }, beginning, beginning + kLastCharacter,
      kMaxWords + 1);
  if (!words) return fail(words.error());
  if (words->empty() || words->size() > kMaxWords) {
    condition.add_beginning(beginning);
  } else {
    condition.add_any_of(*words);
  }
  return {};
}

Result<IndexCondition> condition_of(sql::Database& database, const std::vector<SearchTerm>& terms,
                                    const SearchFilter& filter) {
  IndexCondition condition(database.engine());
  for (const SearchTerm& term : terms) {
    if (!term.is_beginning) {
      condition.add_word(term.word);
    } else if (auto added = add_beginning(database, term.word, condition); !added) {
      return fail(added.error());
    }
  }
  const auto add_facet = [&](char kind, const std::optional<std::string>& value) {
    if (value) condition.add_word(facet(kind, *value));
  };
  add_facet('p', filter.part);
  add_facet('o', filter.operation);
  add_facet('m', filter.material);
  add_facet('g', filter.machine_group);
  add_facet('c', filter.control);
  add_facet('a', filter.author);
  if (filter.state) condition.add_word(facet('s', to_string(*filter.state)));
  if (!filter.with_replaced) condition.add_word(kCurrentFacet);
  if (!filter.machine) return condition;
  const auto groups = group_facets(database, *filter.machine);
  if (!groups) return fail(groups.error());
  condition.add_any_of(*groups);
  return condition;
}

/// What cannot be seen any more may still be in the index for a moment.
std::string search_sql(const IndexSource& index) {
  return "SELECT " + kRevisionColumns + ", search_document.id, " + kFieldColumns + index.from +
         "JOIN program ON program.id = search_document.program "
         "JOIN revision ON revision.program = search_document.program "
         "AND revision.number = search_document.revision "
         "LEFT JOIN content ON content.sha256 = revision.sha256 "
         "LEFT JOIN content AS named ON named.id = revision.content "
         "WHERE " +
         index.condition + "AND " + index.id + " < ?2 AND " + kRevisionVisible + "ORDER BY " +
         index.id + " DESC LIMIT ?3";
}

}  // namespace

Result<std::vector<SearchHit>> SearchRepository::search(const std::vector<SearchTerm>& terms,
                                                        const SearchFilter& filter,
                                                        std::uint64_t before, std::uint64_t limit) {
  constexpr auto kNewest = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
  return connections_.read([&](sql::Database& database) -> Result<std::vector<SearchHit>> {
    const auto condition = condition_of(database, terms, filter);
    if (!condition) return fail(condition.error());
    const std::string sql = search_sql(index_source(database.engine()));
    return sql::all_rows(
        database, sql,
        [](const sql::Statement& row) {
          return SearchHit{row.number(kAfterRevision), read_revision(row),
                           read_fields(row, kAfterRevision + 1)};
        },
        condition->text(), before == 0 ? kNewest : before, limit);
  });
}

Result<std::uint64_t> SearchRepository::count_due() {
  const auto count = connections_.read([&](sql::Database& database) {
    return sql::first_row(database, "SELECT count(*) FROM search_due",
                          [](const sql::Statement& row) { return row.number(0); });
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
Result<IndexWork> work_of(sql::Database& database) {
  constexpr std::uint64_t kMaxPrograms = 64;
  const auto due = sql::all_rows(
      database, "SELECT program, version FROM search_due ORDER BY program LIMIT ?1",
      [](const sql::Statement& row) {
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
      [&](sql::Database& database) -> Result<void> {
        for (const DocumentChange& change : work->changes) {
          if (auto applied = apply(database, change); !applied) return applied;
        }
        for (const DueProgram& program : work->finished) {
          auto done =
              sql::run(database, "DELETE FROM search_due WHERE program = ?1 AND version = ?2",
                       program.program, program.version);
          if (!done) return done;
        }
        return {};
      },
      Durability::Normal);
  if (!written) return fail(written.error());
  return IndexProgress{work->changes.size(), work->is_done};
}

}  // namespace dripline::storage
