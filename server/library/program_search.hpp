#pragma once

#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "storage/store.hpp"

namespace dripline::library {

struct SearchRequest {
  std::string words = {};  ///< as a user types them (storage/programs/search_words.hpp)
  storage::SearchFilter filter = {};
  std::uint64_t before = 0;  ///< the last document of the page before; 0: the first page
  std::uint64_t limit = 20;
};

struct SearchResult {
  struct Hit {
    storage::SearchHit hit;
    /// The line of its text with most of the words; absent: they are in its fields.
    std::optional<storage::FoundLine> line;
    bool is_partly_indexed = false;  ///< its text is longer than SearchStore::kIndexedBytes
  };
  std::vector<Hit> hits;
  /// `before` of the next page; absent: there is none.
  std::optional<std::uint64_t> next;
  std::uint64_t to_be_indexed = 0;  ///< programs that are not found yet, or as they were
};

/// Full-text search over the library. A thread of its own indexes what has changed, a bounded part
/// at a time, so that pushes do not wait; it continues where it was after a restart. Any thread.
class ProgramSearch {
 public:
  explicit ProgramSearch(const storage::Store& store);

  /// Errors: those of storage::parse_search.
  Result<SearchResult> search(const SearchRequest& request);

  static constexpr std::uint64_t kMaxLimit = 100;

 private:
  void work(const std::stop_token& stop);

  const storage::Store store_;
  std::mutex mutex_;
  std::condition_variable_any waiting_;
  std::jthread indexer_;  // last: it uses the others
};

}  // namespace dripline::library
