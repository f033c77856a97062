#pragma once

#include "gateway/interpreter/core/dialect.hpp"

namespace dripline::interpreter {

namespace rs274ngc {
/// The rows of its options, for people.
std::vector<ListedOption> list_options();
}  // namespace rs274ngc

/// RS274/NGC: the NIST language, version 3, and what LinuxCNC made of it.
extern const Dialect kRs274NgcDialect;

}  // namespace dripline::interpreter
