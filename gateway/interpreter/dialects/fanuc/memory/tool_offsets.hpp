#pragma once

#include "gateway/interpreter/dialects/fanuc/run.hpp"

/// The registers of tool offsets: memory A has one value per number for lengths and radii, B
/// geometry and wear, C both of each. Registers of lengths and radii are always kept apart, since a
/// setup gives them apart; in A and B a program that writes one writes the other.
namespace dripline::interpreter::fanuc {

/// Where a number's value is kept: `also` when lengths and radii are one register.
struct OffsetRegister {
  double* value = nullptr;
  double* also = nullptr;
  bool is_x = false;       ///< of a lathe: a diameter to programs
  bool is_number = false;  ///< the direction of a nose's tip
};

inline constexpr double kMaxOffsetValue = 999.999;  ///< mm

/// Of the variables #2001 to #2400 and #10001 to #13400; `value` is null for any other.
OffsetRegister offset_variable(Run& run, int number);
/// Of G10 L10 to L13 and L1.
OffsetRegister offset_of_g10(Run& run, int list, int number);
double read_register(const OffsetRegister& cell);
/// `column` is where a warning points.
void write_register(Run& run, const OffsetRegister& cell, double value, std::uint32_t column);

/// Geometry and wear together, in millimeters. 0 for number 0.
double length_of_offset(const Run& run, int number);
double radius_of_offset(const Run& run, int number);

/// G10 L1, L10 to L13.
bool set_offset_data(Run& run, int list);
/// G43, G44, G49 and H.
bool apply_length_offset(Run& run);
/// A number of an H or D word. False: alarm 030.
bool read_offset_number(Run& run, Address address, int& number);

}  // namespace dripline::interpreter::fanuc
