// Programs that pass a line without a run while the server is killed.
#include "tests/integration/standby/line_takeover.hpp"

namespace dripline::integration {
namespace {

using nlohmann::json;
using std::chrono::milliseconds;
using test_support::eventually;

class TakenTransfers : public LineTakeover {
 protected:
  bool is_audited(const std::string& action, const std::string& words) const {
    const auto trail = shop_->rest(1).get("/api/v1/audit?limit=50").json();
    for (const auto& entry : trail["entries"]) {
      if (entry.value("action", "") == action &&
          entry.value("detail", "").find(words) != std::string::npos)
        return true;
    }
    return false;
  }
  json listed() const {
    const auto list = test_support::run_to_end(
        {program_path("dnc"), "--server", shop_->rest(1).url(), "--token-file",
         shop_->state(0) / "token", "port", "list", "--json"},
        shop_->folder() / "dnc.out");
    EXPECT_EQ(list.status, 0) << list.output;
    return json::parse(list.output)["ports"][0];
  }
};

/// What the control has is between the two numbers, whenever the server is killed.
TEST_F(TakenTransfers, ProgramsThatWereBeingSentAreKnownToTheOtherServer) {
  begin_with_port({{"template", "plain"}, {"settings", {{"line", "9600n81"}, {"eob", "lf"}}}});
  const std::string text = program("O1\n", 6000);
  shop_->push(0, "O1", text);
  const auto begun = shop_->rest(0).post("/api/v1/ports/line-1/transfers", {{"programs", {"O1"}}});
  ASSERT_EQ(begun.status, 201) << begun.body;
  ASSERT_TRUE(eventually([&] { return device_.received() > 2500; }));
  kill_first();
  const std::size_t received = received_at_rest();
  EXPECT_EQ(device_.text(), text.substr(0, received)) << "a part of it, once";
  const json transfer = listed()["transfer"];
  EXPECT_EQ(transfer.value("id", ""), begun.json().value("id", "none"));
  EXPECT_EQ(transfer.value("state", ""), "interrupted") << transfer;
  EXPECT_LE(transfer.value("sent", 0u), received) << transfer;
  EXPECT_GT(transfer.value("sent", 0u), 0u) << transfer;
  EXPECT_GE(transfer.value("at_most", 0u), received) << transfer;
  EXPECT_LT(transfer.value("at_most", 0u), text.size()) << transfer;
  EXPECT_TRUE(is_audited("port.sent", "interrupted: O1 revision 1: the server stopped"));
  EXPECT_NE(shop_->log(1).find("the control may have a part of it"), std::string::npos);
  const auto refused =
      shop_->rest(1).post("/api/v1/ports/line-1/transfers", {{"programs", {"O1"}}});
  EXPECT_EQ(refused.status, 409) << refused.body;
  EXPECT_NE(refused.body.find("reset the control"), std::string::npos) << refused.body;
  EXPECT_TRUE(device_.stays_silent(milliseconds(300)));
  ASSERT_EQ(shop_->rest(1).post("/api/v1/ports/line-1/confirm-reset", {}).status, 204);
  const auto again = shop_->rest(1).post("/api/v1/ports/line-1/transfers", {{"programs", {"O1"}}});
  ASSERT_EQ(again.status, 201) << again.body;
  EXPECT_TRUE(eventually([&] { return device_.received() > received + 500; }));
  EXPECT_TRUE(text.starts_with(device_.text(received)));
}

/// The same server that is started again after a kill knows it as well.
TEST_F(TakenTransfers, AProgramThatCameIsKnownAndNothingOfItIsKept) {
  begin_with_port({{"template", "plain"}, {"settings", {{"eob", "lf"}, {"idle_end_ms", 4000}}}});
  device_.write("%\nO77\n" + program("", 40).substr(0, 200));
  ASSERT_TRUE(eventually([&] {
    return port(0)["reception"].is_object() && port(0)["reception"].value("sent", 0u) > 0;
  })) << port(0).dump();
  EXPECT_EQ(port(0)["reception"].value("state", ""), "receiving");
  kill_first();
  const json reception = listed()["reception"];
  EXPECT_EQ(reception.value("state", ""), "interrupted") << reception;
  EXPECT_TRUE(is_audited("port.received", "nothing of it is stored"));
  EXPECT_EQ(shop_->rest(1).get("/api/v1/programs/O77").status, 404);
  EXPECT_TRUE(shop_->rest(1).get("/api/v1/imports").json()["imports"].empty());
  // The control pauses for longer than a silence that ends a text.
  EXPECT_TRUE(device_.stays_silent(milliseconds(4500)));
  device_.write("N30 G1 X30\nM30\n");
  const auto report = [&] { return shop_->rest(1).get("/api/v1/machines/mill-1/report").body; };
  ASSERT_TRUE(eventually([&] { return report().find("M30") != std::string::npos; })) << report();
  EXPECT_NE(report().find("M30 \xe2\x80\xa6 (may be the rest of an earlier transmission)\n"),
            std::string::npos)
      << report();
}

}  // namespace
}  // namespace dripline::integration
