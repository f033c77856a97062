// Listings and searches over 100,000 programs of 10 revisions: how long each takes, and what the
// index costs. Prints a line for each kind of query; fails when the 95th percentile of one is over
// 50 ms. The store is built in TMPDIR (about 2 GB): texts by pushes, revisions by SQL.
//
//     library_bench [programs] [revisions] [queries]
#include <stdlib.h>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <random>

#include "protocol/base/invariant.hpp"
#include "server/library/program_search.hpp"
#include "server/library/program_title.hpp"
#include "storage/sqlite/database.hpp"
#include "storage/sqlite_store.hpp"

namespace dripline {
namespace {

constexpr std::size_t kTexts = 20'000;
constexpr double kMostMs = 50;

double ms_since(std::chrono::steady_clock::time_point begun) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begun)
      .count();
}

/// A small program: a title, tools, a cycle, some moves, comments of a few thousand words.
std::string program_text(std::size_t number) {
  std::string text = fmt::format("O{:04} (PART {} OP {})\nG90 G54\n", number % 9999 + 1,
                                 number % 5000, number % 7 * 10);
  for (std::size_t tool = 1; tool <= 4; ++tool) {
    text += fmt::format("T{} M6 (TOOL W{} D{})\nS{} M3\nG0 X{}.{} Y{}.\nG81 Z-{}. R2. F{}\n",
                        (number * 7 + tool * 13) % 60 + 1, (number * 31 + tool) % 4000,
                        number % 20 + 3, number % 90 * 100 + 500, number % 300, tool, number % 200,
                        number % 40, number % 900 + 100);
  }
  return text + fmt::format("M98 P{}\nM30\n", number % 50 + 9000);
}

class Library {
 public:
  Library(std::size_t programs, std::size_t revisions)
      : programs_(programs), revisions_(revisions) {
    std::string pattern = (std::filesystem::temp_directory_path() / "dripline-XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
    open();
    push_texts();
    store_.reset();
    add_revisions();
    open();
  }
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;
  ~Library() {
    store_.reset();
    std::filesystem::remove_all(folder_);
  }
  storage::SqliteStore& store() { return *store_; }
  double megabytes() const {
    return static_cast<double>(std::filesystem::file_size(folder_ / "bench.sqlite")) / 1e6;
  }

 private:
  void open() {
    storage::SqliteStoreOptions options;
    options.file = folder_ / "bench.sqlite";
    auto opened = storage::SqliteStore::open(options, clock_);
    invariant(opened.has_value(), "the store opens");
    store_ = std::move(*opened);
  }

  void push_texts() {
    for (std::size_t i = 0; i < std::min(kTexts, programs_ * revisions_); ++i) {
      storage::Upload upload;
      upload.program = "texts";
      const auto begun = store_->uploads.begin(upload);
      invariant(begun.has_value(), "the upload begins");
      const std::string text = program_text(i);
      const auto stored = store_->uploads.append(begun->id, 0, std::as_bytes(std::span(text)));
      invariant(stored.has_value(), "the piece is stored");
      invariant(store_->uploads.commit(begun->id, std::nullopt).has_value(), "it is committed");
    }
  }

  void add_revisions() {
    auto database = storage::sqlite::Database::open(folder_ / "bench.sqlite");
    invariant(database.has_value(), "the file opens");
    const auto run = [&](const std::string& sql) {
      const auto done = database->execute(sql);
      if (!done) std::fprintf(stderr, "%s\n", done.error().what.c_str());
      invariant(done.has_value(), "the rows are added");
    };
    run("BEGIN");
    run(fmt::format(
        "WITH RECURSIVE n(i) AS (VALUES (1) UNION ALL SELECT i + 1 FROM n WHERE i < {}) "
        "INSERT INTO program (name, part, operation, material) SELECT printf('P%06d.nc', i), "
        "'part-' || (i / 3), 10 * (i % 5), CASE i % 4 WHEN 0 THEN '1.4301' ELSE 'C45' END FROM n",
        programs_));
    run(fmt::format(
        "WITH RECURSIVE r(k) AS (VALUES (1) UNION ALL SELECT k + 1 FROM r WHERE k < {0}) "
        "INSERT INTO revision (program, number, content, sha256, control, comment, author, "
        "created_us, state) SELECT program.id, k, content.id, content.sha256, "
        "CASE program.id % 3 WHEN 0 THEN 'centurion' ELSE 'fanuc' END, 'change ' || (program.id * "
        "k % 1000), 'author' || ((program.id + k) % 40), 1700000000000000 + program.id * 100 + k, "
        "CASE WHEN k = {0} - 1 AND program.id % 2 = 0 THEN 'released' WHEN k = {0} AND program.id "
        "% 50 = 0 THEN 'in_review' ELSE 'draft' END FROM program CROSS JOIN r "
        "JOIN content ON content.id = (program.id * {0} + k) % {1} + 1 WHERE program.name <> "
        "'texts'",
        revisions_, std::min(kTexts, programs_ * revisions_)));
    run("COMMIT");
    run("UPDATE program SET removed_through = 1000000 WHERE name = 'texts'");
  }

  SystemClock clock_;
  std::size_t programs_, revisions_;
  std::filesystem::path folder_;
  std::unique_ptr<storage::SqliteStore> store_;
};

/// Runs a query many times; whether its 95th percentile is within the limit.
template <class Query>
bool measure(const char* name, std::size_t times, Query query) {
  std::vector<double> ms;
  std::size_t found = 0;
  for (std::size_t i = 0; i < times; ++i) {
    const auto begun = std::chrono::steady_clock::now();
    found += query(i);
    ms.push_back(ms_since(begun));
  }
  std::ranges::sort(ms);
  const auto at = [&](double part) {
    return ms[static_cast<std::size_t>(part * static_cast<double>(ms.size() - 1))];
  };
  const bool is_good = at(0.95) <= kMostMs;
  std::printf("%-34s p50 %8.2f ms  p95 %8.2f ms  max %8.2f ms  found %zu%s\n", name, at(0.5),
              at(0.95), ms.back(), found, is_good ? "" : "  OVER 50 ms");
  std::fflush(stdout);
  return is_good;
}

int run(std::size_t programs, std::size_t revisions, std::size_t times) {
  auto begun = std::chrono::steady_clock::now();
  Library library(programs, revisions);
  std::printf("built %zu programs x %zu revisions in %.0f s: %.0f MB\n", programs, revisions,
              ms_since(begun) / 1000, library.megabytes());
  std::fflush(stdout);
  storage::SqliteStore& store = library.store();
  begun = std::chrono::steady_clock::now();
  std::vector<double> parts;
  std::uint64_t documents = 0;
  for (bool is_done = false; !is_done;) {
    const auto part = std::chrono::steady_clock::now();
    const auto progress = store.search.index_some();
    invariant(progress.has_value(), "a part is indexed");
    parts.push_back(ms_since(part));
    documents += progress->documents;
    is_done = progress->is_done;
  }
  std::ranges::sort(parts);
  std::printf("indexed %llu revisions in %.0f s: %.0f MB; a part takes %.1f ms, at most %.1f ms\n",
              static_cast<unsigned long long>(documents), ms_since(begun) / 1000,
              library.megabytes(), parts[parts.size() / 2], parts.back());

  library::ProgramTitles titles(store.programs);
  library::ProgramSearch search(store);
  std::mt19937 random(7);
  const auto any = [&](std::size_t below) { return random() % below; };
  const auto list = [&](const storage::ProgramFilter& filter, storage::Page page) {
    const auto found = store.programs.list(filter, page);
    invariant(found.has_value(), "the listing is there");
    for (const auto& program : *found) (void)titles.of(program.latest.content);
    return found->size();
  };
  const auto find = [&](const std::string& words, const storage::SearchFilter& filter = {}) {
    const auto found = search.search({.words = words, .filter = filter});
    invariant(found.has_value(), "the search is answered");
    return found->hits.size();
  };
  const auto name = [&] { return fmt::format("P{:06}.nc", any(programs) + 1); };
  bool is_good = true;
  const auto check = [&](const char* what, auto query) { is_good &= measure(what, times, query); };
  check("list, first page", [&](auto) { return list({}, {}); });
  check("list, after a name", [&](auto) { return list({.after = name()}, {}); });
  check("list, by offset", [&](auto) { return list({}, {.limit = 100, .offset = any(programs)}); });
  check("list, a part",
        [&](auto) { return list({.part = fmt::format("part-{}", any(programs / 3 + 1))}, {}); });
  check("list, author and state", [&](auto) {
    return list(
        {.author = fmt::format("author{}", any(40)), .state = storage::RevisionState::InReview},
        {});
  });
  check("list, control and material", [&](auto) {
    return list({.material = "1.4301", .control = "centurion", .after = name()}, {});
  });
  check("list, nothing is so", [&](auto) {
    return list({.author = "author1", .state = storage::RevisionState::Withdrawn}, {});
  });
  check("count", [&](auto) { return store.programs.count().value(); });
  check("revisions of a program",
        [&](auto) { return store.programs.revisions(name()).value().size(); });
  check("search, a rare word", [&](auto) { return find(fmt::format("w{}", any(4000))); });
  check("search, a word of all", [&](auto) { return find("g81"); });
  check("search, two words",
        [&](auto) { return find(fmt::format("t{} p{}", any(60) + 1, any(50) + 9000)); });
  check("search, words that never meet", [&](auto) { return find("g81 m98 g90 nothing"); });
  check("search, beginning of a word", [&](auto) { return find("chan*"); });
  check("search, with filters", [&](auto) {
    return find("g81", {.control = "centurion",
                        .author = fmt::format("author{}", any(40)),
                        .state = storage::RevisionState::Released});
  });
  check("search, a rare filter",
        [&](auto) { return find("g81", {.part = fmt::format("part-{}", any(programs / 3 + 1))}); });
  check("search, replaced ones too",
        [&](auto) { return find(fmt::format("g81 w{}", any(4000)), {.with_replaced = true}); });
  return is_good ? 0 : 1;
}

}  // namespace
}  // namespace dripline

int main(int argc, char** argv) {
  const auto number = [&](int at, std::size_t usual) {
    return argc > at ? static_cast<std::size_t>(std::strtoull(argv[at], nullptr, 10)) : usual;
  };
  return dripline::run(number(1, 100'000), number(2, 10), number(3, 200));
}
