#pragma once

#include <cstdint>
#include <span>

namespace dripline::interpreter {

/// How the text of a control reads where it is searched and not interpreted.
struct TextForm {
  enum class Kind : std::uint8_t {
    Words,          ///< blocks of letters with numbers
    Events,         ///< the events of a ProtoTRAK
    PlainLanguage,  ///< the dialog of a TNC
  };
  Kind kind = Kind::Words;
  std::span<const int> motion_codes = {};  ///< G codes that move besides G0 to G3, in tenths
  bool has_diameter_codes = false;         ///< G7 and G8 choose diameters and radii
  bool is_all_programs = false;            ///< the control sends programs and prints nothing
};

}  // namespace dripline::interpreter
