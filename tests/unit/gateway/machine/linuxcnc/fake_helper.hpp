#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sstream>

#include "gateway/machine/linuxcnc/session.hpp"

namespace dripline::machine::linuxcnc::test {

using namespace std::chrono_literals;

inline constexpr std::string_view kHello =
    R"({"hello":1,"version":"2.9","units":1.0,"axes":7,"limits":[[-400,400],[-300,300],[-200,200],)"
    R"([0,0],[0,0],[0,0],[0,0],[0,0],[0,0]],"wrapped":0,"velocity":[200,200,200,0,0,0,0,0,0],)"
    R"("acceleration":[2000,500,2000,0,0,0,0,0,0],"rpm":6000,"read_ahead":2,"startup_code":"","adaptive":false,"settings":""})";

inline const std::string kOverridesOf100 =
    "{\"n\":1,\"do\":\"override\",\"feed\":1.0000,\"rapid\":1.0000,\"spindle\":1.0000}\n";

/// A session whose helper is the test: it reads what LinuxCNC was sent, and reports what the test
/// has set.
class FakeHelper {
 public:
  FakeHelper() {
    session.opened(now);
    say(std::string(kHello));
    report();
  }

  void say(std::string line) {
    line += '\n';
    session.receive(std::as_bytes(std::span(line)), now);
  }
  void report() {
    say(fmt::format(
        R"({{"status":{{"state":{},"mode":2,"interp":{},"exec":2,"read":{},"motion":{},"queue":{},)"
        R"("inpos":{},"paused":{},"homed":{},"homing":{},"at":[{},0,0,0,0,0,0,0,0],)"
        R"("actual":[0,0,0,0,0,0,0,0,0],"velocity":{},"offset":{},"system":9,"tool":0,)"
        R"("spindle":0.0,"adaptive":{},"touching":{},"tripped":false,"probing":false,"probed":[0,0,0,0,0,0,0,0,0],)"
        R"("inputs":5,"inputs_above":2,"echo":1}}}})",
        state, interpreter, read, motion, motion > 0 ? 1 : 0, motion == 0, paused, homed, homing, x,
        velocity, has_offset, adaptive, touching));
  }
  void done(std::uint64_t number, const std::string& problem = "") {
    say(fmt::format(R"({{"done":{},"problem":"{}","echo":1}})", number, problem));
  }
  /// Time passes; the FIFO is dry or not. What was sent is in `text` and `commands`.
  void pass(std::chrono::milliseconds time, bool is_dry = false) {
    now += time;
    session.tick(now, is_dry);
    text += session.take_text();
    commands += session.take_commands();
  }
  /// Up to the program's first line.
  void open() {
    session.set_active(true, now);
    EXPECT_FALSE(session.prepare(now));
    EXPECT_TRUE(session.wants_feed());
    session.feed_opened("/fifo", now);
    pass(1ms);
    obey();
    interpreter = 2;
    read = 5;
    report();
    EXPECT_TRUE(session.prepare(now));
    text.clear();
    commands.clear();
  }
  /// Answers every command that was sent.
  void obey() {
    std::istringstream lines(commands);
    for (std::string line; std::getline(lines, line);)
      done(static_cast<std::uint64_t>(std::atoll(line.c_str() + 5)));  // {"n":7,
    commands.clear();
  }
  std::string fault() const { return session.fault() ? std::string(session.fault()->id) : ""; }

  SteadyTime now{};
  int state = 4, interpreter = 1;
  std::uint64_t read = 0, motion = 0;
  bool paused = false, homed = true, homing = false, has_offset = false, adaptive = false,
       touching = false;
  double x = 0, velocity = 0;
  Session session;
  std::string text, commands;
};

}  // namespace dripline::machine::linuxcnc::test
