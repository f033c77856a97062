// A hot folder that does not answer keeps no library: it is handed over all the same.
#include "tests/support/hung_folder.hpp"
#include "tests/integration/standby/standby_fixture.hpp"

namespace dripline::integration {
namespace {

class HungFolderHandOver : public TwoServersTest {};

TEST_F(HungFolderHandOver, ADrainIsTrueAlthoughAHotFolderDoesNotAnswer) {
  if (!test_support::kCanPreload) GTEST_SKIP() << "a sanitizer must be loaded first";
  const test_support::HungFolder hung(DRIPLINE_HUNG_FOLDER);
  begin({hung.argument()});
  hung.post("O0200.nc");
  const auto revisions = [&](int server) {
    const auto found = shop_->rest(server).get("/api/v1/programs/O0200").json();
    return found.is_object() ? found.value("revisions", nlohmann::json::array()).size() : 0;
  };
  ASSERT_TRUE(test_support::eventually([&] { return revisions(0) == 1; }));
  const auto drained =
      test_support::run_to_end({program_path("dnc"), "--state", shop_->state(0), "server", "drain"},
                               shop_->folder() / "dnc.out");
  EXPECT_EQ(drained.status, 0) << drained.output;
  EXPECT_NE(drained.output.find("handed over to dncd "), std::string::npos) << drained.output;
  ASSERT_TRUE(shop_->wait_active(1, std::chrono::seconds(40))) << shop_->log(0) << shop_->log(1);
  EXPECT_EQ(shop_->server(0).wait(), 1) << "a service manager starts it again, to stand by";
  EXPECT_NE(shop_->log(0).find("hot folder cam does not answer"), std::string::npos)
      << shop_->log(0);
  hung.answer();
  EXPECT_TRUE(test_support::eventually(
      [&] { return std::filesystem::exists(hung.path() / "done/O0200.nc"); }));
  EXPECT_EQ(revisions(1), 1u) << "taken once";
}

}  // namespace
}  // namespace dripline::integration
