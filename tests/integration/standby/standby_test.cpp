// Two servers of one library and a machine that runs: whatever happens to the active one, the other
// takes over, the machine is fed, and nothing is lost, doubled or written by two.
// DRIPLINE_TAKEOVERS changes how often (6 by default).
#include <csignal>
#include <cstdlib>
#include <random>
#include <thread>

#include "tests/integration/standby/fed_machine.hpp"

namespace dripline::integration {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

int takeovers() {
  const char* wanted = std::getenv("DRIPLINE_TAKEOVERS");
  return wanted != nullptr ? std::atoi(wanted) : 6;
}

/// Seconds, of the servers' places: `DRIPLINE_TAKEOVER_S=3`.
std::string lease() {
  const char* wanted = std::getenv("DRIPLINE_TAKEOVER_S");
  return wanted != nullptr ? wanted : "2";
}

enum class Event { Kill, Freeze, Cut, Drain };
constexpr std::array kEvents{Event::Kill, Event::Freeze, Event::Cut, Event::Drain};
const char* word(Event event) {
  return std::array{"kill", "freeze", "cut", "drain"}[static_cast<std::size_t>(event)];
}

/// A run of a machine while its servers come and go.
class Takeovers : public FedMachineTest {
 protected:
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

  std::array<Figures, kEvents.size()> figures_{};
};

TEST_F(Takeovers, AtRandomTheMachineIsFedAndNothingIsLostOrDoubled) {
  const int rounds = takeovers();
  const std::uint64_t lines = 900 + static_cast<std::uint64_t>(rounds) * 330;
  begin({"--takeover-s", lease()});
  const auto started = std::chrono::steady_clock::now();
  const std::string id = begin_run(lines);
  if (HasFailure()) return;
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
  const auto ended = expect_whole_run(active, id, lines, seconds(120 + 15 * rounds));
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - started;
  fmt::print("{:.0f} KB/s of text\n",
             ended.value("total_bytes", ended.value("size", 0.0)) / 1000 / took.count());
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
