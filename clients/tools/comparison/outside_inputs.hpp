#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "clients/tools/comparison/action.hpp"
#include "gateway/interpreter/core/dialect.hpp"
#include "gateway/interpreter/core/program_source.hpp"

namespace dripline::comparison {

/// What a text reads that neither it nor its program's setup decides.
struct OutsideInput {
  enum class Kind : std::uint8_t { Variable, BlockSkip };
  Kind kind = Kind::Variable;
  std::string name;  ///< of the variable
  Place place;
};

/// The first variable whose value may come from outside: one that is read before the text has set
/// it, that is computed, or that is set only after the first jump, loop, label or call. And the
/// first block that a switch of the panel skips. Looks at the texts `0` to `programs - 1` of the
/// source, in bounded memory. It may name a variable that comes from inside (a local one of a
/// called program); it never misses one.
std::vector<OutsideInput> find_outside_inputs(const interpreter::Dialect& dialect,
                                              interpreter::ProgramSource& source,
                                              interpreter::ProgramIndex programs);

}  // namespace dripline::comparison
