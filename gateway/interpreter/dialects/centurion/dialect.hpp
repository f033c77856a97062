#pragma once

#include "gateway/interpreter/core/dialect.hpp"

namespace dripline::interpreter {

namespace centurion {
/// The rows of its options, for people.
std::vector<ListedOption> list_options();
}  // namespace centurion

/// Milltronics Centurion 5T/6T lathe control.
extern const Dialect kCenturionDialect;

}  // namespace dripline::interpreter
