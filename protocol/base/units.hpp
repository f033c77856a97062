#pragma once

#include <cmath>
#include <compare>

namespace dripline {

/// A length or a coordinate, kept in millimeters. 1 inch = 25.4 mm exactly.
/// There is no conversion from or to double: say the unit.
class Length {
 public:
  constexpr Length() = default;
  static constexpr Length mm(double value) { return Length{value}; }
  static constexpr Length inch(double value) { return Length{value * kMillimetersPerInch}; }
  constexpr double mm() const { return mm_; }
  constexpr double inch() const { return mm_ / kMillimetersPerInch; }

  friend constexpr Length operator+(Length a, Length b) { return Length{a.mm_ + b.mm_}; }
  friend constexpr Length operator-(Length a, Length b) { return Length{a.mm_ - b.mm_}; }
  friend constexpr Length operator-(Length a) { return Length{-a.mm_}; }
  friend constexpr Length operator*(Length a, double k) { return Length{a.mm_ * k}; }
  friend constexpr Length operator*(double k, Length a) { return Length{a.mm_ * k}; }
  friend constexpr Length operator/(Length a, double k) { return Length{a.mm_ / k}; }
  friend constexpr double operator/(Length a, Length b) { return a.mm_ / b.mm_; }
  constexpr Length& operator+=(Length other) { return mm_ += other.mm_, *this; }
  constexpr Length& operator-=(Length other) { return mm_ -= other.mm_, *this; }
  friend constexpr auto operator<=>(Length, Length) = default;

  static constexpr double kMillimetersPerInch = 25.4;

 private:
  constexpr explicit Length(double mm) : mm_(mm) {}
  double mm_ = 0;
};

inline Length abs(Length value) {
  return Length::mm(std::fabs(value.mm()));
}
inline Length hypot(Length a, Length b) {
  return Length::mm(std::hypot(a.mm(), b.mm()));
}

/// An angle, kept in degrees; counterclockwise positive, 0 along the first axis of its plane.
class Angle {
 public:
  constexpr Angle() = default;
  static constexpr Angle degrees(double value) { return Angle{value}; }
  static constexpr Angle radians(double value) { return Angle{value * (180.0 / kPi)}; }
  constexpr double degrees() const { return degrees_; }
  constexpr double radians() const { return degrees_ * (kPi / 180.0); }

  friend constexpr Angle operator+(Angle a, Angle b) { return Angle{a.degrees_ + b.degrees_}; }
  friend constexpr Angle operator-(Angle a, Angle b) { return Angle{a.degrees_ - b.degrees_}; }
  friend constexpr Angle operator-(Angle a) { return Angle{-a.degrees_}; }
  friend constexpr Angle operator*(Angle a, double k) { return Angle{a.degrees_ * k}; }
  friend constexpr auto operator<=>(Angle, Angle) = default;

  static constexpr double kPi = 3.14159265358979323846;

 private:
  constexpr explicit Angle(double degrees) : degrees_(degrees) {}
  double degrees_ = 0;
};

/// How fast the tool point moves along its path: three meanings that must not be mixed up.
class Feed {
 public:
  enum class Per { Minute, Revolution, Move };
  constexpr Feed() = default;
  static constexpr Feed per_minute(Length length) { return Feed{Per::Minute, length, 0}; }
  static constexpr Feed per_revolution(Length length) { return Feed{Per::Revolution, length, 0}; }
  /// Inverse time: the move takes 1 / `moves_per_minute` minutes, whatever its length.
  static constexpr Feed inverse_time(double moves_per_minute) {
    return Feed{Per::Move, Length{}, moves_per_minute};
  }
  constexpr Per per() const { return per_; }
  /// Meaningful for Per::Minute and Per::Revolution.
  constexpr Length length() const { return length_; }
  /// Meaningful for Per::Move.
  constexpr double moves_per_minute() const { return moves_per_minute_; }
  constexpr bool is_zero() const { return length_ == Length{} && moves_per_minute_ == 0; }
  friend constexpr bool operator==(Feed, Feed) = default;

 private:
  constexpr Feed(Per per, Length length, double moves)
      : per_(per), length_(length), moves_per_minute_(moves) {}
  Per per_ = Per::Minute;
  Length length_;
  double moves_per_minute_ = 0;
};

}  // namespace dripline
