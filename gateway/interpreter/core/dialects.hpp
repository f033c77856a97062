#pragma once

#include "gateway/interpreter/core/dialect.hpp"

namespace dripline::interpreter {

// Each is defined in its own folder; only the registry and tests need to know them.

/// Milltronics Centurion 5T/6T lathe control.
extern const Dialect kCenturionDialect;
/// Fanuc-class machining centers (0-M, 6M, 11M, 16/18/21-M) with custom macro B.
extern const Dialect kFanucDialect;
/// The lathes of that class (T series).
extern const Dialect kFanucLatheDialect;
/// ProtoTRAK Plus: a two-axis mill that stores events.
extern const Dialect kProtoTrakDialect;
/// RS274/NGC: the NIST language, version 3, and what LinuxCNC made of it.
extern const Dialect kRs274NgcDialect;
/// Tektronix 1704 contouring control for punched tape, two or three axes.
extern const Dialect kTektronix1704Dialect;
/// HEIDENHAIN TNC 426/430 and iTNC 530: plain language.
extern const Dialect kItncDialect;
/// HEIDENHAIN TNC 151/155: plain language and ISO.
extern const Dialect kTnc155Dialect;

}  // namespace dripline::interpreter
