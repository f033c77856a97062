#include "tests/unit/storage/store_fixture.hpp"

namespace dripline::storage {
namespace {

std::set<std::string> words(std::string_view text, WordsOf kind = WordsOf::Card) {
  std::set<std::string> found;
  add_search_words(text, kind, found);
  return found;
}
using Words = std::set<std::string>;

TEST(SearchWords, AreTheWordsOfBlocks) {
  EXPECT_EQ(words("G01X10.50Y-3.M06(Rough POCKET)T0012"),
            (Words{"g1", "x10.5", "y-3", "m6", "rough", "pocket", "t12"}));
  EXPECT_EQ(words("O0200 M98P0300 S1,5"), (Words{"o200", "m98", "p300", "s1.5"}));
  EXPECT_EQ(words("shaft-200_op 10 .5"), (Words{"shaft", "200", "op", "10", "0.5"}));
  EXPECT_EQ(words("Ä Größe"), (Words{"ä", "größe"}));
  EXPECT_EQ(words("$now * ' \" AND("), (Words{"now", "and"}));
}

TEST(SearchWords, OfATextAreWithoutCoordinatesAndLineNumbers) {
  EXPECT_EQ(words("12 L X+10,5 Y-3 R0 F100 M3\nN20 G1 X5. T3\n20 CALL PGM 12", WordsOf::Text),
            (Words{"f100", "m3", "g1", "t3", "call", "pgm", "12"}));
}

TEST(SearchWords, OfACommentAreAllOfThem) {
  EXPECT_EQ(words("N1 G1 X5. (PART A4711 OP 10) Y3.\nX1 ; JIG C12\n30 Z1", WordsOf::Text),
            (Words{"g1", "part", "a4711", "op", "10", "jig", "c12"}));
  EXPECT_EQ(words("(NO END A1\nX5. A2.\n", WordsOf::Text), (Words{"no", "end", "a1"}))
      << "a comment ends with its line";
}

TEST(SearchWords, OfAQuery) {
  EXPECT_EQ(parse_search("T012 rou*  t12").value(),
            (std::vector<SearchTerm>{{"t12", false}, {"rou", true}}));
  EXPECT_EQ(parse_search(" ()* ").error().code, Errc::Syntax);
  EXPECT_EQ(parse_search("ro*").error().code, Errc::Syntax);
  EXPECT_EQ(parse_search("x10*").error().code, Errc::Syntax);
  std::string many;
  for (int i = 0; i < 20; ++i)
    many += "w" + std::string(static_cast<std::size_t>(i + 1), 'x') + " ";
  EXPECT_EQ(parse_search(many).error().code, Errc::LimitExceeded);
}

TEST(SearchWords, FindTheLineWithMostOfThem) {
  const auto terms = parse_search("t12 rough*").value();
  const auto found = find_line("O1\nT12\n(ROUGHING) T12 M6\r\nT12 (ROUGH)\n", terms);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->line, 3u);
  EXPECT_EQ(found->text, "(ROUGHING) T12 M6");
  EXPECT_FALSE(find_line("G1\n", terms));
  EXPECT_LE(find_line("T12 " + std::string(500, 'x'), terms)->text.size(), kMaxFoundText);
}

class SearchTest : public ContractTest {
 protected:
  std::uint64_t index() {
    std::uint64_t documents = 0;
    for (;;) {
      const auto progress = store_->search.index_some();
      EXPECT_TRUE(progress) << progress.error().what;
      if (!progress) return documents;
      documents += progress->documents;
      if (progress->is_done) return documents;
    }
  }
  std::string found(const std::string& query, const SearchFilter& filter = {},
                    std::uint64_t before = 0, std::uint64_t limit = 100) {
    const auto hits = store_->search.search(parse_search(query).value(), filter, before, limit);
    if (!hits) return hits.error().what;
    std::string text;
    for (const auto& hit : *hits)
      text += fmt::format("{}@{} ", hit.revision.program, hit.revision.number);
    return text;
  }
  void describe(const std::string& program, const FieldChange& change) {
    ASSERT_TRUE(store_->programs.describe(
        {.program = program, .revision = {}, .change = change, .who = {"anna", "", ""}}));
  }
};

TEST_P(SearchTest, FindsWordsOfTextNamesFieldsAndComments) {
  ASSERT_TRUE(push("O0200", "O0200 (SHAFT)\nT12 M6\nG1 X10.\n"));
  ASSERT_TRUE(push("O0300", "O0300 (FLANGE)\nT12 M6\n"));
  EXPECT_EQ(store_->search.count_due(), 2u);
  EXPECT_EQ(found("t12"), "") << "not yet";
  EXPECT_EQ(index(), 2u);
  EXPECT_EQ(store_->search.count_due(), 0u);
  EXPECT_EQ(found("t12"), "O0300@1 O0200@1 ");
  EXPECT_EQ(found("T12 shaft"), "O0200@1 ");
  EXPECT_EQ(found("sha*"), "O0200@1 ");
  EXPECT_EQ(found("t12 nothing"), "");
  EXPECT_EQ(found("o200"), "O0200@1 ");
  EXPECT_EQ(found("x10"), "") << "a coordinate";
  EXPECT_EQ(found("comment"), "O0300@1 O0200@1 ");
  describe("O0200", {.part = "4711-12", .material = "steel"});
  index();
  EXPECT_EQ(found("4711 t12"), "O0200@1 ") << "words of both together";
  describe("O0200", {.material = "brass"});
  index();
  EXPECT_EQ(found("steel"), "");
  EXPECT_EQ(found("brass"), "O0200@1 ");
}

TEST_P(SearchTest, FindsWhatBeginsWithSomeLettersAmongFewWordsAndAmongMany) {
  ASSERT_TRUE(push("p.nc", "(ROUGH)\n"));
  ASSERT_TRUE(push("q.nc", "(ROUGHING GR\xC3\x96SSE)\n"));
  ASSERT_TRUE(push("r.nc", "(ROTOR)\n"));
  index();
  EXPECT_EQ(found("rou*"), "q.nc@1 p.nc@1 ");
  EXPECT_EQ(found("rough*"), "q.nc@1 p.nc@1 ");
  EXPECT_EQ(found("roughi* gr\xC3\xB6*"), "q.nc@1 ");
  EXPECT_EQ(found("rum*"), "");
  std::string text;
  for (char a = 'A'; a <= 'Z'; ++a)
    for (const char* b : {"A", "B", "C", "D"}) text += std::string("(ROU") + a + b + ")\n";
  ASSERT_TRUE(push("s.nc", text));
  index();
  EXPECT_EQ(found("rou*"), "s.nc@1 q.nc@1 p.nc@1 ") << "over a hundred words";
  EXPECT_EQ(found("rouz*"), "s.nc@1 ");
}

TEST_P(SearchTest, FindsWhatIsInForceAndOnRequestWhatWasReplaced) {
  ASSERT_TRUE(push("p.nc", "(ONE)\nT1\n"));
  index();
  ASSERT_TRUE(push("p.nc", "(TWO)\nT1\n"));
  index();
  EXPECT_EQ(found("one"), "");
  EXPECT_EQ(found("t1"), "p.nc@2 ");
  EXPECT_EQ(found("one", {.with_replaced = true}), "p.nc@1 ");
  damage("UPDATE revision SET state = 'released' WHERE number = 1");
  index();
  EXPECT_EQ(found("t1"), "p.nc@1 p.nc@2 ") << "what machines run is found too";
  ASSERT_TRUE(store_->programs.rename({.from = "p.nc", .to = "q.nc", .who = {}}));
  index();
  EXPECT_EQ(found("q"), "q.nc@1 q.nc@2 ");
  EXPECT_EQ(found("p"), "");
  ASSERT_TRUE(store_->programs.remove("q.nc"));
  EXPECT_EQ(found("t1"), "") << "at once";
  index();
  EXPECT_EQ(query("SELECT count(*) FROM search_document"), 0);
}

TEST_P(SearchTest, Filters) {
  ASSERT_TRUE(push("a", "T1\n"));
  ASSERT_TRUE(push("b", "T1\n(B)\n"));
  damage(
      "INSERT INTO machine_group VALUES ('mills'); INSERT INTO machine_group_member VALUES "
      "('mills', 'mill-1'); UPDATE revision SET state = 'approved', author = 'bert' WHERE "
      "program = 2");
  describe("a", {.part = "1", .machine_group = "mills"});
  describe("b", {.part = "2", .machine_group = kAllMachines});
  index();
  EXPECT_EQ(found("t1", {.part = "1"}), "a@1 ");
  EXPECT_EQ(found("t1", {.author = "bert"}), "b@1 ");
  EXPECT_EQ(found("t1", {.control = "centurion"}), "b@1 a@1 ");
  EXPECT_EQ(found("t1", {.control = "fanuc"}), "");
  EXPECT_EQ(found("t1", {.state = RevisionState::Approved}), "b@1 ");
  EXPECT_EQ(found("t1", {.machine = "mill-1"}), "b@1 a@1 ");
  EXPECT_EQ(found("t1", {.machine = "lathe-1"}), "b@1 ");
  EXPECT_EQ(found("t1", {.machine_group = "mills"}), "a@1 ");
}

TEST_P(SearchTest, Pages) {
  for (int i = 0; i < 5; ++i)
    ASSERT_TRUE(push(fmt::format("p{}", i), fmt::format("T1\n({})\n", i)));
  index();
  EXPECT_EQ(found("t1", {}, 0, 2), "p4@1 p3@1 ");
  const auto page = store_->search.search(parse_search("t1").value(), {}, 0, 2).value();
  EXPECT_EQ(found("t1", {}, page.back().document, 2), "p2@1 p1@1 ");
}

TEST_P(SearchTest, IndexesTheBeginningOfALongText) {
  std::string text = "(BEGINNING)\n";
  while (text.size() < SearchStore::kIndexedBytes) text += "G1 X1.234 Y5.678\n";
  text += "(ENDING)\n";
  ASSERT_TRUE(push("long", text, 1 << 20));
  EXPECT_EQ(index(), 1u);
  EXPECT_EQ(found("beginning"), "long@1 ");
  EXPECT_EQ(found("ending"), "");
  EXPECT_EQ(query("SELECT text FROM search_document"),
            static_cast<std::int64_t>(SearchStore::kIndexedBytes));
}

TEST_P(SearchTest, WorksInPartsAndContinuesAfterARestart) {
  std::string text;
  while (text.size() < SearchStore::kIndexedBytes) text += "G1 X1.234 Y5.678\n";
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(push("long", fmt::format("(T7{})\n", i) + text, 1 << 20));
  ASSERT_TRUE(push("next", "T1\n"));
  const auto first = store_->search.index_some();
  EXPECT_EQ(first->documents, 1u) << "one long text at a time";
  EXPECT_FALSE(first->is_done);
  reopen();
  EXPECT_EQ(store_->search.count_due(), 2u);
  EXPECT_EQ(index(), 3u) << "the one that was made is not made again";
  EXPECT_EQ(found("t72"), "long@3 ");
  EXPECT_EQ(found("t1"), "next@1 ");
}

TEST_P(SearchTest, ADamagedTextIsFoundByItsFieldsAlone) {
  ASSERT_TRUE(push("p.nc", "T1\n"));
  damage("UPDATE chunk SET data = x'00'");
  index();
  EXPECT_EQ(found("t1"), "");
  EXPECT_EQ(found("cam"), "p.nc@1 ");
}

TEST_P(SearchTest, WordsOfTheIndexsOwnLanguageAreOnlyWords) {
  ASSERT_TRUE(push("p.nc", "(NEAR OR NOT)\n"));
  index();
  EXPECT_EQ(found("NEAR"), "p.nc@1 ");
  EXPECT_EQ(found("not or"), "p.nc@1 ");
  EXPECT_EQ(found("words:near\" OR \"t1"), "") << "a word `words` is not there";
}

ON_BOTH_ENGINES(SearchTest);

}  // namespace
}  // namespace dripline::storage
