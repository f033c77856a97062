#include "server/library/program_search.hpp"

#include <algorithm>

#include "protocol/process/log.hpp"

namespace dripline::library {
namespace {

using namespace std::chrono_literals;

constexpr auto kIdle = 250ms;  ///< between looks for what has changed
constexpr auto kPause = 2ms;   ///< after each part: others wait for the writer too
constexpr auto kAfterFailure = 10s;

std::optional<storage::FoundLine> line_in(const storage::Store& store,
                                          const storage::Revision& revision,
                                          const std::vector<storage::SearchTerm>& terms) {
  const auto bytes = store.programs.read_content(
      revision.content, 0, std::min(revision.size, storage::SearchStore::kIndexedBytes));
  if (!bytes) return std::nullopt;  // reading the program reports that
  return storage::find_line({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, terms);
}

}  // namespace

ProgramSearch::ProgramSearch(const storage::Store& store)
    : store_(store), indexer_([this](const std::stop_token& stop) { work(stop); }) {}

void ProgramSearch::work(const std::stop_token& stop) {
  std::uint64_t documents = 0;
  while (!stop.stop_requested()) {
    const auto progress = store_.search.index_some();
    if (!progress && progress.error().code != Errc::Busy)
      process::log_warning("programs could not be indexed: {}", progress.error().what);
    if (progress) documents += progress->documents;
    const bool is_done = !progress || progress->is_done;
    constexpr std::uint64_t kWorthALine = 1000;
    if (is_done && documents >= kWorthALine)
      process::log_info("indexed {} revisions for the search", std::exchange(documents, 0));
    const auto pause = !progress ? std::chrono::milliseconds(kAfterFailure)
                       : is_done ? std::chrono::milliseconds(kIdle)
                                 : std::chrono::milliseconds(kPause);
    std::unique_lock lock(mutex_);
    waiting_.wait_for(lock, stop, pause, [] { return false; });
  }
}

Result<SearchResult> ProgramSearch::search(const SearchRequest& request) {
  const auto terms = storage::parse_search(request.words);
  if (!terms) return fail(terms.error());
  const std::uint64_t limit = std::clamp<std::uint64_t>(request.limit, 1, kMaxLimit);
  const auto hits = store_.search.search(*terms, request.filter, request.before, limit);
  if (!hits) return fail(hits.error());
  SearchResult result;
  for (const auto& hit : *hits) {
    result.hits.push_back(
        {.hit = hit,
         .line = line_in(store_, hit.revision, *terms),
         .is_partly_indexed = hit.revision.size > storage::SearchStore::kIndexedBytes});
  }
  if (hits->size() == limit) result.next = hits->back().document;
  const auto due = store_.search.count_due();
  if (!due) return fail(due.error());
  result.to_be_indexed = *due;
  return result;
}

}  // namespace dripline::library
