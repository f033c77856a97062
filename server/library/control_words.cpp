#include "server/library/control_words.hpp"

#include "gateway/interpreter/registry.hpp"

namespace dripline::library {

std::string control_words(std::string_view control, Refusal refusal) {
  const auto dialect = interpreter::find_dialect(control);
  if (!dialect || (*dialect)->refusal_words == nullptr) return {};
  return (*dialect)->refusal_words(refusal);
}

Error with_control_words(Error error, std::string_view control, Refusal refusal) {
  const std::string words = control_words(control, refusal);
  if (!words.empty()) error.what += fmt::format(" ({} {})", control, words);
  return error;
}

}  // namespace dripline::library
