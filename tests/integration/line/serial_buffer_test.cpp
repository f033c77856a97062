#include <cstdlib>
#include <thread>

#include "tests/integration/line/serial_system.hpp"

/// A gateway beside a control whose server is away for as long as the buffer is to reach. In real
/// time for DRIPLINE_CUT_S seconds, five by itself; ten minutes of a simulated clock are in
/// tests/unit/gateway/app/serial/network_cut_test.cpp.
namespace dripline::integration {
namespace {

using namespace std::chrono_literals;
using test_support::eventually;
using Seconds = std::chrono::duration<double>;

int cut_seconds() {
  constexpr int kShort = 5;
  const char* wanted = std::getenv("DRIPLINE_CUT_S");
  return wanted != nullptr ? std::atoi(wanted) : kShort;
}

struct Watched {
  std::uint64_t passed = 0;
  Seconds longest_pause{0};
};

/// What passes the cable in that time, and how long nothing did.
Watched watch(const test_support::PtyCable& cable, std::chrono::seconds time) {
  Watched seen;
  const auto begun = std::chrono::steady_clock::now();
  const std::uint64_t before = cable.passed();
  auto last = begun;
  while (std::chrono::steady_clock::now() - begun < time) {
    std::this_thread::sleep_for(5ms);
    const auto now = std::chrono::steady_clock::now();
    const std::uint64_t passed = cable.passed() - before;
    seen.longest_pause = std::max<Seconds>(seen.longest_pause, now - last);
    if (passed != seen.passed) last = now;
    seen.passed = passed;
  }
  return seen;
}

TEST(SerialBuffer, IsNotFeltByTheControlWhenTheServerIsAwayAndComesBack) {
  const std::chrono::seconds cut(cut_seconds());
  const bool is_long = cut > 60s;
  const std::uint64_t rate = is_long ? 960 : 11'520;
  const std::chrono::seconds ahead = cut + cut / 60 + 1s;
  SerialSystem shop({.settings = {"flow=xonxoff"},
                     .gateway_arguments = {"--line-ahead-s", std::to_string(ahead.count())},
                     .line = is_long ? "9600n81" : "115200n81",
                     // A computer that is still for a moment is no end of the text.
                     .idle_end_ms = "2000"});
  // More than the gateway keeps, so that it needs the server again afterwards.
  const std::string text = contour(rate * static_cast<std::uint64_t>(ahead.count()) + 320'000);
  const std::string id = shop.start("contour", text);
  const auto buffered = [&] { return shop.status().value("buffered_seconds", 0.0); };
  ASSERT_TRUE(eventually(
      [&] {
        return shop.cable.passed() > 2 * rate && buffered() > static_cast<double>(cut.count());
      },
      60s))
      << shop.status().dump();
  const std::string message = shop.message();
  EXPECT_NE(message.find(" of the line"), std::string::npos) << message;
  const double reach = buffered();
  constexpr std::chrono::seconds kBefore{2};
  const Watched before = watch(shop.cable, kBefore);
  shop.system->server().kill();
  const Watched seen = watch(shop.cable, cut);
  shop.system->start_server();
  const auto per_second = [](const Watched& watched, std::chrono::seconds time) {
    return static_cast<double>(watched.passed) / static_cast<double>(time.count());
  };
  std::printf(
      "cut %d s, beforehand %.1f s (%s), %.0f characters a second, before %.0f, longest "
      "pause %.3f s\n",
      cut_seconds(), reach, message.c_str(), per_second(seen, cut), per_second(before, kBefore),
      seen.longest_pause.count());
  // A busy computer paces its lines more slowly at one time than at another; without text none
  // passes.
  EXPECT_GT(per_second(seen, cut), 0.3 * per_second(before, kBefore));
  EXPECT_LT(seen.longest_pause, 1s);
  const auto run = shop.system->wait_ended(id, std::chrono::seconds(text.size() / rate) + 120s);
  EXPECT_EQ(run.value("state", ""), "completed") << run.dump();
  EXPECT_TRUE(run.value("content_verified", false)) << run.dump();
  ASSERT_TRUE(shop.control->wait_ended(1));
  EXPECT_EQ(shop.check_received(text), text.size());
}

}  // namespace
}  // namespace dripline::integration
