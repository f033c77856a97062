#include "server/library/control_words.hpp"

#include "gateway/interpreter/dialects/centurion/errors.hpp"

namespace dripline::library {
namespace {

/// The Centurion's numbers; 0: it has none.
int centurion_number(Refusal refusal) {
  switch (refusal) {
    case Refusal::None:
      return 0;
    case Refusal::NameTaken:
      return 300;
    case Refusal::BadNumber:
      return 301;
    case Refusal::NothingToSelect:
      return 302;
    case Refusal::NotSaved:
      return 303;
    case Refusal::NotLoaded:
      return 304;
    case Refusal::OntoItself:
      return 309;
    case Refusal::BadParameters:
      return 311;
    case Refusal::MemoryFull:
      return 312;
    case Refusal::DiskFull:
      return 101;
    case Refusal::NoSuchProgram:
      return 603;
  }
  return 0;
}

}  // namespace

std::string control_words(std::string_view control, Refusal refusal) {
  if (control != "centurion") return {};
  const int number = centurion_number(refusal);
  if (number == 0) return {};
  return fmt::format("error {}: {}", number,
                     interpreter::centurion::error_row_of_number(number).text);
}

Error with_control_words(Error error, std::string_view control, Refusal refusal) {
  const std::string words = control_words(control, refusal);
  if (!words.empty()) error.what += fmt::format(" ({} {})", control, words);
  return error;
}

}  // namespace dripline::library
