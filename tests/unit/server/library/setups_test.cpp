#include "server/library/control_catalog.hpp"
#include "tests/unit/server/api/server_fixture.hpp"

namespace dripline::server_test {
namespace {

class SetupsTest : public ServerTest {
 protected:
  Result<library::SavedSetup> save(const std::string& text, const std::string& comment = "") {
    return setups_->save({"mill-3", "tnc155", text, comment}, "cam");
  }
};

TEST_F(SetupsTest, AreCheckedByTheirControlBeforeTheyAreKept) {
  const auto refused = save("wrong = 1");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().what, "line 1: wrong is nothing a tnc155 knows");
  EXPECT_EQ(setups_->find("mill-3", std::nullopt).error().code, Errc::NotFound);
  EXPECT_TRUE(audit_->entries({})->empty());
}

TEST_F(SetupsTest, ReportWhetherTheTextChanged) {
  EXPECT_FALSE(save("a = 1")->is_unchanged);
  EXPECT_TRUE(save("a = 1")->is_unchanged);
  EXPECT_FALSE(save("a = 2")->is_unchanged);
  EXPECT_EQ(audit_->entries({})->size(), 2u);
  EXPECT_EQ(audit_->entries({})->at(0).action, "setup.save");
}

/// CEN-213.
TEST_F(SetupsTest, AreRefusedInTheWordsOfTheirControlToo) {
  const auto refused = setups_->save({"lathe-1", "centurion", "wrong = 1", ""}, "cam");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().what,
            "line 1: wrong is nothing a centurion knows (centurion error 311: parameter file not "
            "valid)");
}

TEST_F(SetupsTest, HaveLimits) {
  EXPECT_EQ(save("a = 1", std::string(1025, 'x')).error().code, Errc::LimitExceeded);
  EXPECT_EQ(save(std::string(storage::kMaxSetup + 1, '#')).error().code, Errc::LimitExceeded);
}

TEST(DialectCatalog, ReadsSetupsAsTheControlDoes) {
  const library::DialectCatalog catalog;
  EXPECT_TRUE(catalog.check_setup("centurion", "[[tool]]\nnumber = 3\nradius = 0.03\ntip = 3\n"));
  const auto foreign = catalog.check_setup("centurion", "answers = [\"1\"]\n");
  ASSERT_FALSE(foreign) << "what describes the simulated machine stays with its gateway";
  EXPECT_NE(foreign.error().what.find("answers"), std::string::npos) << foreign.error().what;
  const auto option = catalog.check_setup("centurion", "[control]\nno_such_option = 1\n");
  ASSERT_FALSE(option);
  EXPECT_NE(option.error().what.find("no_such_option"), std::string::npos) << option.error().what;
  EXPECT_EQ(catalog.check_setup("fagor", "").error().code, Errc::NotFound);
}

}  // namespace
}  // namespace dripline::server_test
