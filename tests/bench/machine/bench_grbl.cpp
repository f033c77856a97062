// Lines per second to a board of the Grbl class, beside a plain sender that counts characters: the
// same lines to the same board in the same run. The board is ours, at a pseudo terminal; its moves
// are so short that the line is what limits. One JSON object per figure.
//   bench_grbl [LINES]
#include <poll.h>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <thread>

#include "gateway/machine/grbl/grbl_machine.hpp"
#include "protocol/serial/channel.hpp"
#include "tests/support/grbl/board_port.hpp"

namespace {

using namespace dripline;
using interpreter::Axis;
using interpreter::Position;
using test_support::GrblBoard;
using test_support::GrblBoardPort;
using Clock = std::chrono::steady_clock;

struct Case {
  const char* name;
  GrblBoard::Options board;
  double step;  ///< mm
};

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

std::size_t done(GrblBoardPort& port) {
  return port.with([](GrblBoard& board) { return board.done.size(); });
}

/// Text and lines as any sender has them: no N words, no reports, as many bytes as fit.
double plain_rate(const Case& given, int lines) {
  GrblBoardPort port(given.board);
  wire::LineSettings settings;
  settings.flow = wire::Flow::None;
  auto channel = serial::open_channel(port.path(), settings, std::chrono::seconds(2));
  if (!channel) std::exit(1);
  std::deque<std::size_t> unanswered;
  std::size_t bytes = 0;
  std::string pending, heard;
  int sent = 0, answered = 0;
  const auto start = Clock::now();
  while (answered < lines) {
    while (sent < lines) {
      const std::string line = sent == 0 ? fmt::format("G21G90G94G1X{:.3f}F12000\n", given.step)
                                         : fmt::format("G1X{:.3f}\n", given.step * (sent + 1));
      if (bytes + line.size() > given.board.rx_bytes - 1) break;
      pending += line;
      bytes += line.size();
      unanswered.push_back(line.size());
      ++sent;
    }
    if (const auto taken = (*channel)->write(std::as_bytes(std::span(pending))))
      pending.erase(0, *taken);
    pollfd entry{(*channel)->descriptor(), POLLIN, 0};
    (void)::poll(&entry, 1, 5);
    std::array<std::byte, 4096> room;
    const auto got = (*channel)->read(room);
    if (!got) std::exit(1);
    for (std::size_t i = 0; i < got->bytes; ++i) {
      if (room[i] != std::byte{'\n'}) {
        heard += static_cast<char>(room[i]);
        continue;
      }
      if (heard.starts_with("ok")) {
        bytes -= unanswered.front();
        unanswered.pop_front();
        ++answered;
      }
      heard.clear();
    }
  }
  while (done(port) < static_cast<std::size_t>(lines)) std::this_thread::yield();
  return lines / seconds_since(start);
}

double our_rate(const Case& given, int lines) {
  GrblBoardPort port(given.board);
  class Ends final : public machine::ExecutionSink {
   public:
    std::uint64_t executed = 0;
    void on_block_executed(const interpreter::Origin& origin) override { executed = origin.block; }
    void on_alarm(const interpreter::Alarm& alarm) override {
      std::fprintf(stderr, "bench_grbl: %s\n", alarm.diagnostic.text.c_str());
      std::exit(1);
    }
  } sink;
  machine::grbl::GrblMachine machine({.sink = sink, .clock = std::make_shared<SystemClock>()});
  machine.connect(port.path());
  while (!machine.check_begin({})) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  machine.begin({});
  const auto start = Clock::now();
  std::uint64_t fed = 0;
  while (sink.executed < static_cast<std::uint64_t>(lines)) {
    for (; fed < static_cast<std::uint64_t>(lines) && machine.has_room(); ++fed) {
      interpreter::Origin origin;
      origin.block = fed + 1;
      Position to;
      to.set(Axis::X, Length::mm(given.step * static_cast<double>(fed + 1)));
      machine.events().on_line({origin, to, Feed::per_minute(Length::mm(12'000)), false});
      machine.events().on_block_end(origin);
    }
    (void)machine.poll(machine::Seconds{0}, 512);
    // As the gateway's loop: in real time the next turn is 10 ms later.
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return lines / seconds_since(start);
}

}  // namespace

int main(int argc, char** argv) {
  const int lines = argc > 1 ? std::atoi(argv[1]) : 50'000;
  const std::array cases{Case{"grbl, 128 bytes, 15 blocks", {}, 0.02},
                         Case{"grblHAL, 1024 bytes, 100 blocks",
                              {.rx_bytes = 1024, .planner_blocks = 100, .is_grbl_hal = true},
                              0.02},
                         Case{"grbl, blocks of 5 ms", {}, 1}};
  for (const Case& given : cases) {
    const int count = given.step > 0.5 ? lines / 10 : lines;
    double plain = 0, ours = 0;  // the better of three: the machine has other work
    for (int i = 0; i < 3; ++i) {
      plain = std::max(plain, plain_rate(given, count));
      ours = std::max(ours, our_rate(given, count));
    }
    std::printf(
        "{\"name\":\"%s\",\"lines_per_second\":%.0f,\"plain_sender\":%.0f,\"ratio\":%.3f}\n",
        given.name, ours, plain, ours / plain);
    std::fflush(stdout);
  }
}
