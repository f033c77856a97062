#include "gateway/interpreter/core/event_words.hpp"

#include <initializer_list>

namespace dripline::interpreter {
namespace {

/// `words` are in the order of the enumerators.
template <class Enum>
std::string_view word_among(std::initializer_list<std::string_view> words, Enum value) {
  return words.begin()[static_cast<std::size_t>(value)];
}

}  // namespace

std::string_view word_of(Units units) {
  return word_among({"in", "mm"}, units);
}
std::string_view word_of(Turn turn) {
  return word_among({"cw", "ccw"}, turn);
}
std::string_view word_of(ProbeUntil until) {
  return word_among({"contact", "release"}, until);
}
std::string_view word_of(SpindleState state) {
  return word_among({"off", "cw", "ccw", "oriented"}, state);
}
std::string_view word_of(StopKind kind) {
  return word_among({"program", "optional", "tool_change", "operator"}, kind);
}
std::string_view word_of(OutputDevice device) {
  return word_among({"file", "port1", "port2", "screen", "printer"}, device);
}
std::string_view word_of(Feed::Per per) {
  return word_among({"min", "rev", "move"}, per);
}
std::string_view word_of(Plane plane) {
  return word_among({"XY", "ZX", "YZ"}, plane);
}

}  // namespace dripline::interpreter
