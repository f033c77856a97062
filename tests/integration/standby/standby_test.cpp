// Two servers of one library and a machine that runs: whatever happens to the active one, the other
// takes over, the machine is fed, and nothing is lost, doubled or written by two.
// DRIPLINE_TAKEOVERS changes how often (6 by default).
#include <csignal>
#include <cstdlib>
#include <random>
#include <sstream>
#include <thread>

#include "tests/integration/standby/standby_fixture.hpp"

namespace dripline::integration {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using test_support::eventually;

constexpr std::uint64_t kMovesPerLine = 50;

int takeovers() {
  const char* wanted = std::getenv("DRIPLINE_TAKEOVERS");
  return wanted != nullptr ? std::atoi(wanted) : 6;
}

/// Seconds, of the servers' places: `DRIPLINE_TAKEOVER_S=3`.
std::string lease() {
  const char* wanted = std::getenv("DRIPLINE_TAKEOVER_S");
  return wanted != nullptr ? wanted : "2";
}

/// Some 0.4 MB of text a second at the speed of this test: the 4 MiB that a gateway holds at most
/// are ten seconds of it, and the program is longer than what is fed during the rounds.
std::string long_program(std::uint64_t lines) {
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

enum class Event { Kill, Freeze, Cut, Drain };
constexpr std::array kEvents{Event::Kill, Event::Freeze, Event::Cut, Event::Drain};
const char* word(Event event) {
  return std::array{"kill", "freeze", "cut", "drain"}[static_cast<std::size_t>(event)];
}

/// A run of a machine while its servers come and go.
class Takeovers : public TwoServersTest {
 protected:
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
  struct Figures {
    int count = 0;
    milliseconds most{0}, sum{0};
    double least_level = 1;  ///< of the text at the gateway, against what was there before
    std::uint64_t least_bytes = UINT64_MAX;
  };

  /// What happens to the active server, until the other one has the machine. Returns which that is.
  int happen(Event event, int active) {
    const int other = 1 - active;
    const auto level = levels_->now();
    EXPECT_GT(level.most, 0U);
    levels_->reset();
    const auto begun = std::chrono::steady_clock::now();
    switch (event) {
      case Event::Kill:
        shop_->server(active).kill();
        break;
      case Event::Freeze:
        shop_->freeze(active);
        break;
      case Event::Cut:
        cables_[static_cast<std::size_t>(active)]->pull();
        break;
      case Event::Drain: {
        const auto reply =
            shop_->rest(active).post("/api/v1/server/drain", nlohmann::json::object());
        EXPECT_EQ(reply.status, 202) << reply.body;
      }
    }
    EXPECT_TRUE(shop_->wait_active(other)) << word(event) << "\n" << shop_->log(other);
    EXPECT_TRUE(shop_->wait_connected(other)) << word(event) << "\n" << shop_->log(other);
    const auto took =
        std::chrono::duration_cast<milliseconds>(std::chrono::steady_clock::now() - begun);
    std::this_thread::sleep_for(milliseconds(500));  // until text flows again
    const auto after = levels_->now();
    EXPECT_NE(shop_->log(other).find(event == Event::Drain ? "has given the library back"
                                                           : "its lease ran out"),
              std::string::npos)
        << word(event) << "\n"
        << shop_->log(other);
    EXPECT_FALSE(after.has_ended) << "the run ended during the test: it is too short";
    EXPECT_GE(after.least * 2, level.most)
        << word(event) << ": the text at the gateway fell below half";
    Figures& figures = figures_[static_cast<std::size_t>(event)];
    ++figures.count;
    figures.sum += took;
    figures.most = std::max(figures.most, took);
    figures.least_bytes = std::min(figures.least_bytes, after.least);
    figures.least_level = std::min(
        figures.least_level, static_cast<double>(after.least) / static_cast<double>(level.most));
    return other;
  }

  /// The one that lost its place is there again as the standby.
  void recover(Event event, int lost) {
    if (event == Event::Freeze) shop_->thaw(lost);
    if (event == Event::Cut) cables_[static_cast<std::size_t>(lost)]->plug();
    if (event == Event::Freeze || event == Event::Cut) {
      const auto status = shop_->server(lost).wait(seconds(30));
      ASSERT_TRUE(status) << "it ends when it comes back\n" << shop_->log(lost);
      EXPECT_EQ(*status, 1) << shop_->log(lost);
      EXPECT_NE(shop_->log(lost).find("was taken over by another server"), std::string::npos);
    }
    if (event != Event::Drain) shop_->start(lost);  // as a service manager does
    ASSERT_TRUE(shop_->wait_for_standby()) << shop_->log(lost);
    EXPECT_EQ(shop_->role(lost), "standby") << "it waits";
  }

  std::optional<TextLevel> levels_;
  std::array<Figures, kEvents.size()> figures_{};
};

TEST_F(Takeovers, AtRandomTheMachineIsFedAndNothingIsLostOrDoubled) {
  const int rounds = takeovers();
  const std::uint64_t lines = 900 + static_cast<std::uint64_t>(rounds) * 330;
  begin({"--takeover-s", lease()});
  place_witness();
  shop_->start_gateway();
  ASSERT_TRUE(shop_->wait_connected(0)) << shop_->gateway_log();
  shop_->push(0, "O0300", long_program(lines));
  const std::string id = start_run(0);
  const auto started = std::chrono::steady_clock::now();
  levels_.emplace(shop_->gateway_state());
  // The gateway has its ten seconds of text.
  ASSERT_TRUE(eventually([&] { return levels_->now().most > 3'000'000; }))
      << levels_->now().most << "\n"
      << shop_->gateway_log();
  std::mt19937 random{std::random_device{}()};
  int active = 0;
  for (int i = 0; i < rounds && !HasFailure(); ++i) {
    constexpr int kKinds = static_cast<int>(kEvents.size());
    const int kind = i < kKinds ? i : std::uniform_int_distribution<>(0, kKinds - 1)(random);
    const Event event = kEvents[static_cast<std::size_t>(kind)];
    levels_->reset();
    std::this_thread::sleep_for(milliseconds(std::uniform_int_distribution<>(800, 2500)(random)));
    const int lost = active;
    active = happen(event, active);
    if (HasFailure()) break;
    std::this_thread::sleep_for(milliseconds(std::uniform_int_distribution<>(0, 1500)(random)));
    recover(event, lost);
  }
  const bool has_ended = eventually(
      [&] {
        const std::string state = run(active, id).value("state", "");
        return !state.empty() && state != "active" && state != "ordered";
      },
      seconds(120 + 15 * rounds));
  const auto ended = run(active, id);
  ASSERT_TRUE(has_ended) << ended.dump();
  EXPECT_EQ(ended.value("state", ""), "completed") << ended.dump();
  EXPECT_EQ(ended.value("content_verified", false), true) << ended.dump();
  EXPECT_EQ(ended.value("executed", std::uint64_t{0}), 6 + lines * (kMovesPerLine + 2))
      << ended.dump();
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - started;
  fmt::print("{:.0f} KB/s of text\n",
             ended.value("total_bytes", ended.value("size", 0.0)) / 1000 / took.count());
  expect_every_line_once(active, id, lines);
  expect_whole_trail(active);
  expect_one_writer_in_each_term();
  for (const Event event : kEvents) {
    const Figures& figures = figures_[static_cast<std::size_t>(event)];
    if (figures.count == 0) continue;
    fmt::print("{}: {} times, mean {} ms, at most {} ms, least text {} bytes, {:.0f} %\n",
               word(event), figures.count, figures.sum.count() / figures.count,
               figures.most.count(), figures.least_bytes, 100 * figures.least_level);
  }
}

}  // namespace
}  // namespace dripline::integration
