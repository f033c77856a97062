#pragma once

#include "gateway/interpreter/dialects/rs274ngc/run.hpp"

/// How lines with O words begin (LinuxCNC: O-codes).
namespace dripline::interpreter::rs274ngc {

/// `at` is on the O. Errors: no label, an unknown word.
bool read_oword(Run& run, const char* at, OwordHead& head);

/// For lines that are passed over: what the line is, without errors. Word None: no O word that can
/// be made out.
OwordHead peek_oword(Run& run);

/// A condition, count or value in brackets.
bool read_operand(Run& run, const char*& at, double& value);
/// Nothing but comments may follow.
bool end_of_oword(Run& run, const char* at);

}  // namespace dripline::interpreter::rs274ngc
