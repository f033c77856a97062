#include "gateway/interpreter/event.hpp"

namespace dripline::interpreter {

char letter(Axis axis) {
  return "XYZABCUVW"[static_cast<std::size_t>(axis)];
}

std::optional<Axis> axis_of(char letter) {
  constexpr std::string_view kLetters = "XYZABCUVW";
  const auto at = kLetters.find(letter);
  if (at == std::string_view::npos) return std::nullopt;
  return static_cast<Axis>(at);
}

}  // namespace dripline::interpreter
