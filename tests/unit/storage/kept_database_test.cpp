#include <fstream>
#include <sstream>

#include "storage/postgresql/database.hpp"
#include "storage/postgresql/migration.hpp"
#include "tests/unit/storage/store_fixture.hpp"

namespace dripline::storage {
namespace {

/// Everything that the schema's files make, in words: columns, constraints, indexes, functions,
/// triggers and views.
constexpr const char* kSchema = R"(
  SELECT string_agg(line, E'\n' ORDER BY line) FROM (
    SELECT format('%s.%s %s %s %s %s', table_name, column_name, ordinal_position, data_type,
                  collation_name, column_default) || is_nullable || is_identity AS line
      FROM information_schema.columns WHERE table_schema = 'public'
    UNION ALL SELECT conrelid::regclass::text || ' ' || conname || ' ' || pg_get_constraintdef(c.oid)
      FROM pg_constraint AS c WHERE connamespace = 'public'::regnamespace
    UNION ALL SELECT indexdef FROM pg_indexes WHERE schemaname = 'public'
    UNION ALL SELECT proname || pg_get_function_arguments(oid) || pg_get_function_result(oid) || prosrc
                     || provolatile::text FROM pg_proc WHERE pronamespace = 'public'::regnamespace
    UNION ALL SELECT pg_get_triggerdef(t.oid) || tgenabled::text FROM pg_trigger AS t WHERE NOT tgisinternal
    UNION ALL SELECT viewname || definition FROM pg_views WHERE schemaname = 'public'
    UNION ALL SELECT attrelid::regclass::text || '.' || attname || ' ' || attstorage::text FROM pg_attribute
      JOIN pg_class ON pg_class.oid = attrelid AND relkind = 'r'
      WHERE relnamespace = 'public'::regnamespace AND attnum > 0) AS lines)";

/// Opens the kept dump of an older version (tests/golden/storage/postgresql) as the server would.
class KeptDatabase : public StoreTest, public testing::WithParamInterface<const char*> {
 protected:
  KeptDatabase() : StoreTest(sql::Engine::Postgresql) {}
  void SetUp() override {
    new_schema_ = schema_text();
    store_.reset();
    database_ = test::TestDatabase::make_empty();
    std::stringstream sql;
    sql << std::ifstream(std::string("tests/golden/storage/postgresql/") + GetParam()).rdbuf();
    ASSERT_FALSE(sql.str().empty());
    change(sql.str());
  }
  std::string schema_text() {
    auto database = postgresql::Database::connect({.url = database_->url()});
    const auto text = database->text(kSchema);
    EXPECT_TRUE(text) << text.error().what;
    return text.value_or("no schema");
  }
  std::string new_schema_;
};

TEST_P(KeptDatabase, BecomesTheSchemaOfANewDatabase) {
  EXPECT_GT(new_schema_.size(), 50'000u);
  reopen();
  EXPECT_EQ(schema_text(), new_schema_) << "a released migration was edited?";
}

TEST_P(KeptDatabase, KeepsEverythingInItAndContinues) {
  reopen();
  const auto run = store_->runs.find("r1");
  ASSERT_TRUE(run) << run.error().what;
  EXPECT_EQ(run->state, RunState::Completed);
  EXPECT_EQ(pull(run->content), "G00 X1.\nM30\n");
  const auto records = store_->records.of_run("r1", "", {});
  ASSERT_EQ(records->size(), 3u);
  EXPECT_EQ(records->at(1).text, "X2");
  EXPECT_EQ(store_->audit.list({})->back().action, "push");
  EXPECT_EQ(store_->records.store(make_batch(4, 6)), 6u);
  EXPECT_EQ(push("gone.nc", "M2\n")->number, 2u);
}

INSTANTIATE_TEST_SUITE_P(, KeptDatabase,
                         testing::Values("v5.sql", "v6.sql", "v7.sql", "v8.sql", "v9.sql",
                                         "v10.sql", "v11.sql", "v12.sql", "v13.sql"),
                         [](const auto& i) {
                           return std::string(i.param).substr(0, std::string(i.param).find('.'));
                         });

/// The newest version has a dump: without one nothing would guard its files.
TEST(KeptDatabases, OfEveryVersion) {
  const auto newest = postgresql::schema().size();
  EXPECT_TRUE(
      std::filesystem::exists(fmt::format("tests/golden/storage/postgresql/v{}.sql", newest)));
}

}  // namespace
}  // namespace dripline::storage
