#include <gtest/gtest.h>

#include "storage/postgresql/sql_text.hpp"
#include "storage/postgresql/text_bytes.hpp"

namespace dripline::storage::postgresql {
namespace {

struct SqlCase {
  const char* name;
  const char* sql;
  const char* spelled;
  friend void PrintTo(const SqlCase& c, std::ostream* out) { *out << c.name; }
};
class SqlText : public testing::TestWithParam<SqlCase> {};

TEST_P(SqlText, IsSpelledForPostgresql) {
  EXPECT_EQ(spelled(GetParam().sql), GetParam().spelled);
}

INSTANTIATE_TEST_SUITE_P(
    , SqlText,
    testing::Values(SqlCase{"Parameters", "a = ?1 AND b > ?12", "a = $1 AND b > $12"},
                    SqlCase{"TextsStay", "a = '?1 CROSS JOIN ''?2' || ?3",
                            "a = '?1 CROSS JOIN ''?2' || $3"},
                    SqlCase{"NamesStay", "\"?1\" = ?2", "\"?1\" = $2"},
                    SqlCase{"IndexHints", "FROM record INDEXED BY record_of_memory WHERE x",
                            "FROM record WHERE x"},
                    SqlCase{"IndexHintAtTheEnd", "FROM record INDEXED BY i", "FROM record "},
                    SqlCase{"CrossJoins", "a CROSS JOIN b ON a.x = b.x", "a JOIN b ON a.x = b.x"},
                    SqlCase{"AQuestionMarkAlone", "a ? b", "a ? b"},
                    SqlCase{"AnOpenText", "a = '?1", "a = '?1"}),
    [](const auto& i) { return std::string{i.param.name}; });

TEST(SqlOfManyRows, IsMadeOfAPlainInsert) {
  EXPECT_EQ(for_many_rows("INSERT INTO t (a, b) VALUES (?1, ?2)", 2, 3),
            "INSERT INTO t (a, b) VALUES (?1, ?2), (?3, ?4), (?5, ?6)");
  for (const char* other :
       {"INSERT INTO t (a) VALUES (?1) RETURNING id", "INSERT INTO t (a) VALUES (lower(?1))",
        "INSERT INTO t (a) VALUES (?1) ON CONFLICT (a) DO NOTHING", "UPDATE t SET a = ?1",
        "INSERT INTO t SELECT ?1"}) {
    EXPECT_EQ(for_many_rows(other, 1, 3), "") << other;
  }
}

struct BytesCase {
  const char* name;
  std::string text;
  std::string stored;
  friend void PrintTo(const BytesCase& c, std::ostream* out) { *out << c.name; }
};
class TextBytes : public testing::TestWithParam<BytesCase> {};

TEST_P(TextBytes, ComeBackAsTheyWere) {
  EXPECT_EQ(to_stored(GetParam().text), GetParam().stored);
  EXPECT_EQ(from_stored(GetParam().stored), GetParam().text);
}

INSTANTIATE_TEST_SUITE_P(
    , TextBytes,
    testing::Values(BytesCase{"Plain", "N10 G1 X1.5", "N10 G1 X1.5"}, BytesCase{"Empty", "", ""},
                    BytesCase{"Utf8", "Gr\u00f6\u00dfe \u20ac \U0001F600",
                              "Gr\u00f6\u00dfe \u20ac \U0001F600"},
                    BytesCase{"Nul", std::string("a\0b", 3), "a\uF700b"},
                    BytesCase{"Latin1", "Gr\xF6", "Gr\uF7F6"},
                    BytesCase{"CutOff", "\xE2\x82", "\uF7E2\uF782"},
                    BytesCase{"TheSubstitutesThemselves", "\uF7F6", "\uF7EF\uF79F\uF7B6"},
                    BytesCase{"TheirNeighbours", "\uF6FF\uF800", "\uF6FF\uF800"}),
    [](const auto& i) { return std::string{i.param.name}; });

}  // namespace
}  // namespace dripline::storage::postgresql
