#pragma once

#include <gtest/gtest.h>

#include "tests/support/line/line_simulator.hpp"

/// A line of a TNC with the host at its other end.
namespace dripline::wire {

inline const std::string kProgram =
    "0 BEGIN PGM 27 MM\n1 TOOL CALL 3 Z S800\n2 L X+4,5 Y-2 R0 F300 M3\n3 L Z-8\n4 END PGM 27 MM\n";

inline LineSettings settings_of(Flow flow) {
  LineSettings settings =
      find_template(flow == Flow::Heidenhain ? "tnc155" : "tnc155-bcc").value()->settings;
  settings.flow = flow;
  return settings;
}

inline test_support::LineSimulator line(const LineSettings& settings) {
  return test_support::LineSimulator({settings, make_discipline(settings, Role::Host).value(),
                                      make_discipline(settings, Role::Control).value()});
}

/// Answers each request of the control with `program`, or takes what it offers.
inline void serve(test_support::LineSimulator& line, const std::string& program) {
  line.host().on_event = [program](test_support::LineEnd& end, const Event& event, LineTime now) {
    const auto* request = std::get_if<TransferRequest>(&event);
    if (request == nullptr) return;
    if (request->kind == TransferRequest::Kind::TakeProgram) {
      EXPECT_TRUE(end.line->begin_receive(request->name, now));
    } else {
      EXPECT_TRUE(end.send(program, now, request->name));
    }
  };
}

}  // namespace dripline::wire
