#include "gateway/interpreter/dialects/centurion/refusal_words.hpp"

#include <fmt/format.h>

#include "gateway/interpreter/dialects/centurion/errors.hpp"

namespace dripline::interpreter::centurion {
namespace {

/// 0: the control has no number for it.
int error_number(Refusal refusal) {
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

std::string refusal_words(Refusal refusal) {
  const int number = error_number(refusal);
  if (number == 0) return {};
  return fmt::format("error {}: {}", number, error_row_of_number(number).text);
}

}  // namespace dripline::interpreter::centurion
