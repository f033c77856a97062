#include <fmt/core.h>
#include <cmath>
#include <fstream>
#include <set>
#include <sstream>
#include <stdexcept>

#include "clients/tools/offline/offline_run.hpp"
#include "gateway/interpreter/core/geometry/plane_axes.hpp"
#include "gateway/interpreter/core/program_source.hpp"
#include "gateway/interpreter/registry.hpp"
#include "tests/differential/rs274ngc/peer.hpp"

namespace dripline::differential {
namespace {

using namespace interpreter;

constexpr std::array kAxes{Axis::X, Axis::Y, Axis::Z, Axis::A, Axis::B, Axis::C};

/// Lines that make a curve: the peer prints no moves of it.
std::set<std::uint64_t> curve_lines(const std::string& program) {
  std::set<std::uint64_t> lines;
  std::istringstream text(program);
  std::string line;
  for (std::uint64_t number = 1; std::getline(text, line); ++number) {
    for (const char* code : {"G5 ", "G5.1", "G5.3"}) {
      if (line.find(code) != std::string::npos) lines.insert(number);
    }
  }
  return lines;
}

class MoveSink final : public EventSink {
 public:
  explicit MoveSink(const std::string& program) : curves_(curve_lines(program)) {}
  void on_rapid(const Rapid& event) override { add(Move::Kind::Rapid, event.to); }
  void on_line(const Line& event) override {
    if (!curves_.contains(event.origin.line)) add(Move::Kind::Feed, event.to);
  }
  void on_thread(const Thread& event) override { add(Move::Kind::Feed, event.to); }
  void on_arc(const Arc& event) override {
    add(Move::Kind::Arc, event.to);
    Move& move = behavior.moves.back();
    move.center = {event.center_first.mm(), event.center_second.mm()};
    move.plane = static_cast<int>(event.plane);
    const int circles = static_cast<int>(std::ceil(event.sweep.degrees() / 360 - 1e-6));
    move.circles = event.turn == Turn::Clockwise ? -circles : circles;
  }
  void on_alarm(const Alarm& event) override {
    behavior.complaint = fmt::format("{} line {}: {}", event.diagnostic.id, event.diagnostic.line,
                                     event.diagnostic.text);
  }
  void on_end(const End&) override { behavior.is_accepted = true; }
  Behavior behavior;

 private:
  std::set<std::uint64_t> curves_;

  void add(Move::Kind kind, const Position& to) {
    Move move;
    move.kind = kind;
    for (std::size_t i = 0; i < kAxes.size(); ++i) move.to[i] = to.raw(kAxes[i]);
    behavior.moves.push_back(move);
  }
};

constexpr std::string_view kSetup = R"(
units = "in"
[control]
profile = "linuxcnc"
pins = []
[[tool]]
number = 1
length = 1.5
radius = 0.125
[[tool]]
number = 2
length = 2.25
radius = 0.0625
[[tool]]
number = 3
length = 0.5
radius = 0.25
[[tool]]
number = 4
length = 3.0
radius = 0.03125
[[tool]]
number = 5
length = 1.0
radius = 0.0
)";

}  // namespace

Behavior run_ours(const std::string& program, const std::filesystem::path& folder) {
  const auto dialect = find_dialect("rs274ngc");
  const auto setup = parse_setup(kSetup);
  if (!dialect || !setup) throw std::runtime_error("the dialect or its setup is not there");
  MemorySource source(program, [&](std::string_view name) -> std::optional<std::string> {
    std::ifstream file(folder / (std::string(name) + ".ngc"), std::ios::binary);
    if (!file) return std::nullopt;
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  });
  MoveSink sink(program);
  const auto outcome = run_offline(**dialect, *setup, source, sink);
  if (!outcome) sink.behavior.complaint = outcome.error().what;
  drop_standing_moves(sink.behavior);
  return sink.behavior;
}

}  // namespace dripline::differential
