#pragma once

#include "gateway/interpreter/core/dialect.hpp"

namespace dripline::interpreter {

namespace tnc155 {
/// The rows of its options, for people.
std::vector<ListedOption> list_options();
}  // namespace tnc155

extern const Dialect kTnc155Dialect;

}  // namespace dripline::interpreter
