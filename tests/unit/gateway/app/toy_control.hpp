#pragma once

#include "gateway/interpreter/registry.hpp"

namespace dripline::gateway {

/// A control for tests of the gateway alone. One word a line:
///   X<mm>  feed move at 6000 mm/min      OUT <text>   output to the file
///   STOP   program stop                  ASK <text>   prompt; the answer is written as an output
///   PROBE  probe move to X-10            BAD          alarm TOY0001
///   JUMP   to the first line, twice      CALL <name>  reads the first line of a called program
///   TOOLS  how many tools it knows, as an output
///   ARC, THREAD, X<mm> PER REVOLUTION   what a machine may be unable to do
///   PIN <n>  asks for an input, as an output
///   END    end of the program            anything else does nothing
const interpreter::Dialect& toy_control();

}  // namespace dripline::gateway
