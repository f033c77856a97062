#pragma once

#include "gateway/interpreter/core/dialect.hpp"

namespace dripline::interpreter {

namespace prototrak {
/// The rows of its options, for people.
std::vector<ListedOption> list_options();
}  // namespace prototrak

/// ProtoTRAK Plus: a two-axis mill that stores events.
extern const Dialect kProtoTrakDialect;

}  // namespace dripline::interpreter
