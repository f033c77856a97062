#include <benchmark/benchmark.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/prctl.h>
#include <unistd.h>
#include <algorithm>
#include <thread>

#include "protocol/serial/line_driver.hpp"
#include "tests/support/line/pty.hpp"
#include "tests/unit/protocol/serial/toy_discipline.hpp"

/// A drip feed through a line against that line's own rate. The peer on the pty takes characters as
/// a UART does, one a character time; `ratio` is what it got against what the line can carry (1 is
/// the most there is), `backlog` the most characters that ever waited for it.
namespace dripline {
namespace {

using Clock = std::chrono::steady_clock;
constexpr int kSeconds = 4;

/// Offers `left` characters whenever there is room.
struct Feed {
  std::unique_ptr<serial::LineDriver> line;
  std::size_t left = 0;  ///< touched on the line's thread only

  void offer() {
    line->post([this](wire::Discipline& end, wire::LineTime now) {
      if (left == 0) return;
      const std::size_t piece = std::min(left, end.room());
      left -= piece;
      (void)end.offer(std::string(piece, 'X'), left == 0, now);
    });
  }
  bool start(const std::string& path, unsigned baud) {
    wire::LineSettings settings;
    settings.baud = baud;
    auto made = serial::LineDriver::start(
        {.address = path,
         .settings = settings,
         .listener =
             {.on_event = {}, .on_traffic = {}, .on_channel = {}, .on_room = [this] { offer(); }},
         .make_discipline = [] { return std::make_unique<serial::ToyDiscipline>(); }});
    if (!made) return false;
    line = std::move(*made);
    line->post([](wire::Discipline& end, wire::LineTime now) { (void)end.begin_send("", now); });
    return true;
  }
};

/// Until the next character is due or there.
void wait(int master, Clock::duration time) {
  pollfd entry{master, POLLIN, 0};
  const auto nanoseconds = std::chrono::duration_cast<std::chrono::nanoseconds>(time).count();
  const timespec limit{0, std::clamp<long>(nanoseconds, 0, 999'999'999)};
  (void)::ppoll(&entry, 1, &limit, nullptr);
}

void drip_feed(benchmark::State& state) {
  wire::LineSettings settings;
  settings.baud = static_cast<unsigned>(state.range(0));
  const auto character = wire::character_time(settings);
  const auto size = static_cast<std::size_t>(wire::characters_per_second(settings) * kSeconds);
  ::prctl(PR_SET_TIMERSLACK, 1000UL);  // the peer must not be the slow one
  for (auto _ : state) {
    const test_support::Pty pty;
    Feed feed{nullptr, size};
    if (!feed.start(pty.path(), settings.baud))
      return state.SkipWithError("the line does not start");
    std::size_t count = 0;
    int backlog = 0;
    Clock::time_point first{}, free_at{};
    while (count < size) {
      const auto now = Clock::now();
      if (now < free_at) {
        std::this_thread::sleep_until(free_at);
        continue;
      }
      int waiting = 0;
      (void)::ioctl(pty.master(), FIONREAD, &waiting);
      backlog = std::max(backlog, waiting);
      char one = 0;
      if (::read(pty.master(), &one, 1) != 1) {
        wait(pty.master(), std::chrono::seconds(1) - std::chrono::nanoseconds(1));
        continue;
      }
      if (count++ == 0) first = now;
      // A reader woken late has not held up the line: its clock continues from the time it was due.
      free_at = std::max(free_at, now - 10 * character) + character;
    }
    const auto elapsed = Clock::now() - first;
    state.SetIterationTime(std::chrono::duration<double>(elapsed).count());
    state.counters["ratio"] = static_cast<double>(size - 1) *
                              std::chrono::duration<double>(character).count() /
                              std::chrono::duration<double>(elapsed).count();
    state.counters["backlog"] = backlog;
  }
}
BENCHMARK(drip_feed)->Arg(9600)->Arg(38400)->Arg(115200)->Iterations(1)->UseManualTime();

}  // namespace
}  // namespace dripline
