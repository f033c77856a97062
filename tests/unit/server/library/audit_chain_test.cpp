#include "server/library/audit_chain.hpp"

#include <random>

#include "storage/sqlite/query.hpp"
#include "tests/unit/server/api/server_fixture.hpp"

namespace dripline::server_test {
namespace {

using library::AuditChain;
using storage::RunState;
namespace sqlite = storage::sqlite;

class AuditChainTest : public ServerTest {
 protected:
  AuditChainTest() : revision_(push("P", "M2\n")) { add_machine("lathe-1"); }

  void add_entries(int count) {
    for (int i = 0; i < count; ++i) {
      clock_.advance(std::chrono::seconds(1));
      audit_->write({.who = {"anna", "token", "192.0.2.1"},
                     .action = "run.hold",
                     .subject = "r1",
                     .detail = "hold 0"});
    }
  }
  void end_run(const std::string& id, RunState state, const std::string& reason) {
    Run run = run_of(revision_, id);
    run.gateway_setup = std::string(64, 'a');
    ASSERT_TRUE(store_->runs.create(run));
    ASSERT_TRUE(store_->runs.add_call(id, {"1", "P", 1, revision_.content}));
    ASSERT_TRUE(store_->runs.add_call(id, {"2", "P", 1, revision_.content}));
    ASSERT_TRUE(store_->runs.set_state(id, state, reason));
  }
  AuditChain::Verification verify() {
    const auto state = chain_->verify();
    EXPECT_TRUE(state) << state.error().what;
    return state ? state->verification.value() : AuditChain::Verification{};
  }
  /// A whole trail with three checkpoints, of which the last has all of it.
  void make_trail() {
    for (const char* run : {"r1", "r2", "r3"}) {
      add_entries(5);
      end_run(run, RunState::Aborted, "stopped by anna");
      end_run(std::string(run) + "b", RunState::Completed, "");
      add_entries(3);
      EXPECT_FALSE(verify().fault);
    }
  }

  storage::Revision revision_;
};

TEST_F(AuditChainTest, HoldsEntriesAndTheEndsOfRuns) {
  make_trail();
  const auto entries = audit_->entries({.limit = 100}).value();
  EXPECT_EQ(std::ranges::count(entries, "run.end", &storage::AuditEntry::action), 6);
  const auto end = std::ranges::find(entries, "r3b", &storage::AuditEntry::subject);
  EXPECT_TRUE(end->detail.starts_with("completed on lathe-1: P revision 1, 0 blocks executed; run"))
      << end->detail;
  EXPECT_EQ(chain_->state().checkpoint->entry, entries.size());
  EXPECT_EQ(chain_->state().checkpoint->number, 3u);
  reopen();
  EXPECT_FALSE(verify().fault);
  EXPECT_EQ(chain_->state().checkpoint->number, 3u) << "nothing new to sign";
}

TEST_F(AuditChainTest, IsSignedAMinuteAfterTheLastTime) {
  add_entries(2);
  const auto looked = [&](std::chrono::seconds later) {
    clock_.advance(later);
    EXPECT_TRUE(chain_->look());
    return chain_->state().checkpoint ? chain_->state().checkpoint->entry : 0;
  };
  const std::uint64_t first = looked(std::chrono::seconds(0));
  EXPECT_EQ(first, chain_->state().verification->entries) << "at the server's start";
  add_entries(1);
  EXPECT_EQ(looked(std::chrono::seconds(30)), first);
  EXPECT_EQ(looked(std::chrono::seconds(30)), first + 1);
  EXPECT_EQ(looked(std::chrono::seconds(60)), first + 1) << "nothing new";
  EXPECT_FALSE(chain_->state().verification->fault);
}

TEST_F(AuditChainTest, WhatWasChangedSinceIsNotSigned) {
  add_entries(2);
  ASSERT_TRUE(chain_->look());
  const auto before = chain_->state().checkpoint->entry;
  add_entries(3);
  auto database = sqlite::Database::open(folder_.path() / "store.sqlite");
  ASSERT_TRUE(
      database->execute(fmt::format("UPDATE audit SET who = 'x' WHERE id = {}", before + 2)));
  clock_.advance(std::chrono::minutes(2));
  ASSERT_TRUE(chain_->look());
  EXPECT_EQ(chain_->state().verification->fault->entry, before + 2);
  EXPECT_EQ(chain_->finding().level, library::Health::Level::Degraded);
  EXPECT_EQ(chain_->state().checkpoint->entry, before);
  ASSERT_TRUE(chain_->verify());
  EXPECT_EQ(chain_->state().checkpoint->entry, before);
}

TEST_F(AuditChainTest, AnExportedTrailIsVerifiedWithoutTheServer) {
  make_trail();
  add_entries(1);
  audit::TrailReader reader;
  const auto next = chain_->exported();
  for (;;) {
    const auto piece = next();
    ASSERT_TRUE(piece) << piece.error().what;
    if (!*piece) break;
    const auto read = reader.feed(**piece);
    ASSERT_TRUE(read) << read.error().what;
  }
  const auto over = reader.finish();
  ASSERT_TRUE(over) << over.error().what;
  EXPECT_FALSE(reader.verifier()->first_fault());
  EXPECT_EQ(reader.verifier()->checkpoint()->number, 3u);
  EXPECT_EQ(reader.header()->key, chain_->header().key);
}

// -- tampering ------------------------------------------------------------------------------------

/// Somebody with an editor for databases, and without the key.
class Tamperer {
 public:
  Tamperer(const std::filesystem::path& file, unsigned seed) : random_(seed) {
    auto opened = sqlite::Database::open(file);
    EXPECT_TRUE(opened);
    database_ = std::make_unique<sqlite::Database>(*std::move(opened));
    must(
        "PRAGMA foreign_keys = OFF; PRAGMA ignore_check_constraints = ON; "
        "PRAGMA synchronous = OFF");
    for (const std::string table : {"audit", "run", "run_call", "audit_checkpoint"})
      must("CREATE TEMP TABLE kept_" + table + " AS SELECT * FROM main." + table);
    last_ = number("SELECT max(id) FROM audit");
  }
  void restore() {
    must("BEGIN");
    for (const std::string table : {"audit", "run", "run_call", "audit_checkpoint"})
      must("DELETE FROM main." + table + "; INSERT INTO main." + table + " SELECT * FROM kept_" +
           table);
    must("COMMIT");
  }

  struct Tampering {
    std::string what;
    std::uint64_t place = 0;  ///< the first entry that is affected; 0: it depends
  };
  /// nullopt: the schema did not let it happen, and nothing was changed.
  std::optional<Tampering> tamper() {
    using Way = std::optional<Tampering> (Tamperer::*)();
    static constexpr std::array<Way, 11> kWays{
        &Tamperer::change_entry, &Tamperer::change_entry,     &Tamperer::change_checkpoint,
        &Tamperer::change_run,   &Tamperer::remove_entry,     &Tamperer::insert_entry,
        &Tamperer::change_calls, &Tamperer::swap_entries,     &Tamperer::cut_tail,
        &Tamperer::change_runs,  &Tamperer::remove_checkpoint};
    return (this->*kWays.at(below(kWays.size())))();
  }

 private:
  std::uint64_t below(std::uint64_t limit) { return random_() % limit; }
  void must(const std::string& sql) {
    const auto done = database_->execute(sql);
    ASSERT_TRUE(done) << done.error().what;
  }
  std::uint64_t number(const std::string& sql) {
    return static_cast<std::uint64_t>(database_->integer(sql).value_or(0));
  }
  std::optional<Tampering> done(const Result<void>& result, Tampering tampering) {
    if (result) return tampering;
    if (database_->in_transaction()) must("ROLLBACK");
    return std::nullopt;
  }

  /// Another value of this column, in the row of this SQL condition.
  Result<void> change(const std::string& table, const std::string& column,
                      const std::string& where) {
    const std::string from = " FROM " + table + " WHERE " + where;
    const std::string type = database_->text("SELECT typeof(" + column + ")" + from).value();
    const std::string update = "UPDATE " + table + " SET " + column + " = ";
    if (type == "integer") {
      const auto bit = std::int64_t{1} << below(40);
      const auto value = database_->integer("SELECT " + column + from).value() ^ bit;
      return sqlite::run(*database_, update + "?1 WHERE " + where, value);
    }
    if (type == "null") {
      const bool is_text = column == "executed_content";
      return database_->execute(update + (is_text ? "'x'" : "1") + " WHERE " + where);
    }
    std::string bytes =
        sqlite::first_row(*database_, "SELECT CAST(" + column + " AS BLOB)" + from,
                          [](const sqlite::Statement& row) {
                            const auto blob = row.blob(0);
                            return std::string(reinterpret_cast<const char*>(blob.data()),
                                               blob.size());
                          })
            .value()
            .value();
    if (bytes.empty()) bytes += '\0';
    bytes[below(bytes.size())] ^= static_cast<char>(1 + below(255));
    const std::string value = type == "text" ? "CAST(?1 AS TEXT)" : "?1";
    return sqlite::run(*database_, update + value + " WHERE " + where,
                       std::as_bytes(std::span<const char>(bytes)));
  }

  template <std::size_t kSize>
  const char* one_of(const std::array<const char*, kSize>& names) {
    return names.at(below(kSize));
  }

  std::optional<Tampering> change_entry() {
    static constexpr std::array kColumns{"id",     "time_us", "who",     "action",    "subject",
                                         "detail", "chain",   "address", "credential"};
    const std::string column = one_of(kColumns);
    const std::uint64_t id = 1 + below(last_);
    return done(change("audit", column, fmt::format("id = {}", id)),
                {fmt::format("{} of entry {}", column, id), column == "id" ? 0 : id});
  }
  std::optional<Tampering> change_checkpoint() {
    static constexpr std::array kColumns{"number", "entry", "time_us", "chain", "signature"};
    const std::string column = one_of(kColumns);
    const std::uint64_t checkpoint = 1 + below(3);
    return done(change("audit_checkpoint", column, fmt::format("number = {}", checkpoint)),
                {fmt::format("{} of checkpoint {}", column, checkpoint), 0});
  }
  std::uint64_t end_of(std::uint64_t run) {
    return number(
        fmt::format("SELECT audit.id FROM audit JOIN run ON action = 'run.end' AND "
                    "subject = run.id WHERE run.number = {}",
                    run));
  }
  std::optional<Tampering> change_run() {
    static constexpr std::array kColumns{"number",
                                         "id",
                                         "machine",
                                         "program",
                                         "revision",
                                         "control",
                                         "state",
                                         "sent",
                                         "accepted",
                                         "executed",
                                         "line",
                                         "sequence",
                                         "reason",
                                         "author",
                                         "executed_content",
                                         "content_verified",
                                         "sha256",
                                         "created_us",
                                         "ended_us",
                                         "started_us",
                                         "setup",
                                         "allowed_as",
                                         "approval",
                                         "gateway_setup"};
    const std::string column = one_of(kColumns);
    const std::uint64_t run = 1 + below(6), end = end_of(run);
    return done(change("run", column, fmt::format("number = {}", run)),
                {fmt::format("{} of run {}", column, run), end});
  }
  std::optional<Tampering> change_calls() {
    static constexpr std::array kColumns{"run", "name", "program", "revision", "sha256"};
    const std::uint64_t run = 1 + below(6), end = end_of(run);
    const std::string row = fmt::format("run = {} AND name = '{}'", run, 1 + below(2));
    if (below(2) == 0) {
      must("DELETE FROM run_call WHERE " + row);
      return Tampering{"call removed: " + row, end};
    }
    const std::string column = one_of(kColumns);
    // A call may have been moved to an earlier run: that one's digest is wrong first.
    return done(change("run_call", column, row),
                {column + " of call " + row, column == "run" ? 0 : end});
  }
  /// With or without the numbers of the following being moved up.
  std::optional<Tampering> remove_entry() {
    const std::uint64_t id = 1 + below(last_);
    must(fmt::format("DELETE FROM audit WHERE id = {}", id));
    if (below(2) == 0)
      must(
          fmt::format("UPDATE audit SET id = -id WHERE id > {}; "
                      "UPDATE audit SET id = -id - 1 WHERE id < 0",
                      id));
    return Tampering{fmt::format("entry {} removed", id), id};
  }
  std::optional<Tampering> insert_entry() {
    const std::uint64_t id = 1 + below(last_), from = 1 + below(last_);
    const char* const columns = "time_us, who, action, subject, detail, credential, address, chain";
    must(
        fmt::format("UPDATE audit SET id = -id WHERE id >= {0}; "
                    "UPDATE audit SET id = 1 - id WHERE id < 0; "
                    "INSERT INTO audit (id, {1}) SELECT {0}, {1} FROM kept_audit WHERE id = {2}",
                    id, columns, from));
    return Tampering{fmt::format("entry {} inserted at {}", from, id), from == id ? id + 1 : id};
  }
  std::optional<Tampering> swap_entries() {
    const std::uint64_t one = 1 + below(last_), other = 1 + below(last_);
    if (one == other) return std::nullopt;
    must(
        fmt::format("UPDATE audit SET id = 0 WHERE id = {0}; UPDATE audit SET id = {0} WHERE id = "
                    "{1}; UPDATE audit SET id = {1} WHERE id = 0",
                    one, other));
    return Tampering{fmt::format("entries {} and {} swapped", one, other), std::min(one, other)};
  }
  std::optional<Tampering> cut_tail() {
    const std::uint64_t after = below(last_);
    must(fmt::format("DELETE FROM audit WHERE id > {}", after));
    return Tampering{fmt::format("cut off after {}", after), after + 1};
  }
  std::optional<Tampering> change_runs() {
    const std::uint64_t run = 1 + below(6), end = end_of(run);
    if (below(2) == 0) {
      must(fmt::format("DELETE FROM run WHERE number = {}", run));
      return Tampering{fmt::format("run {} removed", run), end};
    }
    must(
        fmt::format("CREATE TEMP TABLE another AS SELECT * FROM kept_run WHERE number = {}; "
                    "UPDATE another SET number = 99, id = 'r99'; "
                    "INSERT INTO run SELECT * FROM another; DROP TABLE another",
                    run));
    return Tampering{"a run inserted", last_ + 1};
  }
  /// Not the last: nothing in the database shows that it was there.
  std::optional<Tampering> remove_checkpoint() {
    const std::uint64_t checkpoint = 1 + below(2);
    must(fmt::format("DELETE FROM audit_checkpoint WHERE number = {}", checkpoint));
    return Tampering{fmt::format("checkpoint {} removed", checkpoint), 0};
  }

  std::mt19937 random_;
  std::unique_ptr<sqlite::Database> database_;
  std::uint64_t last_ = 0;
};

TEST_F(AuditChainTest, FindsAThousandTamperingsOfAThousand) {
  make_trail();
  Tamperer tamperer(folder_.path() / "store.sqlite", 17);
  int found = 0;
  for (int made = 0; made < 1000 && !HasFailure();) {
    const auto tampering = tamperer.tamper();
    if (!tampering) continue;
    ++made;
    const auto fault = verify().fault;
    if (fault) ++found;
    ASSERT_TRUE(fault) << tampering->what;
    if (tampering->place != 0) {
      EXPECT_EQ(fault->entry, tampering->place) << tampering->what << ": " << fault->what;
    }
    tamperer.restore();
    ASSERT_FALSE(verify().fault) << "after " << tampering->what;
  }
  EXPECT_EQ(found, 1000);
}

/// Anybody can compute the digests again; the checkpoints are signed.
TEST_F(AuditChainTest, FindsAChainThatWasComputedAgain) {
  make_trail();
  const auto entries = store_->audit.chained(0, 1000).value();
  auto database = sqlite::Database::open(folder_.path() / "store.sqlite");
  for (const std::uint64_t from : {entries.size(), std::uint64_t{7}, std::uint64_t{1}}) {
    Digest digest =
        from == 1 ? audit::chain_begin(chain_->header().database) : entries.at(from - 2).digest;
    for (std::uint64_t n = from; n <= entries.size(); ++n) {
      auto entry = entries.at(n - 1).entry;
      if (n == from) entry.who = "bert";
      digest = audit::chain_next(digest, audit::line_of(entry));
      ASSERT_TRUE(sqlite::run(*database, "UPDATE audit SET who = ?2, chain = ?3 WHERE id = ?1", n,
                              entry.who, std::span<const std::byte>(digest.bytes)));
    }
    const auto fault = verify().fault;
    ASSERT_TRUE(fault);
    EXPECT_LE(fault->entry, from);
    EXPECT_NE(fault->what.find("computed again"), std::string::npos) << fault->what;
  }
}

}  // namespace
}  // namespace dripline::server_test
