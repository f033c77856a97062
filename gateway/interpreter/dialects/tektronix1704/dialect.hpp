#pragma once

#include "gateway/interpreter/core/dialect.hpp"

namespace dripline::interpreter {

namespace tektronix1704 {
/// The rows of its options, for people.
std::vector<ListedOption> list_options();
}  // namespace tektronix1704

/// Tektronix 1704 contouring control for punched tape, two or three axes.
extern const Dialect kTektronix1704Dialect;

}  // namespace dripline::interpreter
