#pragma once

#include <string_view>

#include "gateway/interpreter/core/event.hpp"

namespace dripline::interpreter {

/// The words of traces and records for the enumerators of events. Outside tools read them: add, do
/// not rename.
std::string_view word_of(Units units);
std::string_view word_of(Turn turn);
std::string_view word_of(ProbeUntil until);
std::string_view word_of(SpindleState state);
std::string_view word_of(StopKind kind);
std::string_view word_of(OutputDevice device);
std::string_view word_of(Feed::Per per);
std::string_view word_of(Plane plane);

}  // namespace dripline::interpreter
