#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "storage/sql/query.hpp"

/// Documents of the full-text index: what they should be, and how they get there.
namespace dripline::storage {

/// A word that no user can type, for a value that is filtered by. `kind`: c(ontrol), s(tate),
/// a(uthor), p(art), o(peration), m(aterial), g(roup).
std::string facet(char kind, std::string_view value);
/// Of every revision that no newer one in force has replaced.
inline constexpr std::string_view kCurrentFacet = "$now";

/// A document to be made, changed or taken out.
struct DocumentChange {
  std::int64_t program = 0;
  std::uint64_t revision = 0;
  std::optional<std::int64_t> old_id;         ///< absent: it is new
  std::string old_words = {}, old_text = {};  ///< the text: all words of it, joined
  bool is_removed = false;
  std::string words = {}, text = {};
  std::uint64_t text_bytes = 0;
};

struct DueProgram {
  std::int64_t program = 0;
  std::uint64_t version = 0;
};

/// What is to be changed of a program's documents; stops when `bytes` of text were read, and
/// `is_whole` is false then.
struct DueChanges {
  std::vector<DocumentChange> changes;
  bool is_whole = true;
};
Result<DueChanges> changes_of(sql::Database& database, std::int64_t program, std::uint64_t& bytes);

/// Inside the caller's transaction.
Result<void> apply(sql::Database& database, const DocumentChange& change);

}  // namespace dripline::storage
