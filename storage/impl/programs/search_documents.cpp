#include "storage/impl/programs/search_documents.hpp"

#include <fmt/ranges.h>
#include <algorithm>
#include <map>
#include <set>

#include "protocol/base/digest.hpp"
#include "storage/impl/programs/content.hpp"
#include "storage/impl/programs/text_index.hpp"
#include "storage/programs/search_store.hpp"
#include "storage/programs/search_words.hpp"

namespace dripline::storage {

std::string facet(char kind, std::string_view value) {
  constexpr std::size_t kDigits = 16;
  return fmt::format("${}{}", kind, sha256(value).hex().substr(0, kDigits));
}

namespace {

struct RevisionCard {
  std::uint64_t number = 0;
  Digest content;
  std::set<std::string> words;  ///< facets included
};

/// What all revisions of a program share.
struct ProgramCard {
  std::uint64_t latest = 0, released = 0;
  std::set<std::string> words;
};

void add_field(std::set<std::string>& words, char kind, const std::string& value) {
  if (value.empty()) return;
  add_search_words(value, WordsOf::Card, words);
  words.insert(facet(kind, value));
}

Result<std::optional<ProgramCard>> program_card(sql::Database& database, std::int64_t program) {
  return sql::first_row(
      database,
      "SELECT name, part, operation, material, machine_group, coalesce(latest, 0), "
      "coalesce(released, 0) FROM program WHERE id = ?1",
      [](const sql::Statement& row) {
        ProgramCard card;
        add_search_words(row.text(0), WordsOf::Card, card.words);
        add_field(card.words, 'p', row.text(1));
        add_field(card.words, 'o', row.text(2));
        add_field(card.words, 'm', row.text(3));
        add_field(card.words, 'g', row.text(4));
        card.latest = row.number(5);
        card.released = row.number(6);
        return card;
      },
      program);
}

Result<std::vector<RevisionCard>> revision_cards(sql::Database& database, std::int64_t program,
                                                 const ProgramCard& shared) {
  return sql::all_rows(
      database,
      "SELECT number, sha256, control, state, author, comment, cam_file, standing FROM revision "
      "JOIN program ON program.id = revision.program WHERE program = ?1 "
      "AND number > removed_through AND standing <> 'rejected' ORDER BY number DESC",
      [&](const sql::Statement& row) {
        RevisionCard card{row.number(0), read_digest(row, 1), shared.words};
        const std::string state = row.text(3);
        if (!row.text(2).empty()) card.words.insert(facet('c', row.text(2)));
        card.words.insert(facet('s', state));
        add_field(card.words, 'a', row.text(4));
        add_search_words(row.text(5), WordsOf::Card, card.words);
        add_search_words(row.text(6), WordsOf::Card, card.words);
        const bool waits = row.text(7) == "held" || state == "in_review" || state == "approved";
        if (waits || card.number == shared.latest || card.number == shared.released)
          card.words.insert(std::string(kCurrentFacet));
        return card;
      },
      program);
}

Result<void> add_attachments(sql::Database& database, std::int64_t program,
                             std::vector<RevisionCard>& cards) {
  using Row = std::pair<std::uint64_t, std::string>;
  const auto rows = sql::all_rows(
      database, "SELECT coalesce(revision, 0), name, comment FROM attachment WHERE program = ?1",
      [](const sql::Statement& row) { return Row(row.number(0), row.text(1) + " " + row.text(2)); },
      program);
  if (!rows) return fail(rows.error());
  for (const auto& [revision, text] : *rows) {
    for (RevisionCard& card : cards) {
      if (revision == 0 || revision == card.number)
        add_search_words(text, WordsOf::Card, card.words);
    }
  }
  return {};
}

struct StoredDocument {
  std::int64_t id = 0;
  std::string words;
  std::uint64_t text_bytes = 0;
};

Result<std::map<std::uint64_t, StoredDocument>> stored_documents(sql::Database& database,
                                                                 std::int64_t program) {
  using Row = std::pair<std::uint64_t, StoredDocument>;
  auto rows = sql::all_rows(
      database, "SELECT revision, id, words, text FROM search_document WHERE program = ?1",
      [](const sql::Statement& row) {
        return Row(row.number(0), {row.integer(1), row.text(2), row.number(3)});
      },
      program);
  if (!rows) return fail(rows.error());
  return std::map<std::uint64_t, StoredDocument>(rows->begin(), rows->end());
}

struct TextWords {
  std::string words;
  std::uint64_t bytes = 0;
};

/// The words of the first `bytes` of a content; none where it cannot be read: reading the program
/// reports that.
TextWords text_words(sql::Database& database, const Digest& content, std::uint64_t bytes) {
  const auto row = find_content(database, content);
  if (!row || !*row || bytes == 0) return {};
  const auto text = load_range(database, **row, 0, bytes, "search");
  if (!text) return {};
  std::set<std::string> words;
  add_search_words({reinterpret_cast<const char*>(text->data()), text->size()}, WordsOf::Text,
                   words);
  return {fmt::format("{}", fmt::join(words, " ")), text->size()};
}

Result<Digest> content_of(sql::Database& database, std::int64_t program, std::uint64_t revision) {
  const auto found = sql::first_row(
      database, "SELECT sha256 FROM revision WHERE program = ?1 AND number = ?2",
      [](const sql::Statement& row) { return read_digest(row, 0); }, program, revision);
  if (!found) return fail(found.error());
  return found->value_or(Digest{});
}

}  // namespace

Result<DueChanges> changes_of(sql::Database& database, std::int64_t program, std::uint64_t& bytes) {
  const auto shared = program_card(database, program);
  if (!shared) return fail(shared.error());
  auto cards = revision_cards(database, program, shared->value_or(ProgramCard{}));
  if (!cards) return fail(cards.error());
  if (auto added = add_attachments(database, program, *cards); !added) return fail(added.error());
  auto stored = stored_documents(database, program);
  if (!stored) return fail(stored.error());
  DueChanges found;
  const auto is_full = [&] {
    found.is_whole = bytes < SearchStore::kIndexedBytes;
    return !found.is_whole;
  };
  for (const RevisionCard& card : *cards) {
    const std::string words = fmt::format("{}", fmt::join(card.words, " "));
    const auto old = stored->extract(card.number);
    if (!old.empty() && old.mapped().words == words) continue;
    if (is_full()) return found;
    DocumentChange change{.program = program, .revision = card.number, .old_id = {}};
    TextWords text = text_words(database, card.content, SearchStore::kIndexedBytes);
    bytes += text.bytes;
    if (!old.empty()) {
      change.old_id = old.mapped().id;
      change.old_words = old.mapped().words;
      change.old_text = text.bytes == old.mapped().text_bytes
                            ? text.words
                            : text_words(database, card.content, old.mapped().text_bytes).words;
    }
    change.words = words;
    change.text = std::move(text.words);
    change.text_bytes = text.bytes;
    found.changes.push_back(std::move(change));
  }
  for (const auto& [revision, document] : *stored) {  // of revisions that cannot be seen any more
    if (is_full()) return found;
    const auto content = content_of(database, program, revision);
    if (!content) return fail(content.error());
    const TextWords text = text_words(database, *content, document.text_bytes);
    bytes += text.bytes;
    found.changes.push_back({.program = program,
                             .revision = revision,
                             .old_id = document.id,
                             .old_words = document.words,
                             .old_text = text.words,
                             .is_removed = true});
  }
  return found;
}

namespace {

/// Those of letters, separated by blanks: what `rou*` may stand for.
Result<void> add_words(sql::Database& database, std::string_view words) {
  for (std::size_t at = 0; at < words.size();) {
    const std::size_t end = std::min(words.find(' ', at), words.size());
    const std::string_view word = words.substr(at, end - at);
    at = end + 1;
    if (!is_word_of_letters(word)) continue;
    auto added = sql::run(
        database, "INSERT INTO search_word (word) VALUES (?1) ON CONFLICT (word) DO NOTHING", word);
    if (!added) return added;
  }
  return {};
}

}  // namespace

Result<void> apply(sql::Database& database, const DocumentChange& change) {
  if (change.old_id) {
    auto gone =
        take_from_index(database, {*change.old_id, change.old_words + " " + change.old_text});
    if (!gone) return gone;
    gone = sql::run(database, "DELETE FROM search_document WHERE id = ?1", *change.old_id);
    if (!gone) return gone;
  }
  if (change.is_removed) return {};
  const auto id = sql::insert(database,
                              "INSERT INTO search_document (program, revision, words, text) "
                              "VALUES (?1, ?2, ?3, ?4) RETURNING id",
                              change.program, change.revision, change.words, change.text_bytes);
  if (!id) return fail(id.error());
  const std::string words = change.words + " " + change.text;
  auto made = add_to_index(database, {*id, words});
  return made ? add_words(database, words) : made;
}

}  // namespace dripline::storage
