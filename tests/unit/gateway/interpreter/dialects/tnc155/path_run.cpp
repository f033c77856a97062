#include "tests/unit/gateway/interpreter/dialects/tnc155/path_run.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>
#include <cmath>

#include "clients/tools/offline/offline_run.hpp"
#include "gateway/interpreter/core/program_source.hpp"
#include "gateway/interpreter/registry.hpp"

namespace dripline::interpreter {
namespace {

std::string number(double value) {
  double rounded = std::round(value * 1000) / 1000;
  if (rounded == 0) rounded = 0;
  return fmt::format("{}", rounded);
}

std::string text_of(const Position& to) {
  std::string text;
  for (const Axis axis : kAllAxes) {
    if (to.has(axis)) text += fmt::format(" {}{}", letter(axis), number(to.raw(axis)));
  }
  return text;
}

class PathSink final : public EventSink {
 public:
  explicit PathSink(std::vector<std::string>& events) : events_(events) {}

  void on_rapid(const Rapid& move) override { add("R" + text_of(move.to)); }
  void on_line(const Line& move) override {
    add("L" + text_of(move.to) + " F" + number(move.feed.length().mm()));
  }
  void on_arc(const Arc& arc) override {
    add(fmt::format("A{} c{},{} {}{} F{}", text_of(arc.to), number(arc.center_first.mm()),
                    number(arc.center_second.mm()), arc.turn == Turn::Clockwise ? "cw" : "ccw",
                    number(arc.sweep.degrees()), number(arc.feed.length().mm())));
  }
  void on_dwell(const Dwell& dwell) override { add("dwell " + number(dwell.seconds)); }
  void on_spindle(const Spindle& spindle) override {
    constexpr std::string_view kStates[] = {"off", "cw", "ccw", "oriented"};
    add(fmt::format("S {} {}", kStates[static_cast<std::size_t>(spindle.state)],
                    number(spindle.revolutions_per_minute)));
  }
  void on_coolant(const Coolant& coolant) override {
    add(coolant.flood ? "coolant on" : "coolant off");
  }
  void on_tool(const ToolChange& tool) override {
    std::string text = fmt::format("{}T{}", tool.is_preselection ? "next " : "", tool.number);
    if (tool.shape) {
      text +=
          fmt::format(" L{} R{}", number(tool.shape->length.mm()), number(tool.shape->radius.mm()));
    }
    add(text);
  }
  void on_miscellaneous(const Miscellaneous& m) override { add(fmt::format("M{}", m.code)); }
  void on_blank(const Blank& blank) override {
    add(fmt::format("blank {}{} to{}", letter(blank.spindle_axis), text_of(blank.min),
                    text_of(blank.max)));
  }
  void on_units(const UnitsChange& change) override {
    add(change.units == Units::Inch ? "units inch" : "units mm");
  }
  void on_probe(const Probe& probe) override {
    if (probe.result) add("probe" + text_of(probe.result->at));
  }
  void on_output(const Output& output) override { add(fmt::format("out {}", output.text)); }
  void on_stop(const Stop& stop) override {
    add(stop.kind == StopKind::ToolChange ? "stop tool" : "stop");
  }
  void on_warning(const Warning& warning) override {
    add(fmt::format("warning {}", warning.diagnostic.id));
  }
  void on_alarm(const Alarm& alarm) override { add("! " + alarm.diagnostic.text); }
  void on_end(const End& end) override {
    add(fmt::format("end {}{}", end.blocks, end.rewind ? " rewind" : ""));
  }

 private:
  void add(std::string text) { events_.push_back(std::move(text)); }
  std::vector<std::string>& events_;
};

}  // namespace

PathRun run_text(const std::string& text, const PathSetup& setup) {
  PathRun run;
  auto read = parse_setup(setup.setup);
  EXPECT_TRUE(read) << read.error().what;
  if (!read) return run;
  constexpr std::string_view kStart = "program_start";
  if (read->control.find(kStart) == nullptr) read->control.set(kStart, {std::string("any")});
  MemorySource source(text, [&](std::string_view name) -> std::optional<std::string> {
    for (const auto& [known, program] : setup.programs) {
      if (known == name) return program;
    }
    return std::nullopt;
  });
  PathSink sink(run.events);
  const auto outcome = run_offline(**find_dialect("tnc155"), *read, source, sink);
  EXPECT_TRUE(outcome) << outcome.error().what;
  if (outcome && outcome->alarm) {
    run.alarm_id = outcome->alarm->id;
    run.alarm_line = outcome->alarm->line;
  }
  return run;
}

PathRun run_blocks(const std::vector<std::string>& blocks, const PathSetup& setup) {
  std::string text = fmt::format("0 BEGIN PGM 1 {}\n", setup.units);
  std::size_t at = 1;
  for (const std::string& block : blocks) text += fmt::format("{} {}\n", at++, block);
  text += fmt::format("{} END PGM 1 {}\n", at, setup.units);
  return run_text(text, setup);
}

std::vector<std::string> moves_of(const std::vector<std::string>& blocks, const PathSetup& setup) {
  std::vector<std::string> moves;
  for (const std::string& event : run_blocks(blocks, setup).events) {
    if (event.size() > 1 && (event[1] == ' ' && (event[0] == 'R' || event[0] == 'L' ||
                                                 event[0] == 'A' || event[0] == '!'))) {
      moves.push_back(event[0] == '!' ? event.substr(0, event.find(':')) : event);
    }
  }
  return moves;
}

}  // namespace dripline::interpreter
