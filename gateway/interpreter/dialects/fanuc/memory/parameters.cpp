#include "gateway/interpreter/dialects/fanuc/memory/parameters.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <array>

namespace dripline::interpreter::fanuc {
namespace {

enum class Unit : std::uint8_t { Length, Angle, Factor };

struct ParameterRow {
  int number;
  double Parameters::*value;
  Unit unit;
};
constexpr std::array kParameters{
    ParameterRow{3410, &Parameters::arc_error, Unit::Length},
    ParameterRow{5114, &Parameters::peck_return, Unit::Length},
    ParameterRow{5115, &Parameters::peck_clearance, Unit::Length},
    ParameterRow{5410, &Parameters::rotate_default, Unit::Angle},
    ParameterRow{5411, &Parameters::scale_default, Unit::Factor},
};

double value_of(const Run& run, const Word& word, Unit unit) {
  switch (unit) {
    case Unit::Length:
      return run.length(word);
    case Unit::Angle:
      return run.angle(word);
    case Unit::Factor:
      break;
  }
  return word.form == WordForm::Whole ? word.value / 1000 : word.value;
}

/// Bits that options stand for: decimal point of a calculator (DPI), start-up of compensation
/// (SUP), offsets as diameters (ODI).
struct BitRow {
  int number;
  int bit;
  bool ControlOptions::*value;
  bool is_of_lathes;  ///< as well
};
constexpr std::array kBits{BitRow{3401, 0, &ControlOptions::calculator_point, true},
                           BitRow{5003, 0, &ControlOptions::start_up_b, true},
                           BitRow{5004, 2, &ControlOptions::diameter_offset, false}};

bool refuse_parameter(Run& run, const ParameterName& name, std::uint32_t column) {
  const std::string bit = name.bit ? fmt::format(",{}", *name.bit) : "";
  return run.fail(ErrorCode::IllegalArgument, column,
                  fmt::format("PRM[{}{}]{}: known here are 3410, 5114, 5115 and the bits 3401,0 "
                              "5003,0 5004,2",
                              name.number, bit, name.has_axis ? "/[..]" : ""));
}

}  // namespace

bool read_parameter(Run& run, const ParameterName& name, std::uint32_t column, double& value) {
  if (name.has_axis) return refuse_parameter(run, name, column);
  if (name.bit) {
    for (const BitRow& row : kBits) {
      if (row.number != name.number || row.bit != *name.bit) continue;
      if (run.options.is_lathe && !row.is_of_lathes) break;
      value = run.options.*row.value ? 1 : 0;
      return true;
    }
    return refuse_parameter(run, name, column);
  }
  for (const ParameterRow& row : kParameters) {
    // What the angle and the factor count in depends on other parameters.
    if (row.number != name.number || row.unit != Unit::Length) continue;
    value = run.in_length_units(run.state.parameters.*row.value);
    return true;
  }
  return refuse_parameter(run, name, column);
}

bool begin_parameters(Run& run) {
  run.ledger.take(set_of(L));
  const Words& words = run.block.words;
  if (const AddressSet others = words.present() & ~set_of(L, N); others != 0) {
    return run.fail(ErrorCode::ParameterNumber, words.first_column(others));
  }
  run.state.enters_parameters = true;
  return true;
}

bool enter_parameter(Run& run) {
  const Block& block = run.block;
  const Words& words = block.words;
  const bool is_empty = words.present() == 0 && block.parts.groups == 0 &&
                        block.parts.m_count == 0 && block.parts.one_shot == Block::kNoCode;
  if (is_empty && run.origin.sequence == Origin::kNone) return true;
  const bool is_entry = words.present() == set_of(R) && block.parts.groups == 0 &&
                        block.parts.m_count == 0 && block.parts.one_shot == Block::kNoCode;
  if (!is_entry || run.origin.sequence == Origin::kNone) {
    const AddressSet others = words.present() & ~set_of(R);
    return run.fail(ErrorCode::ParameterNumber, words.first_column(others),
                    "N and R are expected until G11");
  }
  run.ledger.take(set_of(R));
  const auto* row =
      std::find_if(kParameters.begin(), kParameters.end(),
                   [&run](const ParameterRow& each) { return each.number == run.origin.sequence; });
  if (row == kParameters.end()) {
    return run.fail(ErrorCode::ParameterNumber, 0,
                    fmt::format("parameter {} is not one of 3410, 5114, 5115, 5410, 5411",
                                run.origin.sequence));
  }
  const double value = value_of(run, words[R], row->unit);
  const bool is_good =
      row->unit == Unit::Angle || value > 0 || (row->unit == Unit::Length && value == 0);
  if (!is_good) {
    return run.fail(ErrorCode::ParameterNumber, words.column(R),
                    fmt::format("parameter {} cannot be {}", row->number, value));
  }
  run.state.parameters.*row->value = value;
  run.warn(WarningCode::ParameterOfRun, 0, fmt::format("{}", row->number));
  return true;
}

}  // namespace dripline::interpreter::fanuc
