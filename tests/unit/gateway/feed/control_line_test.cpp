#include "gateway/feed/control_line.hpp"

#include <gtest/gtest.h>
#include <atomic>

#include "tests/support/child_process.hpp"
#include "tests/support/line/host_line.hpp"
#include "tests/support/line/pty.hpp"

namespace dripline::feed {
namespace {

using namespace std::chrono_literals;
using test_support::eventually;
using test_support::HostLine;
using test_support::PtyCable;
using What = LineItem::What;

wire::LineSettings fast() {
  wire::LineSettings settings;
  settings.baud = 115200;
  settings.idle_end = 200ms;
  return settings;
}

/// Everything that a control's line delivered.
struct Delivered {
  std::string text;
  int ended = 0;
  std::vector<std::string> failures;
  void take(ControlLine& line) {
    for (const LineItem& item : line.take()) {
      if (item.what == What::Text) text += item.text;
      if (item.what == What::Ended) ++ended;
      if (item.what == What::Failed) failures.push_back(item.text);
    }
  }
};

std::unique_ptr<ControlLine> start(const PtyCable& cable, std::size_t buffer,
                                   const wire::LineSettings& settings) {
  auto line = ControlLine::start(
      {.address = cable.control(), .settings = settings, .buffer_bytes = buffer, .wake = {}});
  EXPECT_TRUE(line);
  EXPECT_TRUE(eventually([&] { return (*line)->is_open(); }, 5s));
  return std::move(*line);
}

std::string program(std::size_t size) {
  std::string text;
  for (int line = 1; text.size() < size; ++line) text += "N" + std::to_string(line) + " G1 X2.5\n";
  return text;
}

TEST(ControlLine, HoldsTheHostWhileItsMemoryIsFull) {
  PtyCable cable;
  wire::LineSettings settings = fast();
  settings.baud = 4800;  // a busy computer has half a second to let the host read XOFF
  settings.idle_end = 1s;
  const auto control = start(cable, 1024, settings);
  HostLine host(cable.host(), settings);
  control->expect();
  const std::string text = program(2000);
  host.send(text);
  Delivered delivered;
  ASSERT_TRUE(eventually([&] { return host.is_stopped(); }));
  delivered.take(*control);
  EXPECT_GE(delivered.text.size(), 1024U);
  EXPECT_LT(delivered.text.size(), 1024U + 256U) << "the host did not stop";
  const std::size_t held = delivered.text.size();
  std::size_t released = 0;
  ASSERT_TRUE(eventually(
      [&] {
        delivered.take(*control);
        control->release(delivered.text.size() - released);
        released = delivered.text.size();
        return delivered.text.size() == text.size() && delivered.ended == 1;
      },
      30s));
  EXPECT_GT(delivered.text.size(), held);
  EXPECT_EQ(delivered.text, text);
}

TEST(ControlLine, SendsTextBackWhileItIsFed) {
  PtyCable cable;
  const auto control = start(cable, 1024, fast());
  HostLine host(cable.host(), fast());
  control->expect();
  host.send(program(5000));
  ASSERT_TRUE(eventually([&] { return host.is_stopped(); }, 5s));
  EXPECT_TRUE(control->send("X1.25\n"));
  EXPECT_TRUE(eventually([&] { return host.received() == "X1.25\n"; }, 5s));
  EXPECT_TRUE(eventually([&] { return control->has_sent_all(); }, 5s));
}

/// The request for the next program arrives with the end, before the line continues by itself:
/// as a gateway's does whose run was over before the host's last EOT. A control that asks and a
/// host that asks for what was printed would ask each other for ever.
TEST(ControlLine, SendsWhatWasPrintedBeforeItAsksForTheNextProgram) {
  PtyCable cable;
  wire::LineSettings settings = fast();
  settings.flow = wire::Flow::Xmodem;
  std::atomic<ControlLine*> woken = nullptr;
  auto control =
      ControlLine::start({.address = cable.control(), .settings = settings, .wake = [&woken] {
                            if (ControlLine* line = woken) line->expect();
                          }});
  ASSERT_TRUE(control);
  ASSERT_TRUE(eventually([&] { return (*control)->is_open(); }, 5s));
  (*control)->expect();
  woken = control->get();
  HostLine host(cable.host(), settings);
  host.send(program(2000));
  Delivered delivered;
  ASSERT_TRUE(eventually(
      [&] {
        delivered.take(**control);
        return !delivered.text.empty();
      },
      5s));
  ASSERT_EQ(delivered.ended, 0);
  ASSERT_TRUE((*control)->send("X1.25\n"));
  ASSERT_TRUE(eventually([&] { return host.is_idle(); }, 10s));
  host.receive();
  EXPECT_TRUE(eventually([&] { return host.received() == "X1.25\n"; }, 10s));
  EXPECT_TRUE(eventually([&] { return (*control)->has_sent_all(); }, 5s));
}

TEST(ControlLine, SendsMoreThanTheLineTakesAtOnce) {
  PtyCable cable;
  const auto control = start(cable, 1024, fast());
  HostLine host(cable.host(), fast());
  std::string all;
  for (int line = 0; line < 500; ++line) {
    const std::string text = "X" + std::to_string(line) + "\n";
    ASSERT_TRUE(control->send(text));
    all += text;
  }
  EXPECT_TRUE(eventually([&] { return host.received() == all; }, 10s));
}

TEST(ControlLine, RefusesMoreOutputThanItKeeps) {
  PtyCable cable;
  const auto control = start(cable, 1024, fast());
  EXPECT_FALSE(control->send(std::string(ControlLine::kMaxOutput + 1, 'X')));
  EXPECT_TRUE(control->has_sent_all());
}

TEST(ControlLine, FailsTheProgramWhenTheLineIsLost) {
  PtyCable cable;
  const auto control = start(cable, 65536, fast());
  control->expect();
  HostLine host(cable.host(), fast());
  host.send(program(30'000));
  Delivered delivered;
  ASSERT_TRUE(eventually(
      [&] {
        delivered.take(*control);
        return delivered.text.size() > 100;
      },
      5s));
  cable.unplug_control();
  ASSERT_TRUE(eventually(
      [&] {
        delivered.take(*control);
        return !delivered.failures.empty();
      },
      5s));
  EXPECT_FALSE(control->is_open());
}

TEST(ControlLine, FailsAProgramWhoseHostCannotBeHeld) {
  PtyCable cable;
  wire::LineSettings deaf = fast();
  deaf.flow = wire::Flow::None;
  deaf.baud = 1'000'000;  // of the reckoning only: a pty has no rate
  const auto control = start(cable, 256, deaf);
  control->expect();
  HostLine host(cable.host(), deaf);
  host.send(program(ControlLine::kMaxOverrun + 4096));
  Delivered delivered;
  ASSERT_TRUE(eventually(
      [&] {
        delivered.take(*control);
        return !delivered.failures.empty();
      },
      50s));
  EXPECT_LE(delivered.text.size(), 256 + ControlLine::kMaxOverrun + 4096);
}

}  // namespace
}  // namespace dripline::feed
