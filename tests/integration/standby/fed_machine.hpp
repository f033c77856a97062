#pragma once

#include <gtest/gtest.h>
#include <array>
#include <chrono>
#include <optional>
#include <sstream>
#include <string>

#include "tests/integration/standby/standby_fixture.hpp"

namespace dripline::integration {

/// A machine in a long run, fed by one of two servers while they come and go.
class FedMachineTest : public TwoServersTest {
 protected:
  static constexpr std::uint64_t kMovesPerLine = 50;

  /// Some 0.4 MB of text a second at the speed of this test: the 4 MiB that a gateway holds at most
  /// are ten seconds of it, and the program is longer than what is fed during the rounds.
  static std::string long_program(std::uint64_t lines) {
    const std::string padding(180, 'A');
    std::string text = "O0300\nG20 G93 G98\nG0 X2 Z0\nPOPEN P0\n";
    for (std::uint64_t line = 1; line <= lines; ++line) {
      text += fmt::format("P1={}\n", line);
      for (std::uint64_t i = 0; i < kMovesPerLine; ++i)
        text += fmt::format("G1 X2.00{} Z-0.0{:02} F800 ({})\n", i % 2, i % 31, padding);
      text += "DPRNT [LINE #1[60]]\n";
    }
    return text + "PCLOS\nM30\n";
  }

  /// Of every row that matters: who wrote it, in which term.
  void place_witness() const {
    auto database = connect();
    const auto made = database.execute(
        "CREATE TABLE witness (server text, term bigint, rows bigint, PRIMARY KEY (server, term));"
        "CREATE FUNCTION note_writer() RETURNS trigger LANGUAGE plpgsql AS $$ BEGIN "
        "INSERT INTO witness VALUES (current_setting('dripline.server', true), (SELECT term FROM "
        "store_holder), 1) ON CONFLICT (server, term) DO UPDATE SET rows = witness.rows + 1; "
        "RETURN NULL; END $$;"
        "CREATE TRIGGER witness AFTER INSERT ON record FOR EACH STATEMENT EXECUTE FUNCTION "
        "note_writer();"
        "CREATE TRIGGER witness AFTER INSERT ON audit FOR EACH STATEMENT EXECUTE FUNCTION "
        "note_writer();"
        "CREATE TRIGGER witness AFTER UPDATE ON machine FOR EACH STATEMENT EXECUTE FUNCTION "
        "note_writer();"
        "CREATE TRIGGER witness AFTER UPDATE ON run FOR EACH STATEMENT EXECUTE FUNCTION "
        "note_writer()");
    ASSERT_TRUE(made) << made.error().what;
  }
  void expect_one_writer_in_each_term() const {
    auto database = connect();
    EXPECT_EQ(database.integer("SELECT count(*) FROM (SELECT term FROM witness GROUP BY term "
                               "HAVING count(DISTINCT server) > 1) AS two"),
              0);
    EXPECT_GT(database.integer("SELECT count(DISTINCT term) FROM witness").value_or(0), 1);
  }
  std::string start_run(int server) {
    const auto reply =
        shop_->rest(server).post("/api/v1/runs", {{"machine", "lathe-1"}, {"program", "O0300"}});
    EXPECT_EQ(reply.status, 201) << reply.body;
    return reply.json().value("id", "none");
  }
  void expect_every_line_once(int server, const std::string& id, std::uint64_t lines) const {
    std::istringstream text(shop_->rest(server).get("/api/v1/reports/" + id + "?format=text").body);
    std::uint64_t count = 0;
    for (std::string line; std::getline(text, line);) {
      ++count;
      ASSERT_EQ(line, fmt::format("LINE {:06}", count));
    }
    EXPECT_EQ(count, lines);
  }

  /// The machine is in a run of so many lines of reports, and its gateway has its ten seconds of
  /// text. Returns the run.
  std::string begin_run(std::uint64_t lines) {
    place_witness();
    shop_->start_gateway();
    EXPECT_TRUE(shop_->wait_connected(0)) << shop_->gateway_log();
    shop_->push(0, "O0300", long_program(lines));
    const std::string id = start_run(0);
    levels_.emplace(shop_->gateway_state());
    EXPECT_TRUE(test_support::eventually([&] { return levels_->now().most > 3'000'000; }))
        << levels_->now().most << "\n"
        << shop_->gateway_log();
    return id;
  }
  /// To its end, with each block and each line of the report once.
  nlohmann::json expect_whole_run(int server, const std::string& id, std::uint64_t lines,
                                  std::chrono::seconds limit) const {
    const bool has_ended = test_support::eventually(
        [&] {
          const std::string state = run(server, id).value("state", "");
          return !state.empty() && state != "active" && state != "ordered";
        },
        limit);
    auto ended = run(server, id);
    EXPECT_TRUE(has_ended) << ended.dump();
    EXPECT_EQ(ended.value("state", ""), "completed") << ended.dump();
    EXPECT_EQ(ended.value("content_verified", false), true) << ended.dump();
    EXPECT_EQ(ended.value("executed", std::uint64_t{0}), 6 + lines * (kMovesPerLine + 2))
        << ended.dump();
    expect_every_line_once(server, id, lines);
    expect_whole_trail(server);
    expect_one_writer_in_each_term();
    return ended;
  }

  std::optional<TextLevel> levels_;
};

}  // namespace dripline::integration
