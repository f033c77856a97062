#pragma once

#include "gateway/interpreter/core/dialect.hpp"

namespace dripline::interpreter {

namespace fanuc {
/// The rows of its options, for people.
std::vector<ListedOption> list_options();
}  // namespace fanuc

/// Fanuc-class machining centers (0-M, 6M, 11M, 16/18/21-M) with custom macro B.
extern const Dialect kFanucDialect;

}  // namespace dripline::interpreter
