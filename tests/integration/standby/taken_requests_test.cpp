// What a control asks for, and what it sends by itself, while the server ends.
#include "tests/integration/standby/line_takeover.hpp"

namespace dripline::integration {
namespace {

using nlohmann::json;
using std::chrono::milliseconds;
using test_support::eventually;

class TakenRequests : public LineTakeover {
 protected:
  static std::string tnc_program(int number, int blocks) {
    std::string text = fmt::format("0 BEGIN PGM {} MM\n", number);
    for (int i = 1; i <= blocks; ++i) text += fmt::format("{} L X+{} Y-{} F200 M\n", i, i, i);
    return text + fmt::format("{} END PGM {} MM\n", blocks + 1, number);
  }
  /// A TNC reads in the programs that it is offered, and holds the first one in the middle.
  void begin_offer() {
    begin_with_port({{"template", "tnc155"}, {"settings", {{"baud", 9600}, {"leader", 0}}}});
    shop_->push(0, "21.h", tnc_program(21, 2000), "tnc155");
    shop_->push(0, "22.h", tnc_program(22, 2000), "tnc155");
    device_.write("\x11");
    ASSERT_TRUE(wait_text("\n5 L "));
  }
  json held() const { return shop_->rest(1).get("/api/v1/imports").json(); }
  std::string report() const { return shop_->rest(1).get("/api/v1/machines/mill-1/report").body; }
};

/// Its DC1 asks for the rest as it asks for any program, and a program from its beginning would be
/// read into the middle of the one that was broken off.
TEST_F(TakenRequests, ATncInTheMiddleOfAnOfferedProgramGetsNoOtherOne) {
  begin_offer();
  device_.write("\x13");
  const std::size_t before = received_at_rest();
  kill_first();
  device_.write("\x11");
  ASSERT_TRUE(eventually([&] { return device_.received() > before; })) << port(1).dump();
  EXPECT_TRUE(device_.stays_silent(milliseconds(300)));
  EXPECT_EQ(device_.text(before), "\x04") << "it gets the end of the transmission, once";
  device_.write("\x11");
  EXPECT_TRUE(wait_text("BEGIN PGM 21 ", before)) << "asked for again, from its beginning";
}

TEST_F(TakenRequests, AnOfferedProgramIsNotCutOffByAHandOver) {
  begin_offer();
  const auto refused = shop_->rest(0).post("/api/v1/server/drain", json::object());
  EXPECT_EQ(refused.status, 409) << refused.body;
  EXPECT_NE(refused.body.find("is sending what its control asked for"), std::string::npos)
      << refused.body;
}

constexpr const char* kRules = R"(
[[set]]
name = "calls"
program = "O9999"
[[set.rule]]
name = "send"
trigger = "PRG"
action = "send"
)";

TEST_F(TakenRequests, OneThatWasCutOffIsNotCarriedOutAndTheNextOneIs) {
  begin_with_port({{"template", "plain"},
                   {"settings", {{"eob", "lf"}, {"idle_end_ms", 1000}}},
                   {"rules", kRules}});
  const std::string text = program("O1\n", 3);
  shop_->push(0, "O1", text);
  device_.write("%\nO9999\n(PRG=");
  ASSERT_TRUE(eventually([&] { return port(0).value("received", 0u) > 8; }));
  kill_first();
  device_.write("O1)\nM30\n%\n");
  ASSERT_TRUE(eventually([&] { return report().find("O1)") != std::string::npos; })) << report();
  EXPECT_TRUE(device_.stays_silent(milliseconds(1500)));
  EXPECT_TRUE(shop_->rest(1).get("/api/v1/runs").json()["runs"].empty());
  device_.write("%\nO9999\n(PRG=O1)\nM30\n%\n");
  ASSERT_TRUE(wait_text(text)) << port(1).dump();
  EXPECT_EQ(device_.text(), text);
}

TEST_F(TakenRequests, AProgramThatWasCutOffIsNotStoredByEither) {
  begin_with_port({{"template", "plain"}, {"settings", {{"eob", "lf"}, {"idle_end_ms", 3000}}}});
  const std::string text = "%\nO77\n" + program("", 40) + "%\n";
  device_.write(text.substr(0, 200));
  ASSERT_TRUE(eventually([&] { return port(0)["reception"].is_object(); })) << port(0).dump();
  kill_first();
  device_.write(text.substr(200));
  ASSERT_TRUE(eventually([&] { return report().find("M30") != std::string::npos; })) << report();
  EXPECT_TRUE(held()["imports"].empty()) << held();
  EXPECT_EQ(shop_->rest(1).get("/api/v1/programs/O77").status, 404);
  EXPECT_TRUE(report().starts_with(text.substr(200, text.find('\n', 200) - 200) +
                                   " \xe2\x80\xa6 (may be the rest of an earlier transmission)"
                                   " \xe2\x80\xa6 (line not ended)\n"))
      << report();
  EXPECT_EQ(port(1)["reception"].value("state", ""), "interrupted") << port(1).dump();
  EXPECT_NE(port(1)["reception"].value("reason", "").find("nothing of it is stored"),
            std::string::npos)
      << port(1).dump();
  device_.write(text);
  ASSERT_TRUE(eventually([&] { return held()["imports"].size() == 1; })) << port(1).dump();
  EXPECT_EQ(shop_->rest(1).get("/api/v1/programs/O77/content?revision=1").body, text);
}

/// Such a control prints nothing: everything that it sends is a program.
TEST_F(TakenRequests, TheRestOfAProtoTraksProgramIsNoProgram) {
  begin_with_port({{"template", "prototrak"}, {"settings", {{"baud", 19200}}}});
  const std::string text = "PN7 G20 ;\n" + program("", 40) + "%";
  device_.write(text.substr(0, 200));
  ASSERT_TRUE(eventually([&] { return port(0).value("received", 0u) >= 200; }));
  kill_first();
  device_.write(text.substr(200));
  ASSERT_TRUE(eventually([&] { return report().find("M30") != std::string::npos; })) << report();
  EXPECT_TRUE(held()["imports"].empty()) << held();
  device_.write(text);
  EXPECT_TRUE(eventually([&] { return held()["imports"].size() == 1; })) << port(1).dump();
}

}  // namespace
}  // namespace dripline::integration
